"""The state of a group of joints that meets all goals of a key pose."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple, Protocol

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import Quat, slerp
from reactive_realizer.embodiment.two_bone_ik import Arm
from reactive_realizer.engines.animation.key_poses.arm_pose import ArmGoals
from reactive_realizer.engines.animation.key_poses.direction import Unturned
from reactive_realizer.engines.animation.key_poses.head_pose import HeadPose
from reactive_realizer.engines.animation.key_poses.trunk_pose import ShoulderPose, TrunkPose
from reactive_realizer.engines.animation.spine_ik import HandGoal


class Missed(NamedTuple):
    """A joint that is not at its place.

    Attributes:
        joint: H-Anim name.
        distance: from there, m.
        share: that distance in lengths of the limb.
    """

    joint: str
    distance: float
    share: float


class SolvedRotations(NamedTuple):
    """The rotations of a key pose.

    Attributes:
        rotations: of its joints, local to their parents.
        missed: a goal that is out of reach; None if there is none.
    """

    rotations: Mapping[str, Quat]
    missed: Missed | None = None


class JointPose(Protocol):
    """The state of some joints in a key pose."""

    @property
    def joints(self) -> frozenset[str]:
        """The joints that it turns."""
        ...

    def solve(self, body: Body, rest: Mapping[str, Quat]) -> SolvedRotations:
        """Return the rotations of its joints.

        Args:
            body: whose trunk carries arms and head.
            rest: rotations of its joints without goals.
        """
        ...

    def unturned(self, body: Body, rest: Mapping[str, Quat]) -> Iterable[Unturned]:
        """Return by how much joints fall short of the directions that they are to have.

        Args:
            body: that has the pose.
            rest: rotations of its joints without goals.
        """
        ...

    def hands(self, body: Body, rest: Mapping[str, Quat]) -> tuple[HandGoal, ...]:
        """Return where hands are to be, so that the trunk may lean for them.

        Args:
            body: whose trunk does not lean.
            rest: rotations of its joints without goals.
        """
        ...


@dataclass(frozen=True, slots=True)
class SeveralPoses:
    """The states of several groups of joints, such as both arms.

    Attributes:
        poses: of different joints.
    """

    poses: tuple[JointPose, ...]

    @property
    def joints(self) -> frozenset[str]:
        """The joints that it turns."""
        return frozenset(joint for pose in self.poses for joint in pose.joints)

    def solve(self, body: Body, rest: Mapping[str, Quat]) -> SolvedRotations:
        """Return the rotations of its joints; of several goals out of reach, the first is reported."""
        solved = [pose.solve(body, rest) for pose in self.poses]
        rotations = {joint: turn for each in solved for joint, turn in each.rotations.items()}
        return SolvedRotations(rotations, next((each.missed for each in solved if each.missed is not None), None))

    def unturned(self, body: Body, rest: Mapping[str, Quat]) -> tuple[Unturned, ...]:
        """Return by how much joints fall short of their directions."""
        return tuple(each for pose in self.poses for each in pose.unturned(body, rest))

    def hands(self, body: Body, rest: Mapping[str, Quat]) -> tuple[HandGoal, ...]:
        """Return where hands are to be."""
        return tuple(hand for pose in self.poses for hand in pose.hands(body, rest))


@dataclass(frozen=True, slots=True)
class SolvedPose:
    """The goals of a key pose, ready to be met.

    Other goals come before stored rotations.

    Attributes:
        stored: rotations of joints, as in a file.
        influence: share of the way from the rest pose to the stored rotations.
        arm: goals of an arm.
        carrying: goals of a head, a trunk or shoulders.
    """

    stored: Mapping[str, Quat] = field(default_factory=dict)
    influence: float = 1.0
    arm: ArmGoals | None = None
    carrying: HeadPose | TrunkPose | ShoulderPose | None = None

    @property
    def joints(self) -> frozenset[str]:
        """The joints that it turns."""
        parts = (self.stored, self.arm.joints if self.arm else (), self.carrying.joints if self.carrying else ())
        return frozenset(joint for part in parts for joint in part)

    def solve(self, body: Body, rest: Mapping[str, Quat]) -> SolvedRotations:
        """Return the rotations of its joints.

        Args:
            body: whose trunk carries arms and head.
            rest: rotations of its joints without goals.
        """
        rotations = {joint: slerp(rest[joint], goal, self.influence) for joint, goal in self.stored.items()}
        missed = None
        if self.carrying is not None:
            rotations |= self.carrying.solve(body, rest)
        if self.arm is not None:
            end = f"{self.arm.side}_wrist"
            solved = self.arm.solve(body, rotations.get(end, rest[end]))
            rotations |= {joint: solved.rotations[joint] for joint in self.arm.joints}
            if solved.missing > 0.0:
                reach = Arm.of(body.skeleton, self.arm.side).reach
                missed = Missed(end, solved.missing, solved.missing / reach)
        return SolvedRotations(rotations, missed)

    def unturned(self, body: Body, rest: Mapping[str, Quat]) -> tuple[Unturned, ...]:
        """Return by how much joints fall short of their directions."""
        carrying = () if self.carrying is None else tuple(self.carrying.unturned(body, rest))
        return carrying if self.arm is None else (*carrying, *self.arm.unturned(body))

    def hands(self, body: Body, rest: Mapping[str, Quat]) -> tuple[HandGoal, ...]:
        """Return where its hand is to be; nothing if that only turns."""
        goal = None if self.arm is None else self.arm.hand_goal(body, rest[f"{self.arm.side}_wrist"])
        return () if goal is None else (goal,)
