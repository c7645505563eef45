"""Makes motions of hands that point at targets of the world, or go to them."""

import math
from collections.abc import Mapping, Sequence
from contextlib import suppress
from functools import partial

from reactive_realizer.bml.behaviors import REACH, Pointing
from reactive_realizer.bml.vocabulary import Mode, Reach
from reactive_realizer.embodiment.joints import SIDES
from reactive_realizer.embodiment.place import heading_of
from reactive_realizer.engines.animation.faults import NoJoints, NoSuchReach, NotPointable, WrongElement
from reactive_realizer.engines.animation.motion_maker import (
    MakerContext,
    MotionRequest,
    TargetLocator,
    target_locator,
    target_turn,
)
from reactive_realizer.engines.animation.motion_parameters import parameter_values
from reactive_realizer.engines.animation.motion_unit import EXPRESSIVITY_RANGES
from reactive_realizer.engines.animation.motions.gesture import HOLD
from reactive_realizer.engines.animation.motions.pointing import (
    DEFAULTS,
    HAND,
    RANGES,
    AimedArm,
    Arms,
    Facing,
    PointingMotionUnit,
)
from reactive_realizer.engines.animation.motions.pointing_arm import PointingArm
from reactive_realizer.engines.animation.motions.touching_arm import TouchingArm
from reactive_realizer.engines.animation.walking.manner import turn_of_feet
from reactive_realizer.errors import RealizerError
from reactive_realizer.planunit.parameter import spelled

_BEHIND = math.radians(90.0)
"""Angle aside from which on the feet turn the figure to a target that its arms do not reach, rad."""

_SIDES: Mapping[str, str] = {Mode.LEFT_HAND: "l", Mode.RIGHT_HAND: "r", Mode.BOTH_HANDS: "lr"}


class PointingMaker:
    """Makes pointing gestures at targets of the world.

    The behavior's mode chooses the hand, or the binding's parameter ``hand`` with the same values, or the position
    of the target: the hand on that side if it can point there, otherwise the other one. If the behavior says so, the
    hand touches the target.
    """

    def __init__(self, context: MakerContext) -> None:
        self._context = context
        skeleton = context.humanoid.avatar.skeleton
        self._pointing: Arms = {side: PointingArm(skeleton, side) for side in SIDES}
        self._touching: Arms = {side: TouchingArm(skeleton, side) for side in SIDES}

    def __call__(self, request: MotionRequest) -> PointingMotionUnit:
        """Make a pointing gesture."""
        behavior = request.behavior
        if not isinstance(behavior, Pointing):
            raise RealizerError(WrongElement(unit="pointing", element=behavior.name))
        target = target_locator(self._context, behavior.target, follow=True)
        action = _action(behavior)
        arms = self._touching if action else self._pointing
        sides = _SIDES.get(behavior.mode or spelled(request.parameters.get(HAND, ""), _SIDES))
        humanoid, rest = self._context.humanoid, self._context.rest.body
        facing = self._facing(target, sides)
        seen = target if facing is None else lambda time=None: facing.turned(target(time))
        chosen = self._chosen(arms, sides, behavior, seen) if sides else self._free(arms, behavior, seen)
        given = parameter_values(request.parameters, {**RANGES, **EXPRESSIVITY_RANGES})
        stay = {HOLD: 0.0} if behavior.persistent else {}  # it begins to persist when it has arrived
        parameters = {**DEFAULTS, **self._context.expressivity.parameters, **given, **stay}
        carries = action in (Reach.TAKE, Reach.PUT)
        arrived = partial(self._arrive, action, behavior.target, chosen) if carries else None
        held = target_turn(self._context, behavior.target) if action == Reach.HOLD else None
        return PointingMotionUnit(
            behavior.target, chosen, target, humanoid.expected, rest, parameters, facing, arrived, held
        )

    def _arrive(self, action: str, target: str, arms: Sequence[AimedArm]) -> None:
        """Let the hands that have arrived take their target, or put down what they carry."""
        world = self._context.world
        place = world.position(target)
        for joint in (f"{self._context.character}:{arm.holder}" for arm in arms if isinstance(arm, TouchingArm)):
            if action == Reach.TAKE:
                world.carry(target, joint)
            elif action == Reach.PUT and place is not None:
                world.put_down(joint, place)

    def _facing(self, target: TargetLocator, sides: str | None) -> Facing | None:
        """Return the turn of the feet toward a target that is behind the arms that have to point; None if they stay."""
        context, arms = self._context, [self._pointing[side] for side in sides or SIDES]
        if not context.can_step or any(arm.missing for arm in arms):
            return None
        reached = [arm.aim(context.rest.body, target()).fault is None for arm in arms]
        x, _, z = target()
        if (all(reached) if sides else any(reached)) or abs(bearing := heading_of(x, z)) < _BEHIND:
            return None
        return Facing(lambda: context.humanoid.place, turn_of_feet(bearing))

    def _free(self, arms: Arms, behavior: Pointing, target: TargetLocator) -> Sequence[AimedArm]:
        """Return the arm on the side of the target, or the other one if that one cannot point there."""
        first, second = "lr" if target()[0] > 0.0 else "rl"
        try:
            return self._chosen(arms, first, behavior, target)
        except RealizerError as fault:
            with suppress(RealizerError):
                return self._chosen(arms, second, behavior, target)
            raise fault

    def _chosen(self, arms: Arms, sides: str, behavior: Pointing, target: TargetLocator) -> Sequence[AimedArm]:
        """Return arms that can point at a target, or that touch it as nearly as they can."""
        body, chosen = self._context.rest.body, [arms[side] for side in sides]
        if missing := [joint for arm in chosen for joint in arm.missing]:
            raise RealizerError(NoJoints(element=behavior.name, joints=tuple(missing)))
        for arm in chosen:
            if isinstance(arm, PointingArm) and (fault := arm.aim(body, target()).fault) is not None:
                raise RealizerError(NotPointable(target=behavior.target, hand=arm.hand, reason=fault))
        return chosen


def _action(behavior: Pointing) -> str:
    """Return what the hand does that goes to the target; empty if it points."""
    action = behavior.extensions.get(REACH, "")
    known = spelled(action, tuple(Reach))
    if action and known not in tuple(Reach):
        raise RealizerError(NoSuchReach(word=action, known=tuple(Reach)))
    return known
