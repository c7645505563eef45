"""Key poses as motions: a part of the body goes from one state to the next."""

import math
from bisect import bisect_right
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache
from typing import NamedTuple

from reactive_realizer.bml.expressivity import Expressivity
from reactive_realizer.bml.names import Location
from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.joints import HEAD, SIDES, TRUNK
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.quaternion import Quat, multiply
from reactive_realizer.embodiment.two_bone_ik import Arm
from reactive_realizer.embodiment.vector import ZERO, Vec3
from reactive_realizer.engines.animation.arm_shift import CarriedArm, Way, on_way
from reactive_realizer.engines.animation.easing import minimum_jerk, share
from reactive_realizer.engines.animation.faults import NotReachable, NotTurned
from reactive_realizer.engines.animation.key_poses.elbow import kept_flexed
from reactive_realizer.engines.animation.key_poses.solved_pose import JointPose, SolvedRotations
from reactive_realizer.engines.animation.motion_unit import (
    Moment,
    MotionPose,
    MotionUnit,
    Predictability,
    ordered,
)
from reactive_realizer.engines.animation.motions.rotation_curves import GrowingArcs
from reactive_realizer.engines.animation.procedural.effector_track import carried_as_shown
from reactive_realizer.engines.animation.shortest import Profile
from reactive_realizer.engines.animation.spine_ik import HandGoal, Reached
from reactive_realizer.engines.animation.tcb import Corner, Side, Tcb, turn_on_way
from reactive_realizer.errors import Fault

_LOWER = frozenset({*HEAD, *TRUNK})

_STRETCHED = 0.5
"""Distance from its place at which a hand is reported, as a share of the arm: poses are written for other figures."""

_TURNED = math.radians(20.0)
"""Angle from its direction at which a joint is reported, rad: poses are written for other figures."""

_ARRIVED = 0.05
"""Time after a key pose in which a motion that passes it is still there, s."""

_WORK = 16
"""Work of making it, beside that for each key pose, as the limit `planning_per_tick` counts."""

_SHORTEST = 0.001
"""Duration of a motion whose only pose is reached at once, s."""


Poses = Callable[[int], SolvedRotations]
"""Returns the state at a key pose by its number; where the motion started for -1."""


class Key(NamedTuple):
    """A key pose in time.

    Attributes:
        begins: when the way to it begins, s after the start of the motion.
        reached: when it is reached, s.
        left: when its hold ends, s.
        profile: of the way.
        pose: the state.
        location: of its element in the document.
        power: of the way (`Expressivity`).
        way: the state after a share of the way to it; None for the shortest arc of each joint.
        tcb: of the curve on which the motion passes it; None if it stops there.
    """

    begins: float
    reached: float
    left: float
    profile: Profile
    pose: JointPose
    location: Location
    power: float = 0.0
    way: Callable[[float], JointPose] | None = None
    tcb: Tcb | None = None


class KeyPosesMotionUnit(MotionUnit):
    """Goes from the body at its start through key poses and holds each of them.

    Goals are met in each frame from where the trunk is then. Motions of the head and of the trunk lie below gestures,
    as gazes do. It owns nothing: whatever moves the same joints later lies above it.
    """

    predictability = Predictability.ONCE_STARTED

    def __init__(
        self,
        name: str,
        keys: Sequence[Key],
        rest: Body,
        points: Mapping[str, float],
        fades: tuple[float, float],
        *,
        whole_body: bool = False,
    ) -> None:
        """Plan a motion.

        Args:
            name: for messages.
            keys: one or more, in order.
            rest: the body without it; joints without a goal in one pose are there as in this body.
            points: sync id -> time, s; besides start, relax and end.
            fades: times in which it takes over the joints and releases them, s.
            whole_body: whether it is a posture rather than a gesture.
        """
        self.parameters = {}
        self.joints = frozenset[str]().union(*(key.pose.joints for key in keys))
        self.kind = _kind(self.joints, whole_body=whole_body)
        self._keys = keys
        self._begins = [key.begins for key in keys]
        self._fade_in, self._fade_out = fades
        self._rest = rest
        self._first = SolvedRotations({joint: rest.rotation(joint) for joint in self.joints})
        self._arcs = [GrowingArcs() for _ in keys]
        self._left: Mapping[str, Quat] | None = None
        self._relaxes = max(keys[-1].left, _SHORTEST)
        self.preferred_duration = self._relaxes + self._fade_out
        named = {sync: min(time, self._relaxes) / self.preferred_duration for sync, time in points.items()}
        self.key_positions = ordered({**named, "relax": self._relaxes / self.preferred_duration})
        self._name = name
        self.planning_work = _WORK + len(keys)

    def start(self, body: Body) -> None:
        """Start from the current body."""
        self._first = SolvedRotations({joint: body.rotation(joint) for joint in self.joints})
        self._arcs = [GrowingArcs() for _ in self._keys]
        self._left = None

    def pose(self, moment: Moment) -> MotionPose:
        """Return the pose between two key poses, or at one of them."""
        time = moment.phase * self.preferred_duration
        body = carried_as_shown(moment.body, moment.body, moment.shown) if moment.shown else moment.body
        number, weight = max(0, bisect_right(self._begins, time) - 1), self._weight(time)
        key = self._keys[number]
        passed = share(time, key.begins, key.reached)
        done = key.profile(passed)
        at = cache(lambda number: self._at(number, body, moment))
        if moment.shown is not None:
            self.hands = tuple(self._hands(number, passed, weight, moment.body))
        if time > self._relaxes and moment.shown is not None:
            # An arm that is released no longer makes up for a trunk that comes back: its way to rest would turn around.
            self._left = self._left or at(number).rotations
            return MotionPose(self._left, weight)
        if passed == 1.0:
            return MotionPose(at(number).rotations, weight)
        if key.way is not None:
            return MotionPose(self._solved(key, key.way(done), body, moment).rotations, weight)
        return MotionPose(self._on_way(number, done, passed, at, moment.body), weight)

    def _at(self, number: int, body: Body, moment: Moment) -> SolvedRotations:
        """Return the state at a key pose; where the motion started for -1."""
        if number < 0:
            return self._first
        key = self._keys[number]
        return self._solved(key, key.pose, body, moment)

    def _on_way(self, number: int, done: float, time: float, at: Poses, body: Body) -> Mapping[str, Quat]:
        """Return the rotations on the way to a key pose, after a share of its time; power changes that of a hand."""
        key, here, there = self._keys[number], at(number - 1).rotations, at(number).rotations
        leaving, arriving = self._velocities(number - 1, at, "leaving"), self._velocities(number, at, "arriving")
        if leaving or arriving:
            turned = self._on_curve(number, done, at, (leaving, arriving), body.skeleton)
        else:
            arcs = self._arcs[number]
            turned = {joint: arcs(joint, here[joint], goal, done) for joint, goal in there.items()}
        if key.power == 0.0 or key.tcb is not None:
            return turned
        sides = (side for side in SIDES if turned.keys() >= {f"{side}_shoulder", f"{side}_elbow"})
        expressivity = Expressivity(power=key.power)
        # The tension of the pose before has made a way straighter that begins with its velocity.
        curvature = 1.0 if leaving else expressivity.curvature
        way = Way(here, there, done, curvature, expressivity.arriving(time))
        return on_way([CarriedArm.of(body.skeleton, side) for side in sides], turned, way, body)

    def _on_curve(
        self,
        number: int,
        done: float,
        at: Poses,
        velocities: tuple[Mapping[str, Vec3], Mapping[str, Vec3]],
        skeleton: Skeleton,
    ) -> dict[str, Quat]:
        """Return the rotations on a curve to a key pose, after a share of its time.

        Args:
            number: of the key pose.
            done: share, 0 to 1.
            at: returns the key poses.
            velocities: of joints at the beginning and at the end; others rest there.
            skeleton: of the figure.
        """
        here, there, ways = at(number - 1).rotations, at(number).rotations, self._ways(number, at)
        turned: dict[str, Quat] = {}
        for joint, turn in here.items():
            leaving, arriving = (known.get(joint, ZERO) for known in velocities)
            turned[joint] = multiply(turn, turn_on_way(ways[joint], done, leaving, arriving))
        for side in SIDES:
            if (elbow := f"{side}_elbow") in turned:
                turned[elbow] = kept_flexed(side, turned[elbow], (here[elbow], there[elbow]), skeleton)
        return turned

    def _velocities(self, number: int, at: Poses, side: Side) -> Mapping[str, Vec3]:
        """Return the velocities of the joints on one side of a key pose (`Corner`); none where the motion stops."""
        tcb = self._keys[number].tcb if number >= 0 else None
        if tcb is None:
            return {}
        before, after = self._ways(number, at), self._ways(number + 1, at)
        first, second = (key.reached - key.begins for key in self._keys[number : number + 2])
        return {joint: Corner(way, after[joint], (first, second)).tangent(tcb, side) for joint, way in before.items()}

    def _ways(self, number: int, at: Poses) -> Mapping[str, Vec3]:
        """Return the ways of the joints to a key pose as rotation vectors, rad."""
        here, there = at(number - 1).rotations, at(number).rotations
        return {joint: self._arcs[number].way(joint, turn, there[joint]) for joint, turn in here.items()}

    def _solved(self, key: Key, pose: JointPose, body: Body, moment: Moment) -> SolvedRotations:
        """Return the rotations of all joints in a pose on the way to a key pose."""
        rest = self._rest_rotations()
        solved = pose.solve(body, rest)
        if solved.missed is not None and solved.missed.share > _STRETCHED and moment.shown is not None:
            self.fault = self.fault or self._unreachable(key, pose, moment.body)
        there = key.reached <= moment.phase * self.preferred_duration <= max(key.left, key.reached + _ARRIVED)
        if there and self.fault is None and moment.shown is not None:
            self.fault = self._unturned(key, body.posed(solved.rotations))
        return solved._replace(rotations={**rest, **solved.rotations})

    def _rest_rotations(self) -> dict[str, Quat]:
        return {joint: self._rest.rotation(joint) for joint in self.joints}

    def _hands(self, number: int, passed: float, weight: float, body: Body) -> Iterator[HandGoal]:
        """Yield where hands are to be on the way to a key pose, after a share of its time."""
        done = minimum_jerk(passed)
        for each, part in ((number - 1, 1.0 - done), (number, done)):
            if part > 0.0 and each >= 0:
                hands = self._keys[each].pose.hands(body, self._rest_rotations())
                yield from (hand._replace(share=part * weight) for hand in hands)

    def _unreachable(self, key: Key, pose: JointPose, upright: Body) -> Fault | None:
        """Return the fault of a hand that its place is far from even if the trunk leans; None if it is not."""
        for hand in pose.hands(upright, self._rest_rotations()):
            missing = Reached.of(upright, hand).missing
            if missing > _STRETCHED * Arm.of(upright.skeleton, hand.side).reach:
                phase = key.reached / self.preferred_duration
                fault = NotReachable(joint=f"{hand.side}_wrist", animation=self._name, phase=phase, distance=missing)
                return fault.located(key.location.line, key.location.column)
        return None

    def _unturned(self, key: Key, body: Body) -> Fault | None:
        """Return the fault of the joint that is furthest from its direction in a posed body; None if it is near."""
        short = max(key.pose.unturned(body, self._rest_rotations()), key=lambda each: each.angle, default=None)
        if short is None or short.angle <= _TURNED:
            return None
        phase = key.reached / self.preferred_duration
        fault = NotTurned(joint=short.joint, animation=self._name, phase=phase, angle=math.degrees(short.angle))
        return fault.located(key.location.line, key.location.column)

    def _weight(self, time: float) -> float:
        come = minimum_jerk(share(time, 0.0, self._fade_in))
        gone = minimum_jerk(share(time, self._relaxes, self.preferred_duration)) if time > self._relaxes else 0.0
        return come * (1.0 - gone)


def _kind(joints: frozenset[str], *, whole_body: bool) -> LayerKind:
    if whole_body:
        return LayerKind.FULL_BODY
    return LayerKind.GAZE if joints <= _LOWER else LayerKind.GESTURE
