"""From a behavior to a pointing."""

from collections.abc import Mapping, Sequence
from contextlib import suppress

from reactive_realizer.bml.behaviors import Pointing
from reactive_realizer.bml.words import Mode
from reactive_realizer.embodiment.joints import SIDES
from reactive_realizer.engines.animation.actor import Actor, Wanted
from reactive_realizer.engines.animation.arms.pointing_arm import PointingArm
from reactive_realizer.engines.animation.arms.pointing_motion_unit import DEFAULTS, HAND, RANGES, PointingMotionUnit
from reactive_realizer.engines.animation.sight import Sight, sight_of
from reactive_realizer.engines.animation.values import values_of
from reactive_realizer.errors import RealizerError, error
from reactive_realizer.planunit.parameter import spelled

_SIDES: Mapping[str, str] = {Mode.LEFT_HAND: "l", Mode.RIGHT_HAND: "r", Mode.BOTH_HANDS: "lr"}


class PointingMaker:
    """Makes pointings at targets of the world.

    Which hand is said by the behavior's mode, else by the binding's parameter ``hand`` with the same words, else by
    where the target is: the hand of that side if it can point there, or the other.
    """

    def __init__(self, actor: Actor) -> None:
        self._actor = actor
        self._arm = {side: PointingArm(actor.humanoid.avatar.skeleton, side) for side in SIDES}

    def __call__(self, wanted: Wanted) -> PointingMotionUnit:
        """As every maker."""
        behavior = wanted.behavior
        if not isinstance(behavior, Pointing):
            raise error("wrong-element", unit="pointing", element=behavior.name)
        target = sight_of(self._actor, behavior.target, follow=True)
        sides = _SIDES.get(behavior.mode or spelled(wanted.parameters.get(HAND, ""), _SIDES))
        arms = self._arms(sides, behavior, target) if sides else self._free(behavior, target)
        parameters = {**DEFAULTS, **values_of(wanted.parameters, RANGES)}
        humanoid, rest = self._actor.humanoid, self._actor.rest.body
        return PointingMotionUnit(behavior.target, arms, target, lambda: humanoid.shown, rest, parameters)

    def _free(self, behavior: Pointing, target: Sight) -> Sequence[PointingArm]:
        """The arm on the side of the target, or the other if that one cannot."""
        first, second = "lr" if target()[0] > 0.0 else "rl"
        try:
            return self._arms(first, behavior, target)
        except RealizerError as fault:
            with suppress(RealizerError):
                return self._arms(second, behavior, target)
            raise fault

    def _arms(self, sides: str, behavior: Pointing, target: Sight) -> Sequence[PointingArm]:
        """Arms that can point at a target."""
        body, arms = self._actor.rest.body, [self._arm[side] for side in sides]
        if missing := [joint for arm in arms for joint in arm.missing]:
            raise error("no-joints", element=behavior.name, joints=", ".join(missing))
        for arm in arms:
            if (fault := arm.aim(body, target()).fault) is not None:
                raise error("not-pointable", target=behavior.target, hand=arm.hand, reason=fault)
        return arms
