"""Gaze and head direction as motions: the turn of trunk, neck and head toward a target."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import accumulate, pairwise
from types import MappingProxyType
from typing import NamedTuple, Self

from reactive_realizer.binding.asset_file import parse_boolean
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import Gaze, GazeShift, HeadDirectionShift
from reactive_realizer.bml.names import BMLT
from reactive_realizer.bml.vocabulary import Influence
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import EYES, HEAD, TRUNK
from reactive_realizer.embodiment.place import heading_of
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, angle, difference, from_axis_angle, multiply, slerp
from reactive_realizer.embodiment.vector import FORWARD, ZERO, Vec3
from reactive_realizer.engines.animation.easing import MINIMUM_JERK_PEAK, minimum_jerk, share
from reactive_realizer.engines.animation.faults import GazeNear, GazeShort, WrongElement
from reactive_realizer.engines.animation.gaze.eyes import GazeTarget
from reactive_realizer.engines.animation.gaze.head_turn import (
    EYE_WEIGHT,
    GAZE_WEIGHTS,
    JOINT_GROUPS,
    HeadTurn,
    HeadTurner,
    default_weights,
    head_turn_toward,
)
from reactive_realizer.engines.animation.motion_maker import MakerContext, MotionRequest, target_locator
from reactive_realizer.engines.animation.motion_parameters import parameter_values
from reactive_realizer.engines.animation.motion_unit import START_TO_END, Moment, MotionPose, MotionUnit, Resource
from reactive_realizer.engines.animation.posture.rest_posture import RestPosture
from reactive_realizer.engines.animation.shortest import lag, turning_time
from reactive_realizer.engines.animation.walking.manner import stepping_time, turn_of_feet
from reactive_realizer.errors import RealizerError
from reactive_realizer.planunit.parameter import Range

SPEED, ROLL = "speed", "roll"
"""Parameters of gazes and shifts: limit of the speed of the head on its way to the target, degrees/s; tilt of the head
about the direction of the nose, degrees, to the figure's right."""

MANNERS: Mapping[str, Range] = MappingProxyType({SPEED: Range(1.0, 10_000.0), ROLL: Range(-45.0, 45.0)})
"""Their valid values; the head turns no faster than people do."""


class TurnManner(NamedTuple):
    """How a head turns to a target.

    Attributes:
        speed: limit of its angular velocity on the way, rad/s.
        roll: tilt about the direction of the nose, rad.
    """

    speed: float = math.inf
    roll: float = 0.0

    @classmethod
    def of(cls, request: MotionRequest) -> Self:
        """Return what a behavior or its binding gives."""
        given = parameter_values(request.parameters, MANNERS)
        return cls(**{name: math.radians(value) for name, value in given.items()})


@dataclass(frozen=True, slots=True)
class GazeKind:
    """A kind of gaze.

    Attributes:
        key_positions: of its points; without a ready it reaches the target at its end, without a relax it stays.
        duration: preferred, s.
        group: its replacement group.
        persists_as: name under which it persists (`MotionUnit`).
        resources: that it owns.
    """

    key_positions: Mapping[str, float]
    duration: float
    group: str
    persists_as: str | None = None
    resources: frozenset[str] = frozenset()


LOOK = GazeKind(
    MappingProxyType({"start": 0.0, "ready": 0.25, "relax": 0.75, "end": 1.0}),
    2.0,
    "gaze",
    resources=frozenset({Resource.HEAD}),
)
"""A gaze: a quarter to turn, half to look, a quarter to turn back."""

GAZE_SHIFT = GazeKind(START_TO_END, 0.5, "gaze", persists_as="gaze", resources=frozenset({Resource.HEAD}))
"""A gaze that stays until another one replaces it."""

HEAD_SHIFT = GazeKind(START_TO_END, 0.5, "head direction", persists_as="head direction")
"""A head direction that stays; the eyes may look elsewhere."""

_CHECK_FROM = 0.8
"""Share of the time until ready after which a gaze is checked for reaching its target.

The trunk may still turn before.
"""

_TURN = 0.5
"""Time in which a gaze that joins late turns to its target, s."""

_FOLLOWED = 2.0
"""A joint whose goal turns faster than this has jumped to a new goal, rad/s."""

_TOLERANCE = math.radians(3.0)
"""Deviation that a person who is looked at hardly notices, rad.

It is our choice, because measurements depend on the task (L. Linke and G. Horstmann, "New task - new results?",
Attention, Perception, & Psychophysics 86, 2024).
"""


_STEPS_FROM = math.radians(60.0)
"""Angle aside up to which the feet stay in place, rad."""


class GazeMotionUnit(MotionUnit):
    """Turns trunk, neck and head toward a target, and keeps them turned to it until it relaxes.

    The eyes are not among its joints: they look from the head as shown, with nods and breathing. `EyeController`
    combines all gazes of a figure.
    """

    kind = LayerKind.GAZE
    planning_work = 25
    fixed = frozenset({SPEED, ROLL})
    joints = frozenset(joint for joints in JOINT_GROUPS.values() for joint in joints)

    def __init__(
        self,
        target: GazeTarget,
        weights: Mapping[str, float],
        rest: RestPosture,
        kind: GazeKind = LOOK,
        expected: GazeTarget | None = None,
        *,
        may_step: bool = False,
        follows: bool = False,
        manner: "TurnManner | None" = None,
    ) -> None:
        """Plan a gaze.

        Args:
            target: point to look at.
            weights: group of joints -> its share (`GAZE_WEIGHTS`); without eyes, it is a head direction.
            rest: posture of trunk, neck and head without gaze.
            kind: of gaze.
            expected: the target as it is now; without one, the gaze has no shortest durations.
            may_step: whether the feet turn the figure where joints do not reach the target.
            follows: whether the target may move meanwhile.
            manner: of the turn; None for the usual one.
        """
        manner = manner or TurnManner()
        self._roll = from_axis_angle(FORWARD, manner.roll)
        self.parameters = dict(weights)
        self.ranges = {group: GAZE_WEIGHTS[group] for group in weights}
        self.group = kind.group
        self.persists_as = kind.persists_as
        self.resources = kind.resources
        self._target = target
        self._rest = rest
        self.key_positions = kind.key_positions
        self.preferred_duration = kind.duration
        self._may_step, self._follows = may_step, follows
        self.steps = may_step and follows
        self.entrance = _TURN
        self._begin = rest.body
        self._turner = HeadTurner()
        self._seen: tuple[GlobalTime, Mapping[str, Quat]] | None = None
        if expected is not None:
            turn = self._step_turn(expected)
            self.steps = self.steps or turn != 0.0
            self._take_time(max(stepping_time(turn).preferred, self._slow(expected, manner.speed)))
            self.shortest = self._shortest(expected, stepping_time(turn).shortest)

    @property
    def _ready(self) -> float:
        return self.key_positions.get("ready", 1.0)

    @property
    def _relax(self) -> float:
        return self.key_positions.get("relax", math.inf)

    def _slow(self, expected: GazeTarget, speed: float) -> float:
        """Return the time that the head needs from rest to the expected target at a limited speed, s."""
        body = self._rest.body
        turned = body.posed(head_turn_toward(body, self._rest.pose, expected.point, self.parameters).rotations)
        way = angle(difference(body.transform(HEAD[-1]).rotation, turned.transform(HEAD[-1]).rotation))
        return MINIMUM_JERK_PEAK * way / speed

    def _take_time(self, turn: float) -> None:
        """Make the turn, and the turn back, at least as long as a turn of the feet takes, s."""
        spans = [(point, end - begin) for (_, begin), (point, end) in pairwise(self.key_positions.items())]
        durations = {point: span * self.preferred_duration for point, span in spans}
        longer = {point: time if point == "relax" else max(time, turn) for point, time in durations.items()}
        if longer != durations:
            self.preferred_duration = sum(longer.values())
            ends = accumulate(longer.values())
            phases = {point: end / self.preferred_duration for point, end in zip(longer, ends, strict=True)}
            self.key_positions = {"start": 0.0, **phases, "end": 1.0}

    def step_turn(self, phase: float) -> float | None:
        """As `MotionUnit.step_turn`: until it relaxes."""
        return self._step_turn(self._target) if self.steps and phase < self._relax else None

    def _step_turn(self, target: GazeTarget) -> float:
        """Return how far the feet turn the figure to a target, rad to the left."""
        x, _, z = target.point(ZERO)
        bearing = heading_of(x, z)
        if not self._may_step or abs(bearing) < _STEPS_FROM:
            return 0.0
        missing = head_turn_toward(self._rest.body, self._rest.pose, target.point, self.parameters).missing
        if missing is None or missing <= _TOLERANCE:
            return 0.0
        return turn_of_feet(bearing)

    def _shortest(self, expected: GazeTarget, stepping: float) -> dict[str, float]:
        """Return the shortest durations of the turn from rest to the expected target, and of the turn back, s.

        The head may fall behind on its way. The trunk may not, because the arms hang on it.
        """
        body = self._rest.body
        turn = head_turn_toward(body, self._rest.pose, expected.point, self.parameters).rotations
        turned, trunk = body.posed(turn), turn.keys() & TRUNK
        head = lag(minimum_jerk) * turning_time(body, turned, turn.keys() - trunk)
        turning = max(head, MINIMUM_JERK_PEAK * turning_time(body, turned, trunk), stepping)
        spans = ((point, end - begin) for (_, begin), (point, end) in pairwise(self.key_positions.items()))
        return {point: min(span * self.preferred_duration, turning) for point, span in spans if point != "relax"}

    def start(self, body: Body) -> None:
        """Turn the head from its current direction, which may be another gaze."""
        self._begin = body
        self.steps = self._may_step and (self._follows or self._step_turn(self._target) != 0.0)

    def pose(self, moment: Moment) -> MotionPose:
        """Return the rotations of trunk, neck and head; they fade to the layers below."""
        body, phase = moment.body, moment.phase
        turn = self._turn(body)
        if self.fault is None and _CHECK_FROM * self._ready <= phase <= self._relax:
            self._check_target(turn, body)
        return MotionPose(
            self._eased(self._rolled(turn.rotations), moment),
            1.0 - minimum_jerk(share(phase, self._relax, 1.0)) if phase > self._relax else 1.0,
        )

    def _rolled(self, turns: Mapping[str, Quat]) -> Mapping[str, Quat]:
        """Return the turn with the head tilted about the direction of the nose."""
        if self._roll == IDENTITY or HEAD[-1] not in turns:
            return turns
        return {**turns, HEAD[-1]: multiply(turns[HEAD[-1]], self._roll)}

    def _eased(self, goal: Mapping[str, Quat], moment: Moment) -> Mapping[str, Quat]:
        """Return the turn, as far as it is done at a moment.

        A gaze that joins late moves at its own pace, whatever the phase.
        """
        self.jumped = self._has_jumped(goal, moment.time)
        self._seen = moment.time, goal
        done = minimum_jerk(share(moment.phase, 0.0, self._ready))
        if done == 1.0 or self.joined is not None:
            return goal
        return {joint: slerp(self._begin.rotation(joint), turn, done) for joint, turn in goal.items()}

    def _has_jumped(self, goal: Mapping[str, Quat], now: GlobalTime) -> bool:
        """Return whether the goal has turned faster since the last pose than a target that can be followed."""
        if self._seen is None or self._seen[1] == goal:
            return False
        before, last = self._seen
        ways = (angle(difference(last.get(joint, turn), turn)) for joint, turn in goal.items())
        return now > before and max(ways, default=0.0) > _FOLLOWED * (now - before)

    def _turn(self, body: Body) -> HeadTurn:
        return self._turner(body, self._rest.pose, self.point, self.parameters)

    def _check_target(self, turn: HeadTurn, body: Body) -> None:
        """Set a fault if the gaze does not reach its target."""
        if self.persists_as is not None:
            # The shift that it replaces will go when this one has ended, with its turn of the trunk.
            rested = body.posed({joint: self._rest.body.rotation(joint) for joint in self.joints})
            turn = head_turn_toward(rested, self._rest.pose, self.point, self.parameters)
        if turn.missing is None:
            self.fault = GazeNear()
        elif turn.missing > _TOLERANCE:
            self.fault = GazeShort(angle=math.degrees(turn.missing))

    def gaze(self, phase: float) -> Self | None:
        """Return itself while it directs the eyes."""
        return self if self.looks(phase) else None

    @property
    def eyes(self) -> float:
        """Share by which the eyes turn to the target, 0 to 1."""
        return self.parameters.get(EYE_WEIGHT, 0.0)

    @property
    def directed(self) -> tuple[str, str]:
        """Both eyes."""
        return EYES

    def looks(self, phase: float) -> bool:
        """Return whether it directs the eyes at a phase: they arrive first, and leave first."""
        return phase < self._relax

    def point(self, eyes: Vec3) -> Vec3:
        """Return the point to look at from the midpoint between the eyes, both in the figure's frame, m."""
        return self._target.point(eyes)


DYNAMIC = (BMLT, "dynamic")
"""Attribute of a gaze that follows a moving target."""


class GazeMaker:
    """Makes gazes and shifts of gaze to targets of the world.

    Args:
        context: of the figure.
        follow: whether every gaze follows its target; otherwise those whose behavior says so.
        influence: default influence.
    """

    def __init__(self, context: MakerContext, *, follow: bool = False, influence: Influence = Influence.HEAD) -> None:
        self._context = context
        self._follow = follow
        self._influence = influence

    def __call__(self, request: MotionRequest) -> GazeMotionUnit:
        """Make a gaze."""
        gaze = request.behavior
        if not isinstance(gaze, Gaze):
            raise RealizerError(WrongElement(unit="gaze", element=gaze.name))
        target, expected = (
            GazeTarget(
                target_locator(self._context, gaze.target, follow=follow), gaze.offset_angle, gaze.offset_direction
            )
            for follow in (self._follow or _follows(gaze), True)
        )
        weights = default_weights(gaze.influence or self._influence) | parameter_values(
            request.parameters, GAZE_WEIGHTS
        )
        kind = GAZE_SHIFT if isinstance(gaze, GazeShift) else LOOK
        may_step, follows = _may_step(self._context, weights, gaze.target), self._follow or _follows(gaze)
        rest = self._context.rest
        return GazeMotionUnit(
            target, weights, rest, kind, expected, may_step=may_step, follows=follows, manner=TurnManner.of(request)
        )


class HeadDirectionMaker:
    """Makes shifts of the head direction: like those of gaze, without the eyes."""

    def __init__(self, context: MakerContext) -> None:
        self._context = context

    def __call__(self, request: MotionRequest) -> GazeMotionUnit:
        """Make a shift."""
        shift = request.behavior
        if not isinstance(shift, HeadDirectionShift):
            raise RealizerError(WrongElement(unit="head-direction", element=shift.name))
        target, expected = (
            GazeTarget(target_locator(self._context, shift.target, follow=follow)) for follow in (_follows(shift), True)
        )
        weights = default_weights(Influence.HEAD) | parameter_values(request.parameters, GAZE_WEIGHTS)
        del weights[EYE_WEIGHT]
        may_step, rest, follows = _may_step(self._context, weights, shift.target), self._context.rest, _follows(shift)
        return GazeMotionUnit(
            target,
            weights,
            rest,
            HEAD_SHIFT,
            expected,
            may_step=may_step,
            follows=follows,
            manner=TurnManner.of(request),
        )


def _may_step(context: MakerContext, weights: Mapping[str, float], target: str) -> bool:
    """Return whether a figure can turn on its feet for a gaze: not for one of the eyes alone, or at its own body."""
    if target.partition(":")[0] == context.character:
        return False
    return context.can_step and any(weights.get(group, 0.0) > 0.0 for group in JOINT_GROUPS)


def _follows(behavior: Behavior) -> bool:
    return parse_boolean(DYNAMIC[1], behavior.extensions.get(DYNAMIC, "false"))
