"""Key poses as motions: a part of the body goes from one state to the next."""

from bisect import bisect_right
from collections.abc import Iterable, Mapping, Sequence
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
from reactive_realizer.engines.animation.key_poses.solved_pose import Missed, SolvedPose
from reactive_realizer.engines.animation.motion_maker import MakerContext, MotionRequest
from reactive_realizer.engines.animation.motion_unit import Moment, MotionPose, MotionUnit, Predictability, ordered
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
    """

    begins: float
    reached: float
    left: float
    profile: Profile
    pose: SolvedPose
    location: Location
    power: float


class KeyPosesMotionUnit(MotionUnit):
    """Goes from the body at its start through key poses, every joint along its shortest arc, and holds each of them.

    Goals are met in each frame from where the trunk is then. Motions of the head and of the trunk lie below gestures,
    as gazes do. It owns nothing: whatever moves the same joints later lies above it.
    """

    predictability = Predictability.ONCE_STARTED

    def __init__(self, behavior: KeyPoses, keys: Sequence[Key], rest: Body, notes: tuple[Fault, ...] = ()) -> None:
        """Plan a motion.

        Args:
            behavior: with the times of its poses.
            keys: one or more, in order.
            rest: the body without it; joints without a goal in one pose are there as in this body.
            notes: faults of goals that are left out.
        """
        self.parameters = {}
        self.notes = notes
        self.joints = frozenset(joint for key in keys for joint in key.pose.joints)
        self.kind = _kind(behavior.group, self.joints)
        self._keys = keys
        self._begins = [key.begins for key in keys]
        self._fade_in, self._fade_out = behavior.fade_in, behavior.fade_out
        self._rest = rest
        self._first: Mapping[str, Quat] = {joint: rest.rotation(joint) for joint in self.joints}
        self._relaxes = max(keys[-1].left, _SHORTEST)
        self.preferred_duration = self._relaxes + self._fade_out
        self.key_positions = self._points(behavior.poses)
        self._name = behavior.id

    def _points(self, poses: Iterable[KeyPose]) -> Mapping[str, float]:
        named = {pose.id: min(pose.time, self._relaxes) / self.preferred_duration for pose in poses if pose.id}
        return ordered({**named, "relax": self._relaxes / self.preferred_duration})

    def start(self, body: Body) -> None:
        """Start from the current body."""
        self._first = {joint: body.rotation(joint) for joint in self.joints}

    def pose(self, moment: Moment) -> MotionPose:
        """Return the pose between two key poses, or at one of them."""
        time = moment.phase * self.preferred_duration
        body = carried_as_shown(moment.body, moment.body, moment.shown) if moment.shown else moment.body
        number = max(0, bisect_right(self._begins, time) - 1)
        key = self._keys[number]
        there: Mapping[str, Quat] = self._rotations(number, body, moment)
        if time < key.reached:
            done = key.profile(share(time, key.begins, key.reached))
            here = self._first if number == 0 else self._rotations(number - 1, body, moment)
            there = self._on_way(key, here, there, done, moment.body, share(time, key.begins, key.reached))
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

    def _rotations(self, number: int, body: Body, moment: Moment) -> dict[str, Quat]:
        """Return the rotations of all joints in a key pose."""
        rest = {joint: self._rest.rotation(joint) for joint in self.joints}
        solved = self._keys[number].pose.solve(body, rest)
        if solved.missed is not None and solved.missed.share > _STRETCHED and moment.shown is not None:
            self.fault = self.fault or self._unreachable(self._keys[number], solved.missed)
        return {**rest, **solved.rotations}

    def _unreachable(self, key: Key, missed: Missed) -> Fault:
        phase = key.reached / self.preferred_duration
        fault = NotReachable(joint=missed.joint, animation=self._name, phase=phase, distance=missed.distance)
        return fault.located(key.location.line, key.location.column)

    def _weight(self, time: float) -> float:
        come = minimum_jerk(share(time, 0.0, self._fade_in))
        gone = minimum_jerk(share(time, self._relaxes, self.preferred_duration)) if time > self._relaxes else 0.0
        return come * (1.0 - gone)


def _kind(group: BodyGroup, joints: frozenset[str]) -> LayerKind:
    if group is BodyGroup.WHOLEBODY:
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
        return KeyPosesMotionUnit(behavior, keys, rest, goals.notes)
