"""Turns the goals of key poses into what a figure can do."""

import math
from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property, lru_cache
from pathlib import Path
from typing import Final

from reactive_realizer.binding.asset_file import first_asset
from reactive_realizer.bml.key_poses import KeyPoseGoal, LookAtGoal, OrientationGoal, PoseGoal, PositionGoal, SwivelGoal
from reactive_realizer.bml.vocabulary import BodyAxis, BodyGroup
from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.joints import HEAD, other_side
from reactive_realizer.embodiment.quaternion import Quat, conjugate, multiply, rotate
from reactive_realizer.embodiment.vector import FORWARD, Vec3, add, length, subtract, unit
from reactive_realizer.engines.animation.faults import GoalOverruled, NoDirection, NoGroupJoints, NotOfGroup
from reactive_realizer.engines.animation.key_poses.arm_pose import ArmGoals, hand_axes
from reactive_realizer.engines.animation.key_poses.body_groups import group_joints
from reactive_realizer.engines.animation.key_poses.direction import Direction
from reactive_realizer.engines.animation.key_poses.head_pose import HEAD_AXES, WEIGHTS, HeadPose
from reactive_realizer.engines.animation.key_poses.solved_pose import SolvedPose
from reactive_realizer.engines.animation.key_poses.trunk_pose import (
    TRUNK_AXES,
    ShoulderPose,
    TrunkPose,
    shoulder_axis,
)
from reactive_realizer.engines.animation.keyframe.clip_files import CLIPS, is_capture, load_clip
from reactive_realizer.engines.animation.keyframe.keyframe_files import read_skeleton_pose
from reactive_realizer.engines.animation.motion_maker import MakerContext
from reactive_realizer.errors import Fault, RealizerError

_ARMS: Final = {BodyGroup.LEFT_ARM: "l", BodyGroup.RIGHT_ARM: "r"}
EYE_GROUPS: Final = (BodyGroup.EYES, BodyGroup.LEFT_EYE, BodyGroup.RIGHT_EYE)
"""The groups whose goals direct the eyes (`EyeKeysMotionUnit`)."""
_LOOKING: Final = (*WEIGHTS, *EYE_GROUPS)
_OF_EYES: Final = (LookAtGoal.ELEMENT, OrientationGoal.ELEMENT)
_SHORTEST: Final = 1e-6
"""A shorter vector has no direction."""


class PoseGoals:
    """The goals of the key poses of one group.

    Attributes:
        notes: faults of goals that are left out, each name or kind once, with the location of its first one.
    """

    def __init__(self, group: BodyGroup, context: MakerContext, rest: Body) -> None:
        self._group = group
        self._context = context
        self._rest = rest
        self._skeleton = context.humanoid.avatar.skeleton
        self._side = _ARMS.get(group)
        self._stored: dict[str, Mapping[str, Quat]] = {}
        self._notes: dict[str, Fault] = {}
        self._place: Vec3 | None = None
        self._tip: Vec3 = (0.0, 0.0, 0.0)

    @property
    def notes(self) -> tuple[Fault, ...]:
        """The faults of goals that are left out."""
        return tuple(self._notes.values())

    @property
    def reasons(self) -> tuple[str, ...]:
        """The sentences of the notes."""
        return tuple(fault.sentence for fault in self.notes)

    def met(self, goals: Iterable[KeyPoseGoal]) -> list[KeyPoseGoal]:
        """Return the goals of a pose that the figure can meet."""
        possible = [goal for goal in goals if self._is_met(goal)]
        if len(possible) < 2:
            return possible
        overruled = self._overruled(possible)
        for goal, why in overruled:
            self._note(goal, GoalOverruled(goal=goal.ELEMENT, why=why))
        return [goal for goal in possible if all(goal is not other for other, _ in overruled)]

    def _overruled(self, goals: Sequence[KeyPoseGoal]) -> list[tuple[KeyPoseGoal, str]]:
        """Return the goals of a pose without effect, and why: of orientations, two count, of other goals, the last."""
        kinds: dict[tuple[str, str | None], list[KeyPoseGoal]] = {}
        for goal in goals:
            joint = goal.joint if isinstance(goal, OrientationGoal) else None
            kind = "" if self._group in EYE_GROUPS else goal.ELEMENT
            kinds.setdefault((kind, joint), []).append(goal)
        found: list[tuple[KeyPoseGoal, str]] = []
        for (kind, _), own in kinds.items():
            if kind == OrientationGoal.ELEMENT and self._group is not BodyGroup.SHOULDERS:
                found += ((goal, "two others of this key pose come before it") for goal in own[2:])
            else:
                found += ((goal, "a later one of this key pose counts") for goal in own[:-1])
        if self._group in WEIGHTS and (LookAtGoal.ELEMENT, None) in kinds:
            faced = (goal for goal in goals if isinstance(goal, OrientationGoal) and goal.axis is BodyAxis.FACE)
            found += ((goal, "the face looks at a place in this key pose") for goal in faced)
        return found

    def solved(self, goals: Iterable[KeyPoseGoal]) -> SolvedPose | None:
        """Return the pose that meets goals; None if the figure can meet none of them."""
        met = self.met(goals)
        if not met:
            return None
        stored = [goal for goal in met if isinstance(goal, PoseGoal)]
        rotations = self._stored[stored[-1].pose] if stored else {}
        influence = stored[-1].influence if stored else 1.0
        others = [goal for goal in met if not isinstance(goal, PoseGoal)]
        arm = self._arm(others) if self._side and others else None
        return SolvedPose(rotations, influence, arm, self._carrying(others) if others else None)

    def _carrying(self, goals: Sequence[KeyPoseGoal]) -> HeadPose | TrunkPose | ShoulderPose | None:
        """Return the goals of a head, a trunk or shoulders; None for those of an arm."""
        if self._group in WEIGHTS:
            return self._head(goals)
        directed = [goal for goal in goals if isinstance(goal, OrientationGoal)]
        if self._group is BodyGroup.TRUNK:
            return self._trunk(directed)
        return self._shoulders(directed) if self._group is BodyGroup.SHOULDERS else None

    def _is_met(self, goal: KeyPoseGoal) -> bool:
        """Return whether the figure can meet a goal; otherwise, note why not."""
        try:
            self._check(goal)
        except RealizerError as refused:
            self._note(goal, refused.fault)
            return False
        return True

    def _note(self, goal: KeyPoseGoal, fault: Fault) -> None:
        self._notes.setdefault(fault.sentence, fault.located(goal.location.line, goal.location.column))

    def _check(self, goal: KeyPoseGoal) -> None:
        """Check that the figure can meet a goal.

        Raises:
            RealizerError: with the reason.
        """
        kind = goal.ELEMENT
        match goal:
            case PoseGoal():
                if self._group in EYE_GROUPS:
                    raise RealizerError(NotOfGroup(goal=kind, group=self._group, known=_OF_EYES))
                if goal.pose not in self._stored:
                    self._stored[goal.pose] = stored_pose(goal.pose, self._group, self._context)
            case LookAtGoal():
                if self._group not in _LOOKING:
                    raise RealizerError(NotOfGroup(goal=kind, group=self._group, known=tuple(_LOOKING)))
                self._directed()
            case SwivelGoal():
                if self._side is None:
                    raise RealizerError(NotOfGroup(goal=kind, group=self._group, known=tuple(_ARMS)))
            case PositionGoal():
                if self._side is None:
                    raise RealizerError(NotOfGroup(goal=kind, group=self._group, known=tuple(_ARMS)))
                self._check_joint(goal.joint)
            case OrientationGoal():
                if goal.axis not in self._axes:
                    known = tuple(self._axes) or ("the axes of an arm, a head, a trunk, shoulders or eyes",)
                    raise RealizerError(NotOfGroup(goal=f"{kind} of {goal.axis}", group=self._group, known=known))
                directed = self._directed()
                if goal.joint is not None and goal.joint not in directed:
                    fault = NotOfGroup(goal=f"{kind} of {goal.joint}", group=self._group, known=directed)
                    raise RealizerError(fault)
                if length(goal.direction) < _SHORTEST:
                    raise RealizerError(NoDirection())

    @cached_property
    def _axes(self) -> Mapping[BodyAxis, Vec3]:
        """The axes of the group that may have directions."""
        if self._side is not None:
            return hand_axes(self._side, self._skeleton)
        if self._group is BodyGroup.SHOULDERS:
            return {BodyAxis.SHOULDER: shoulder_axis("l", self._skeleton)}
        if self._group is BodyGroup.TRUNK:
            return TRUNK_AXES
        if self._group in EYE_GROUPS:
            return {BodyAxis.SIGHT: FORWARD}
        return HEAD_AXES if self._group in WEIGHTS else {}

    def _directed(self) -> tuple[str, ...]:
        """Return the joints of the group that may have directions.

        Raises:
            RealizerError: "no-group-joints": the figure has none of them.
        """
        if self._side is not None:
            return (f"{self._side}_wrist",)
        joints = HEAD[1:] if self._group in WEIGHTS else group_joints(self._group, self._skeleton)
        if not joints:
            raise RealizerError(NoGroupJoints(group=self._group))
        return joints

    def _check_joint(self, joint: str | None) -> None:
        if joint is not None and (
            joint not in self._skeleton or f"{self._side}_wrist" not in self._skeleton.chain(joint)
        ):
            known = tuple(each for each in self._skeleton.joints if each.startswith(f"{self._side}_"))
            hand = tuple(each for each in known if f"{self._side}_wrist" in self._skeleton.chain(each))
            raise RealizerError(NotOfGroup(goal=f"position of {joint}", group=self._group, known=hand))

    def _arm(self, goals: Iterable[KeyPoseGoal]) -> ArmGoals:
        """Return the goals of an arm; without a place, the hand keeps the last one."""
        side = self._side or "r"
        directions: list[Direction] = []
        swivel: float | None = None
        for goal in goals:
            match goal:
                case PositionGoal():
                    self._place, self._tip = goal.target, self._tip_of(goal, side)
                case OrientationGoal():
                    directions.append(Direction(self._axes[goal.axis], unit(goal.direction)))
                case SwivelGoal():
                    swivel = math.radians(goal.angle)
                case LookAtGoal() | PoseGoal():
                    pass
        if swivel is not None and self._place is None:
            self._place = self._rest_place(side)
        return ArmGoals(side, self._place, self._tip, tuple(directions), swivel or 0.0)

    def _rest_place(self, side: str) -> Vec3:
        """Return where the wrist is at rest, from the pelvis, m."""
        pelvis, wrist = (self._rest.transform(joint).position for joint in (self._skeleton.joints[0], f"{side}_wrist"))
        return subtract(wrist, pelvis)

    def _tip_of(self, goal: PositionGoal, side: str) -> Vec3:
        """Return the point of a hand for which a goal is, in the axes of its wrist, m."""
        wrist = self._rest.transform(f"{side}_wrist")
        joint = self._rest.transform(goal.joint or f"{side}_wrist")
        back = conjugate(wrist.rotation)
        from_joint = rotate(multiply(back, joint.rotation), goal.offset)
        return add(rotate(back, subtract(joint.position, wrist.position)), from_joint)

    def _head(self, goals: Iterable[KeyPoseGoal]) -> HeadPose:
        place: Vec3 | None = None
        directions: list[Direction] = []
        for goal in goals:
            if isinstance(goal, LookAtGoal):
                place = goal.target
            elif isinstance(goal, OrientationGoal):
                directions.append(Direction(HEAD_AXES[goal.axis], unit(goal.direction)))
        return HeadPose(self._group, place, tuple(directions))

    def _trunk(self, goals: Iterable[OrientationGoal]) -> TrunkPose:
        spine = group_joints(self._group, self._skeleton)
        directions: dict[str, tuple[Direction, ...]] = {}
        for goal in sorted(goals, key=lambda goal: spine.index(goal.joint or spine[-1])):
            joint = goal.joint or spine[-1]
            directions[joint] = (*directions.get(joint, ()), Direction(TRUNK_AXES[goal.axis], unit(goal.direction)))
        return TrunkPose(spine, directions)

    def _shoulders(self, goals: Iterable[OrientationGoal]) -> ShoulderPose:
        """Return the goals of shoulders; a direction without a joint is mirrored for the right one."""
        ways: dict[str, Vec3] = {}
        for goal in goals:
            x, y, z = unit(goal.direction)
            if goal.joint is not None:
                ways[goal.joint[0]] = (x, y, z)
            else:
                both = {"l": (x, y, z), "r": (-x, y, z)}
                ways |= {joint[0]: both[joint[0]] for joint in group_joints(self._group, self._skeleton)}
        return ShoulderPose(ways)


def stored_pose(name: str, group: BodyGroup, context: MakerContext) -> Mapping[str, Quat]:
    """Return the rotations of a stored pose for the joints of a group; those of the other side are mirrored.

    Raises:
        RealizerError: there is no such file, it is invalid, or it has none of the joints.
    """
    skeleton = context.humanoid.avatar.skeleton
    joints = frozenset(group_joints(group, skeleton))
    path = first_asset(context.asset, *(f"**/{name}.{suffix}" for suffix in CLIPS))
    pose = _stored(path, path.stat().st_mtime_ns, skeleton)
    own = {joint: turn for joint, turn in pose.items() if joint in joints}
    if not own:
        mirrored = {other_side(joint): (w, x, -y, -z) for joint, (w, x, y, z) in pose.items()}
        own = {joint: turn for joint, turn in mirrored.items() if joint in joints}
    if not own:
        raise RealizerError(NotOfGroup(goal=f"pose {name}", group=group, known=tuple(pose)))
    return own


@lru_cache(256)
def _stored(path: Path, changed: int, skeleton: Skeleton) -> Mapping[str, Quat]:
    """Return the rotations of a file; of a capture, those of its last frame."""
    if is_capture(path):
        clip = load_clip(path, skeleton, 0.0)
        return clip.rotations_at(clip.times[-1])
    return read_skeleton_pose(path)
