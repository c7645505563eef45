"""Makes motions of the key poses of a behavior."""

from collections.abc import Sequence
from functools import partial
from itertools import zip_longest
from typing import NamedTuple

from reactive_realizer.bml.key_poses import KeyPose, KeyPoses, LookAtGoal, OrientationGoal
from reactive_realizer.bml.time_warps import warped
from reactive_realizer.bml.vocabulary import BodyGroup
from reactive_realizer.embodiment.joints import EYES
from reactive_realizer.engines.animation.easing import minimum_jerk
from reactive_realizer.engines.animation.faults import NoGoals, WrongElement
from reactive_realizer.engines.animation.key_poses.body_groups import group_joints
from reactive_realizer.engines.animation.key_poses.solved_pose import JointPose
from reactive_realizer.engines.animation.motion_maker import MakerContext, MotionRequest
from reactive_realizer.engines.animation.motions.eye_keys import EyeKey, EyeKeysMotionUnit
from reactive_realizer.engines.animation.motions.key_poses import Key, KeyPosesMotionUnit
from reactive_realizer.engines.animation.motions.pose_goals import EYE_GROUPS, PoseGoals
from reactive_realizer.engines.animation.shortest import Profile
from reactive_realizer.engines.animation.tcb import Tcb
from reactive_realizer.errors import RealizerError


def _speed(pose: KeyPose, behavior: KeyPoses, *, curved: bool) -> Profile:
    """Return the completed share of the way to a pose after a share of its time; a curve has a speed of its own."""
    warping = pose if pose.warp is not None else behavior
    if warping.warp is None:
        return _steady if curved else minimum_jerk
    return partial(warped, kind=warping.warp, steepness=warping.steepness)


def _steady(time: float) -> float:
    return time


class _Met(NamedTuple):
    """A key pose that the figure can have.

    Attributes:
        begins: when the way to it begins, s after the start of the motion.
        pose: as written.
        goals: the state.
    """

    begins: float
    pose: KeyPose
    goals: JointPose

    def tcb(self, after: "_Met | None") -> Tcb | None:
        """Return how a curve passes it, before the pose after it; None if the motion stops there."""
        pose = self.pose
        passed = after is not None and self.begins < pose.time == after.begins
        return Tcb(**pose.curve) if pose.curve and passed else None


def _keys(met: Sequence[_Met], behavior: KeyPoses) -> list[Key]:
    """Return key poses in time."""
    tcbs = [each.tcb(after) for each, after in zip_longest(met, met[1:])]
    return [
        Key(
            begins=each.begins,
            reached=each.pose.time,
            left=each.pose.time + each.pose.hold,
            profile=_speed(each.pose, behavior, curved=tcb is not None or before is not None),
            pose=each.goals,
            location=each.pose.location,
            power=each.pose.power,
            tcb=tcb,
        )
        for each, before, tcb in zip(met, (None, *tcbs), tcbs, strict=False)
    ]


class KeyPosesMaker:
    """Makes motions of key poses. Goals that the figure cannot have are left out with a note each."""

    def __init__(self, context: MakerContext) -> None:
        self._context = context

    def __call__(self, request: MotionRequest) -> KeyPosesMotionUnit | EyeKeysMotionUnit:
        """Make a motion.

        Raises:
            RealizerError: "no-goals": none of its goals can be met.
        """
        behavior = request.behavior
        if not isinstance(behavior, KeyPoses):
            raise RealizerError(WrongElement(unit="key-poses", element=behavior.name))
        rest = self._context.rest.body
        goals = PoseGoals(behavior.group, self._context, rest)
        motion = self._eyes(behavior, goals) if behavior.group in EYE_GROUPS else self._joints(behavior, goals)
        motion.notes = goals.notes
        return motion

    def _joints(self, behavior: KeyPoses, goals: PoseGoals) -> KeyPosesMotionUnit:
        """Make a motion of joints.

        Raises:
            RealizerError: "no-goals".
        """
        met: list[_Met] = []
        left = 0.0
        for pose in behavior.poses:
            solved = goals.solved(pose.goals)
            if solved is not None:
                met.append(_Met(left, pose, solved))
            left = pose.time + pose.hold
        keys = _keys(met, behavior)
        if not keys:
            raise _none(goals)
        points = {pose.id: pose.time for pose in behavior.poses if pose.id}
        fades = behavior.fade_in, behavior.fade_out
        whole = behavior.group is BodyGroup.WHOLEBODY
        return KeyPosesMotionUnit(behavior.id, keys, self._context.rest.body, points, fades, whole_body=whole)

    def _eyes(self, behavior: KeyPoses, goals: PoseGoals) -> EyeKeysMotionUnit:
        """Make a motion of eyes; of several goals of a pose, the last one counts.

        Raises:
            RealizerError: "no-goals".
        """
        keys = [
            EyeKey.of(pose, looks[-1])
            for pose in behavior.poses
            if (looks := [goal for goal in goals.met(pose.goals) if isinstance(goal, LookAtGoal | OrientationGoal)])
        ]
        if not keys:
            raise _none(goals)
        rest = self._context.rest.body
        motion = EyeKeysMotionUnit(behavior, keys, frozenset(group_joints(behavior.group, rest.skeleton)), rest)
        motion.lacking = frozenset(EYES if behavior.group is BodyGroup.EYES else ()).difference(rest.skeleton.joints)
        return motion


def _none(goals: PoseGoals) -> RealizerError:
    """Return why no goal can be met."""
    return RealizerError(goals.notes[0] if len(goals.notes) == 1 else NoGoals(reasons=goals.reasons))
