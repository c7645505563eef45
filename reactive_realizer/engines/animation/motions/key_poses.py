"""Key poses as motions: a part of the body goes from one state to the next."""

from bisect import bisect_right
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import NamedTuple

from reactive_realizer.bml.expressivity import Expressivity
from reactive_realizer.bml.key_poses import KeyPose, KeyPoses
from reactive_realizer.bml.names import Location
from reactive_realizer.bml.time_warps import warped
from reactive_realizer.bml.vocabulary import BodyGroup
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import HEAD, SIDES, TRUNK
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.quaternion import Quat, slerp
from reactive_realizer.engines.animation.arm_shift import CarriedArm, Way, on_way
from reactive_realizer.engines.animation.easing import minimum_jerk, share
from reactive_realizer.engines.animation.faults import NoGoals, NotReachable, WrongElement
from reactive_realizer.engines.animation.key_poses.solved_pose import JointPose, Missed
from reactive_realizer.engines.animation.motion_maker import MakerContext, MotionRequest
from reactive_realizer.engines.animation.motion_unit import (
    Moment,
    MotionPose,
    MotionUnit,
    Predictability,
    ordered,
)
from reactive_realizer.engines.animation.motions.pose_goals import PoseGoals
from reactive_realizer.engines.animation.procedural.effector_track import carried_as_shown
from reactive_realizer.engines.animation.shortest import Profile
from reactive_realizer.errors import Fault, RealizerError

_LOWER = frozenset({*HEAD, *TRUNK})

_STRETCHED = 0.5
"""Distance from its place at which a hand is reported, as a share of the arm: poses are written for other figures."""

_SHORTEST = 0.001
"""Duration of a motion whose only pose is reached at once, s."""


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
    """

    begins: float
    reached: float
    left: float
    profile: Profile
    pose: JointPose
    location: Location
    power: float = 0.0
    way: Callable[[float], JointPose] | None = None


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
        self.joints = frozenset(joint for key in keys for joint in key.pose.joints)
        self.kind = _kind(self.joints, whole_body=whole_body)
        self._keys = keys
        self._begins = [key.begins for key in keys]
        self._fade_in, self._fade_out = fades
        self._rest = rest
        self._first: Mapping[str, Quat] = {joint: rest.rotation(joint) for joint in self.joints}
        self._relaxes = max(keys[-1].left, _SHORTEST)
        self.preferred_duration = self._relaxes + self._fade_out
        named = {sync: min(time, self._relaxes) / self.preferred_duration for sync, time in points.items()}
        self.key_positions = ordered({**named, "relax": self._relaxes / self.preferred_duration})
        self._name = name

    def start(self, body: Body) -> None:
        """Start from the current body."""
        self._first = {joint: body.rotation(joint) for joint in self.joints}

    def pose(self, moment: Moment) -> MotionPose:
        """Return the pose between two key poses, or at one of them."""
        time = moment.phase * self.preferred_duration
        body = carried_as_shown(moment.body, moment.body, moment.shown) if moment.shown else moment.body
        number = max(0, bisect_right(self._begins, time) - 1)
        key = self._keys[number]
        passed = share(time, key.begins, key.reached)
        done = key.profile(passed)
        if key.way is not None and passed < 1.0:
            return MotionPose(self._rotations(key, key.way(done), body, moment), self._weight(time))
        there: Mapping[str, Quat] = self._rotations(key, key.pose, body, moment)
        if passed < 1.0:
            before = self._keys[number - 1]
            here = self._first if number == 0 else self._rotations(before, before.pose, body, moment)
            there = self._on_way(key, here, there, done, moment.body, passed)
        return MotionPose(there, self._weight(time))

    def _on_way(
        self, key: Key, here: Mapping[str, Quat], there: Mapping[str, Quat], done: float, body: Body, time: float
    ) -> Mapping[str, Quat]:
        """Return the rotations on the way to a key pose, after a share of its time; power changes that of a hand."""
        turned = {joint: slerp(here[joint], goal, done) for joint, goal in there.items()}
        if key.power == 0.0:
            return turned
        sides = (side for side in SIDES if turned.keys() >= {f"{side}_shoulder", f"{side}_elbow"})
        expressivity = Expressivity(power=key.power)
        way = Way(here, there, done, expressivity.curvature, expressivity.arriving(time))
        return on_way([CarriedArm.of(body.skeleton, side) for side in sides], turned, way, body)

    def _rotations(self, key: Key, pose: JointPose, body: Body, moment: Moment) -> dict[str, Quat]:
        """Return the rotations of all joints in a pose on the way to a key pose."""
        rest = {joint: self._rest.rotation(joint) for joint in self.joints}
        solved = pose.solve(body, rest)
        if solved.missed is not None and solved.missed.share > _STRETCHED and moment.shown is not None:
            self.fault = self.fault or self._unreachable(key, solved.missed)
        return {**rest, **solved.rotations}

    def _unreachable(self, key: Key, missed: Missed) -> Fault:
        phase = key.reached / self.preferred_duration
        fault = NotReachable(joint=missed.joint, animation=self._name, phase=phase, distance=missed.distance)
        return fault.located(key.location.line, key.location.column)

    def _weight(self, time: float) -> float:
        come = minimum_jerk(share(time, 0.0, self._fade_in))
        gone = minimum_jerk(share(time, self._relaxes, self.preferred_duration)) if time > self._relaxes else 0.0
        return come * (1.0 - gone)


def _kind(joints: frozenset[str], *, whole_body: bool) -> LayerKind:
    if whole_body:
        return LayerKind.FULL_BODY
    return LayerKind.GAZE if joints <= _LOWER else LayerKind.GESTURE


def _speed(pose: KeyPose, behavior: KeyPoses) -> Profile:
    """Return the completed share of the way to a pose after a share of its time."""
    warping = pose if pose.warp is not None else behavior
    if warping.warp is None:
        return minimum_jerk
    return partial(warped, kind=warping.warp, steepness=warping.steepness)


class KeyPosesMaker:
    """Makes motions of key poses. Goals that the figure cannot have are left out with a note each."""

    def __init__(self, context: MakerContext) -> None:
        self._context = context

    def __call__(self, request: MotionRequest) -> KeyPosesMotionUnit:
        """Make a motion.

        Raises:
            RealizerError: "no-goals": none of its goals can be met.
        """
        behavior = request.behavior
        if not isinstance(behavior, KeyPoses):
            raise RealizerError(WrongElement(unit="key-poses", element=behavior.name))
        rest = self._context.rest.body
        goals = PoseGoals(behavior.group, self._context, rest)
        keys: list[Key] = []
        left = 0.0
        for pose in behavior.poses:
            solved = goals.solved(pose.goals)
            if solved is not None:
                speed = _speed(pose, behavior)
                keys.append(Key(left, pose.time, pose.time + pose.hold, speed, solved, pose.location, pose.power))
            left = pose.time + pose.hold
        if not keys:
            raise RealizerError(goals.notes[0] if len(goals.notes) == 1 else NoGoals(reasons=goals.reasons))
        points = {pose.id: pose.time for pose in behavior.poses if pose.id}
        fades = behavior.fade_in, behavior.fade_out
        whole = behavior.group is BodyGroup.WHOLEBODY
        motion = KeyPosesMotionUnit(behavior.id, keys, rest, points, fades, whole_body=whole)
        motion.notes = goals.notes
        return motion
