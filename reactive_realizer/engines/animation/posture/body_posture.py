"""A posture as words: a stance, and what single parts of the body do otherwise."""

from collections.abc import Iterable
from dataclasses import dataclass

from reactive_realizer.bml.posture import Pose
from reactive_realizer.bml.words import StanceType
from reactive_realizer.engines.animation.posture.parts import JOINTS


@dataclass(frozen=True, slots=True)
class BodyPosture:
    """How a figure holds itself.

    Attributes:
        stance: its global position.
        poses: of parts of the body; of two that are about the same joints the later one holds.
    """

    stance: StanceType = StanceType.STANDING
    poses: tuple[Pose, ...] = ()

    def changed(self, stance: StanceType | None, poses: Iterable[Pose]) -> "BodyPosture":
        """This posture with another stance, if one is named, and other poses of the parts that are named.

        Crossed arms stay crossed when the figure sits down; a new pose of the arms ends an old one of the left arm.
        """
        new = tuple(poses)
        kept = (old for old in self.poses if not any(JOINTS[old.part] <= JOINTS[pose.part] for pose in new))
        return BodyPosture(stance or self.stance, (*kept, *new))
