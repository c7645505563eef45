"""The behaviors of the whole body's posture."""

from dataclasses import dataclass, field

from reactive_realizer.bml.attribute_types import Text, Word
from reactive_realizer.bml.attributes import attribute
from reactive_realizer.bml.behavior import Behavior, SyncPoints
from reactive_realizer.bml.words import PosePart, StanceType

_POSTURE_POINTS: SyncPoints = ("start", "ready", "relax", "end")


@dataclass(frozen=True, slots=True, kw_only=True)
class Stance:
    """The global body position of a posture."""

    type: StanceType = field(metadata=attribute(Word(StanceType)))


@dataclass(frozen=True, slots=True, kw_only=True)
class Pose:
    """What a posture asks of one part of the body, by an open word such as ARMS_CROSSED."""

    part: PosePart = field(metadata=attribute(Word(PosePart)))
    lexeme: str = field(metadata=attribute(Text()))


@dataclass(frozen=True, slots=True, kw_only=True)
class Posture(Behavior):
    """Takes a posture, and returns to the base posture.

    Attributes:
        stance: None leaves it as it is; there is a stance or a pose.
        poses: at most one for each part.
    """

    CHILDREN = ("stance", "pose")
    SYNC_POINTS = _POSTURE_POINTS

    stance: StanceType | None
    poses: tuple[Pose, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class PostureShift(Posture):
    """As a posture; it becomes the base posture."""

    SYNC_POINTS = ("start", "end")
