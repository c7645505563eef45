"""Pointing at a target with one or both hands."""

import math
from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType

from reactive_realizer.bml.expressivity import NAMES, NEUTRAL, Expressivity
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.place import Place, between_headings
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.quaternion import Quat, from_axis_angle, rotate
from reactive_realizer.embodiment.vector import UP, Vec3
from reactive_realizer.engines.animation.arm_shift import CarriedArm, Way, on_way
from reactive_realizer.engines.animation.easing import minimum_jerk, share
from reactive_realizer.engines.animation.faults import NotTouched, TargetLost
from reactive_realizer.engines.animation.motion_maker import TargetLocator
from reactive_realizer.engines.animation.motion_unit import (
    EXPRESSIVITY_RANGES,
    Moment,
    MotionPose,
    MotionUnit,
    PhaseDuration,
    arms_used,
)
from reactive_realizer.engines.animation.motions.gesture import HOLD, HOLD_RANGE
from reactive_realizer.engines.animation.motions.pointing_arm import ArmPose, PointingArm
from reactive_realizer.engines.animation.motions.reaching import (
    gesture_key_positions,
    reach,
    shortest_phases,
    sigmoid_profile,
)
from reactive_realizer.engines.animation.motions.rotation_curves import GrowingArcs
from reactive_realizer.engines.animation.motions.touching_arm import Grip, TouchingArm
from reactive_realizer.engines.animation.spine_ik import HandGoal, leant
from reactive_realizer.engines.animation.walking.manner import stepping_time
from reactive_realizer.errors import Fault
from reactive_realizer.planunit.parameter import Range

_ALMOST = 0.8
"""Share of the preparation after which a hand may arrive within a frame."""

_FACED = math.radians(1.0)
"""A smaller turn that is left is done, rad."""

HAND = "hand"
"""Parameter for the hand, if the behavior does not choose it."""

STEEPNESS, ASYMMETRY = "steepness", "asymmetry"
"""Parameters of the speed profile (`sigmoid`). `HOLD` is how long the finger stays on its target, s."""

DEFAULTS: Mapping[str, float] = MappingProxyType({STEEPNESS: 2.0, ASYMMETRY: -0.1, HOLD: 0.8})

RANGES: Mapping[str, Range] = MappingProxyType(
    {STEEPNESS: Range(1.5, 4.0), ASYMMETRY: Range(-0.6, 0.6), HOLD: HOLD_RANGE}
)
"""Valid values of these parameters."""


AimedArm = PointingArm | TouchingArm
Arms = Mapping[str, AimedArm]
"""Arms by their sides."""


class PointingMotionUnit(MotionUnit):
    """Brings the line of one or both index fingers to the target and back.

    The hands start from their current pose. From ready to relax the line follows the target, however target and trunk
    move. Hands have a bell-shaped speed profile (`sigmoid`). Retraction takes as long as preparation, as it does for
    people (thesis 4.2.2). If the target leaves the reach of an arm, the arm stays where it came nearest.

    Arms that touch bring their fingertips to the target instead of the line.

    If the target is behind the arms, the feet turn the figure meanwhile, and turn it back.

    With spatial extent, the arm stretches further; with power, the hand is quicker, on a straighter way, and passes the
    place where it points before it is ready. The line meets the target whatever the expressivity.
    """

    kind = LayerKind.GESTURE
    planning_work = 80
    fixed = frozenset({HAND, *RANGES})
    ranges = EXPRESSIVITY_RANGES

    def __init__(
        self,
        name: str,
        arms: Sequence[AimedArm],
        target: TargetLocator,
        figure: Callable[[GlobalTime], Body],
        rest: Body,
        parameters: Mapping[str, float] = DEFAULTS,
        facing: "Facing | None" = None,
        arrived: Callable[[], None] | None = None,
        held: Callable[[], Quat | None] | None = None,
    ) -> None:
        """Plan a pointing gesture.

        Args:
            name: of the target.
            arms: one or both.
            target: locates the target at the time of a frame.
            figure: returns the body as expected in a frame (`Humanoid.expected`), with additive motion such as
                breathing, which moves the finger.
            rest: expected body at the start; preferred durations follow from it.
            parameters: a valid value for each of `RANGES`; and of expressivity, 0 for those that are missing.
            facing: the turn of the feet; None if they stay.
            arrived: is called once, when the hands have arrived; from then on, they stay there until they relax.
            held: returns the orientation of a target with which the hands turn, in the figure's frame; None if it has
                none.
        """
        self._arrived, self._keeps = arrived, False
        self._plays, self._before = False, 0.0
        self._held, self._grip = held, None if held is None else Grip(held)
        self._facing = facing
        self.steps = facing is not None
        self.parameters = {**NEUTRAL.parameters, **parameters}
        self.joints = frozenset().union(*(arm.joints for arm in arms))
        self.resources = arms_used(self.joints)
        self._arms, self._target, self._figure = arms, target, figure
        self._begin = {joint: rest.rotation(joint) for joint in self.joints}
        self._arcs = GrowingArcs()
        self._name, self._aimed = name, dict[str, Quat]()
        self._goals: tuple[HandGoal, ...] = ()
        self._profile = sigmoid_profile(self.parameters[STEEPNESS], self.parameters[ASYMMETRY])
        self._plain = self._reaching(rest, self._expressivity())
        durations = self.durations(self._expressivity())
        self.preferred_duration = sum(each.preferred for each in durations)
        self.key_positions = gesture_key_positions([each.preferred for each in durations])
        self.shortest, self.retraction = shortest_phases(durations), durations[-1].shortest

    def _expressivity(self) -> Expressivity:
        """Return the present expressivity."""
        return Expressivity(*(self.parameters[name] for name in NAMES))

    def durations(self, expressivity: Expressivity) -> list[PhaseDuration]:
        """Return the durations of the six phases between the seven points, with expressivity."""
        still, hold = PhaseDuration(0.0), PhaseDuration(expressivity.pause(self.parameters[HOLD]))
        way = self._expressed(self._plain, expressivity)
        return [way, still, still, hold, still, way]

    def preparation(self, body: Body) -> PhaseDuration:
        """Return the duration of the preparation from a body."""
        return self._way(body, self._expressivity())

    def slowed(self, before: float, after: float) -> Mapping[str, float]:
        """As `MotionUnit.slowed`: the hold stays."""
        now = self._expressivity()
        first, second = (
            self._expressed(self._plain, now._replace(temporal_extent=extent)).preferred for extent in (before, after)
        )
        return dict.fromkeys(("ready", "end"), second / first) if first > 0.0 else {}

    def _way(self, body: Body, expressivity: Expressivity) -> PhaseDuration:
        return self._expressed(self._reaching(body, expressivity), expressivity)

    def _reaching(self, body: Body, expressivity: Expressivity) -> PhaseDuration:
        """Return the duration of the way to the target, without the durations of expressivity."""
        there = leant(body, self._hand_goals(self._place(None)))
        aims = self._aim(there, expressivity)
        return reach(body, there.posed(_turns(aims)), self.joints, self._profile)

    def _expressed(self, way: PhaseDuration, expressivity: Expressivity) -> PhaseDuration:
        """Return the duration of the way with expressivity, and with the time of the feet."""
        if expressivity != NEUTRAL:
            preferred = expressivity.movement(way.preferred, way.shortest, expressivity.speed)
            way = PhaseDuration(preferred, way.shortest)
        if self._facing is None:
            return way
        time = stepping_time(self._facing.planned)
        return PhaseDuration(max(way.preferred, time.preferred), max(way.shortest, time.shortest))

    def step_turn(self, phase: float) -> float | None:
        """As `MotionUnit.step_turn`: until it relaxes."""
        return self._facing.left() if self._facing is not None and phase < self.key_positions["relax"] else None

    def start(self, body: Body) -> None:
        """Start from the current pose of the arms."""
        self._plays = True
        self._grip = None if self._held is None else Grip(self._held)
        self._begin = {joint: body.rotation(joint) for joint in self.joints}
        self._arcs = GrowingArcs()
        if self._facing is not None:
            self._facing.start()

    def pose(self, moment: Moment) -> MotionPose:
        """Return the rotations of arms and fingers; retraction fades to the layers below."""
        keys, phase, expressivity = self.key_positions, moment.phase, self._expressivity()
        if (phase <= keys["relax"] and not self._keeps) or not self._aimed:
            body = self._figure(moment.time)
            aims = self._aim(body, expressivity, moment.time)
            self._aimed = _turns(aims)
            self._goals = self._hand_goals(self._place(moment.time))
            if phase >= keys["ready"] and self._plays:
                self.fault = self.fault or self._missed(aims)
                self._hold(body)
        prepared, gone = share(phase, 0.0, keys["ready"]), self._profile(share(phase, keys["relax"], 1.0))
        if moment.shown is not None:
            self.hands = tuple(hand._replace(share=minimum_jerk(prepared) * (1.0 - gone)) for hand in self._goals)
        if phase < keys["ready"]:
            self._before = phase
            return MotionPose(self._prepared(prepared, moment.body, expressivity))
        if self._plays:  # before, a pose is what the next motion is planned from
            self._arrive()
        return MotionPose(self._aimed, 1.0 - gone)

    def _hand_goals(self, target: Vec3) -> tuple[HandGoal, ...]:
        """Return where hands are to be that go to a target."""
        return tuple(arm.goal(target) for arm in self._arms if isinstance(arm, TouchingArm))

    def _arrive(self) -> None:
        """Note that the hands have arrived, if they have; a motion that is broken off on the way jumps to its relax."""
        broken_off = self._before < _ALMOST * self.key_positions["ready"]
        if self._arrived is not None and not broken_off and self.fault is None:
            self._keeps = True
            self._arrived()
        self._arrived = None

    def _prepared(self, time: float, body: Body, expressivity: Expressivity) -> Mapping[str, Quat]:
        """Return the pose after a share of the time of the preparation."""
        done = self._profile(time)
        turned = {joint: self._arcs(joint, self._begin[joint], goal, done) for joint, goal in self._aimed.items()}
        if expressivity.power == 0.0:
            return turned
        arms = [CarriedArm.of(arm.skeleton, arm.side) for arm in self._arms]
        way = Way(self._begin, self._aimed, done, expressivity.curvature, expressivity.arriving(time))
        return on_way(arms, turned, way, body)

    def _aim(self, body: Body, expressivity: Expressivity, time: GlobalTime | None = None) -> list[ArmPose]:
        target, extent = self._place(time), expressivity.spatial_extent
        return [
            arm.aim(body, target, extent, self._grip.turn(arm.side))
            if isinstance(arm, TouchingArm) and self._grip is not None
            else arm.aim(body, target, extent)
            for arm in self._arms
        ]

    def _hold(self, body: Body) -> None:
        """Have hands that are at the target turn with it."""
        if self._grip is not None:
            there = body.posed(self._aimed)
            for arm in self._arms:
                if isinstance(arm, TouchingArm):
                    self._grip.hold(arm.side, arm.hand_turn(there))

    def _place(self, time: GlobalTime | None) -> Vec3:
        """Return the place of the target at a time, in the figure's frame after its turn, m."""
        target = self._target(time)
        return target if self._facing is None else self._facing.turned(target)

    def _missed(self, aims: Sequence[ArmPose]) -> Fault | None:
        for arm, aim in zip(self._arms, aims, strict=True):
            if aim.fault is not None:
                lost = TargetLost if isinstance(arm, PointingArm) else NotTouched
                return lost(hand=arm.hand, target=self._name, reason=aim.fault)
        return None


class Facing:
    """A turn of the feet: the direction that a figure faces when it points.

    Args:
        place: returns where the figure stands.
        planned: turn from where it stands when it begins, rad to the left.
    """

    def __init__(self, place: Callable[[], Place], planned: float) -> None:
        self.planned = planned
        self._place = place
        self._heading: float | None = None

    def start(self) -> None:
        """Begin: from now on the direction is fixed in the world."""
        self._heading = self._place().heading + self.planned

    def left(self) -> float:
        """Return the turn that is left, rad."""
        if self._heading is None:
            return self.planned
        left = between_headings(self._place().heading, self._heading)
        return left if abs(left) > _FACED else 0.0

    def turned(self, point: Vec3) -> Vec3:
        """Return a point of the figure's frame as it will be there after the turn, m."""
        return rotate(from_axis_angle(UP, -self.left()), point)


def _turns(aims: Sequence[ArmPose]) -> dict[str, Quat]:
    return {joint: rotation for aim in aims for joint, rotation in aim.rotations.items()}
