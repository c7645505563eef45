"""Key poses: motion as states of a part of the body at times, in our own namespace.

What a pose requires is described by goals: a place of a joint, a direction of a hand, a pose from a file. After the
animation layer of EMBR: A. Heloir and M. Kipp, "Real-time animation of interactive agents: specification and
realization" (Applied Artificial Intelligence 24, 2010).
"""

from dataclasses import dataclass, field
from typing import ClassVar

from reactive_realizer.bml.attribute_types import Duration, Enumeration, Float, Id, Text, Vector
from reactive_realizer.bml.attributes import attribute
from reactive_realizer.bml.behavior import Behavior, SyncPoints
from reactive_realizer.bml.expressivity import MOST
from reactive_realizer.bml.names import OWN, Location
from reactive_realizer.bml.vocabulary import BodyAxis, BodyGroup, WarpKind

Coordinates = tuple[float, float, float]
"""To the figure's left, up, and ahead."""

STEEPNESS = (0.01, 20.0)
"""Least and greatest steepness of a time warp."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PositionGoal:
    """A joint is at a place.

    Attributes:
        target: from the pelvis, in the figure's axes, m.
        joint: H-Anim name; None for the wrist of an arm.
        offset: from the joint to the point that is to be there, in the joint's axes, m.
        location: of its element.
    """

    ELEMENT: ClassVar[str] = "position"

    target: Coordinates = field(metadata=attribute(Vector()))
    joint: str | None = field(default=None, metadata=attribute(Text()))
    offset: Coordinates = field(default=(0.0, 0.0, 0.0), metadata=attribute(Vector()))
    location: Location = field(compare=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class OrientationGoal:
    """A hand, the head, the trunk, a collarbone or the eyes have a direction; they may still turn about it.

    Attributes:
        direction: of the axis, in the figure's axes; of any length above 0.
        axis: of the part of the body.
        joint: H-Anim name of the joint that has it; None for the wrist, the head or the upper chest, and for both
            shoulders, of which the direction is that of the left one.
        location: of its element.
    """

    ELEMENT: ClassVar[str] = "orientation"

    direction: Coordinates = field(metadata=attribute(Vector()))
    axis: BodyAxis = field(default=BodyAxis.PALM, metadata=attribute(Enumeration(BodyAxis)))
    joint: str | None = field(default=None, metadata=attribute(Text()))
    location: Location = field(compare=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class SwivelGoal:
    """An elbow is turned out about the line from shoulder to wrist.

    Attributes:
        angle: degrees, from the elbow at rest below the line; positive away from the body.
        location: of its element.
    """

    ELEMENT: ClassVar[str] = "swivel"

    angle: float = field(metadata=attribute(Float(-180, 180)))
    location: Location = field(compare=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class LookAtGoal:
    """The head or the eyes look at a place.

    Attributes:
        target: from the pelvis, in the figure's axes, m.
        location: of its element.
    """

    ELEMENT: ClassVar[str] = "lookAt"

    target: Coordinates = field(metadata=attribute(Vector()))
    location: Location = field(compare=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class PoseGoal:
    """The joints have the rotations of a pose in a file.

    Attributes:
        pose: name of its file, without suffix.
        influence: share of the way from the rest pose.
        location: of its element.
    """

    ELEMENT: ClassVar[str] = "pose"

    pose: str = field(metadata=attribute(Text(), "name"))
    influence: float = field(default=1.0, metadata=attribute(Float(0, 1)))
    location: Location = field(compare=False)


KeyPoseGoal = PositionGoal | OrientationGoal | SwivelGoal | LookAtGoal | PoseGoal
"""A requirement of a key pose: a position, an orientation, a swivel, a direction or a stored pose."""

GOALS: tuple[type[KeyPoseGoal], ...] = (PositionGoal, OrientationGoal, SwivelGoal, LookAtGoal, PoseGoal)


@dataclass(frozen=True, slots=True, kw_only=True)
class KeyPose:
    """The state of a part of the body at a time.

    Attributes:
        time: at which it is reached, after the start of its sequence, s.
        hold: for which it is kept, s.
        id: name of its time as a sync point; None if it is none.
        warp: time warp of the way to it; None for that of the sequence.
        steepness: of its warp.
        power: of the way to it (`Expressivity`).
        tension: of the curve on which the motion passes it; None as continuity and bias.
        continuity: of that curve.
        bias: of that curve. Without any of the three, and with a hold, the motion stops at the pose.
        goals: one or more.
        location: of its element.
    """

    ELEMENT: ClassVar[str] = "keyPose"

    time: float = field(metadata=attribute(Duration()))
    hold: float = field(default=0.0, metadata=attribute(Duration()))
    id: str | None = field(default=None, metadata=attribute(Id()))
    warp: WarpKind | None = field(default=None, metadata=attribute(Enumeration(WarpKind)))
    steepness: float = field(default=1.0, metadata=attribute(Float(*STEEPNESS)))
    power: float = field(default=0.0, metadata=attribute(Float(-MOST, MOST)))
    tension: float | None = field(default=None, metadata=attribute(Float(-1, 1)))
    continuity: float | None = field(default=None, metadata=attribute(Float(-1, 1)))
    bias: float | None = field(default=None, metadata=attribute(Float(-1, 1)))
    goals: tuple[KeyPoseGoal, ...]
    location: Location = field(compare=False)

    @property
    def curve(self) -> dict[str, float]:
        """The given ones of tension, continuity and bias."""
        given = {"tension": self.tension, "continuity": self.continuity, "bias": self.bias}
        return {name: value for name, value in given.items() if value is not None}


@dataclass(frozen=True, slots=True, kw_only=True)
class KeyPoses(Behavior):
    """Moves a part of the body through key poses.

    It relaxes after the hold of the last one. Each pose with an id is a sync point. It lies above all motion of the
    same joints that started before it.

    Attributes:
        group: the part of the body that it moves.
        fade_in: time in which it takes over the joints, s.
        fade_out: time in which it releases them, from relax to end, s.
        warp: time warp of the ways to its poses; None for the natural speed of a reach.
        steepness: of its warp.
        poses: one or more, in the order of time; each starts after the hold of the one before.
    """

    NAMESPACE = OWN
    CHILDREN: ClassVar = (KeyPose.ELEMENT,)
    SYNC_POINTS: ClassVar[SyncPoints] = ("start", "relax", "end")
    OPEN_POINTS = True

    group: BodyGroup = field(metadata=attribute(Enumeration(BodyGroup)))
    fade_in: float = field(default=0.0, metadata=attribute(Duration()))
    fade_out: float = field(default=0.0, metadata=attribute(Duration()))
    warp: WarpKind | None = field(default=None, metadata=attribute(Enumeration(WarpKind)))
    steepness: float = field(default=1.0, metadata=attribute(Float(*STEEPNESS)))
    poses: tuple[KeyPose, ...]
