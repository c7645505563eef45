"""What a MURML description means: the goals of two hands along a course, or key frames.

After A. Kranstedt, S. Kopp and I. Wachsmuth, "MURML: a multimodal utterance representation markup language for
conversational agents" (SFB 360, report 2002/05), and the MURML of AsapRealizer.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from enum import StrEnum

from reactive_realizer.bml.key_poses import Coordinates
from reactive_realizer.bml.names import Location

_FLAT = 1e-6
"""A sigmoid that rises less between its ends is a straight line."""

STRAIGHT: Coordinates = (1.0, 1.0, 1.0)
"""The signs of coordinates that are not mirrored."""


class Slot(StrEnum):
    """A feature of a hand."""

    HAND_LOCATION = "HandLocation"
    HAND_SHAPE = "HandShape"
    EXT_FINGER_ORIENTATION = "ExtFingerOrientation"
    PALM_ORIENTATION = "PalmOrientation"


class Scope(StrEnum):
    """An arm."""

    LEFT = "left_arm"
    RIGHT = "right_arm"


def signed(vector: Coordinates, signs: Coordinates) -> Coordinates:
    """A vector with each coordinate times a sign."""
    return (vector[0] * signs[0], vector[1] * signs[1], vector[2] * signs[2])


@dataclass(frozen=True, slots=True)
class Mirror:
    """The relation of the other hand to the dominant one.

    Attributes:
        place: signs of the coordinates of places, from the pelvis.
        direction: signs of those of directions.
    """

    place: Coordinates
    direction: Coordinates


@dataclass(frozen=True, slots=True)
class GesturePlace:
    """A place in gesture space, in proportion to the body.

    Attributes:
        height: 0 at the pelvis, 1 at the shoulders, 2 at the eyes.
        angle: to the figure's left, degrees.
        distance: ahead from the middle of the body, in lengths of the arm.
        signs: of its coordinates from the pelvis, -1 where it is mirrored.
    """

    height: float
    angle: float
    distance: float
    signs: Coordinates = STRAIGHT

    def mirrored(self, mirror: Mirror) -> "GesturePlace":
        """The place of the other hand."""
        return replace(self, signs=signed(self.signs, mirror.place))


@dataclass(frozen=True, slots=True)
class Point:
    """A place in meters.

    Attributes:
        target: from the pelvis, in the figure's axes.
    """

    target: Coordinates

    def mirrored(self, mirror: Mirror) -> "Point":
        """The place of the other hand."""
        return Point(signed(self.target, mirror.place))


@dataclass(frozen=True, slots=True)
class Shift:
    """A place relative to the one before it.

    Attributes:
        direction: in the figure's axes, of any length above 0.
        distance: in lengths of the arm.
    """

    direction: Coordinates
    distance: float

    def mirrored(self, mirror: Mirror) -> "Shift":
        """The place of the other hand."""
        return replace(self, direction=signed(self.direction, mirror.direction))


@dataclass(frozen=True, slots=True)
class Heading:
    """A direction of the fingers or of the palm.

    Attributes:
        direction: in the figure's axes, of any length above 0.
    """

    direction: Coordinates

    def mirrored(self, mirror: Mirror) -> "Heading":
        """The direction of the other hand."""
        return Heading(signed(self.direction, mirror.direction))


@dataclass(frozen=True, slots=True)
class HandShape:
    """A shape of the hand.

    Attributes:
        pose: name of its file, without suffix.
    """

    pose: str

    def mirrored(self, mirror: Mirror) -> "HandShape":
        """The shape of the other hand."""
        return self


SlotValue = GesturePlace | Point | Shift | Heading | HandShape


@dataclass(frozen=True, slots=True)
class Bend:
    """The curve of a way; without one, it is straight.

    Attributes:
        normal: of its plane, in the figure's axes, of any length above 0.
        height: in lengths of the chord; positive to the left of the way, seen from the tip of the normal.
        double: whether it is an S, whose second half is bent to the other side, and not a C.
        roundness: 1 if it is pointed, 0 if it is round, -1 if it is broad.
        skewedness: where a C is highest, and which half of an S is higher: from -1, toward the start, to 1.
    """

    normal: Coordinates
    height: float
    double: bool
    roundness: float = 0.0
    skewedness: float = 0.0

    def mirrored(self, mirror: Mirror) -> "Bend":
        """The curve of the other hand."""
        x, y, z = mirror.direction
        turned = x * y * z  # a reflection exchanges left and right
        return replace(self, normal=signed(self.normal, mirror.direction), height=self.height * turned)


@dataclass(frozen=True, slots=True)
class Mark:
    """The value of a slot at a position of the stroke.

    Attributes:
        position: 0 at its start; each movement takes 1.
        value: there.
        location: of its element.
        bend: of the way there.
        id: name of the position as a sync point.
    """

    position: float
    value: SlotValue
    location: Location = field(compare=False)
    bend: Bend | None = None
    id: str | None = None


@dataclass(frozen=True, slots=True)
class Track:
    """The values of a slot of one arm. Before the first one, the slot is free; after the last one, it is kept.

    Attributes:
        slot: of the hand.
        scope: the arm.
        marks: one or more, in the order of position.
    """

    slot: Slot
    scope: Scope
    marks: tuple[Mark, ...]


@dataclass(frozen=True, slots=True)
class Frame:
    """A key frame.

    Attributes:
        time: s, after the start.
        values: of the joints (three numbers: roll, pitch and yaw in degrees) or of the morph targets (the first: in
            percent).
        location: of its element.
    """

    time: float
    values: Mapping[str, tuple[float, ...]]
    location: Location = field(compare=False)


@dataclass(frozen=True, slots=True)
class Keyframing:
    """Key frames.

    Attributes:
        frames: one or more, in the order of time.
        ease_scale: steepness of the sigmoid by which each way to a frame passes; at 0, it passes evenly.
        ease_turning_point: of that sigmoid, as a share of the time.
        from_current: whether it begins with the present pose, and not with the first frame.
        added: whether it is added to other motion, and does not replace it.
    """

    frames: tuple[Frame, ...]
    ease_scale: float
    ease_turning_point: float
    from_current: bool
    added: bool = False

    def progress(self, share: float) -> float:
        """The completed share of a way to a frame, 0 to 1, after a share of its time.

        The function of AsapRealizer, which applies it to the time of the whole animation; here it passes between two
        frames, so that every frame is reached at its time.
        """
        if share <= 0.0 or share >= 1.0:
            return min(1.0, max(0.0, share))
        low, here, high = (self._sigmoid(at) for at in (0.0, share, 1.0))
        return share if high - low < _FLAT else (here - low) / (high - low)

    def _sigmoid(self, share: float) -> float:
        return 1.0 / (1.0 + math.exp(-self.ease_scale * (share - self.ease_turning_point)))


@dataclass(frozen=True, slots=True)
class MurmlDescription:
    """A description: either key frames, or tracks.

    Attributes:
        keyframing: if it has key frames.
        tracks: the constraints of the hands.
    """

    keyframing: Keyframing | None = None
    tracks: tuple[Track, ...] = ()
