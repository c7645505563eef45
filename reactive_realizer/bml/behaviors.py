"""The behaviors of BML 1.0 and its core extensions, apart from speech.

The name of an element is the name of its class with a lowercase first letter. Where readers of the standard disagree
about a default, it is the one of OpenBMLParser.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Final

from reactive_realizer.bml.attribute_types import Duration, Enumeration, EventName, Float, Integer, Target, Text
from reactive_realizer.bml.attributes import attribute
from reactive_realizer.bml.behavior import Behavior, SyncPoints
from reactive_realizer.bml.faults import TwoEnds
from reactive_realizer.bml.names import ANTICIPATORS, BML_EXT, EVENTS, OWN
from reactive_realizer.bml.sync_ref import SyncRef
from reactive_realizer.bml.vocabulary import Influence, Mode, OffsetDirection, PosePart, Side, StanceType
from reactive_realizer.errors import RealizerError

_STROKE_POINTS: SyncPoints = ("start", "ready", "strokeStart", "stroke", "strokeEnd", "relax", "end")
_HOLD_POINTS: SyncPoints = ("start", "ready", "relax", "end")
_FACE_POINTS: SyncPoints = ("start", "attackPeak", "relax", "end")
_START_AND_END: SyncPoints = ("start", "end")


MOST_REPETITIONS: Final = 100
"""Limit on the strokes of a head behavior; each stroke is a sync point."""

_MOST_ACTION_UNITS: Final = 99

# The drafts before BML 1.0 say NECK and TORSO.
_INFLUENCE: Final = Enumeration(Influence, {"NECK": Influence.HEAD, "TORSO": Influence.WAIST})


# --- hands


@dataclass(frozen=True, slots=True, kw_only=True)
class Gesture(Behavior):
    """Moves arms and hands.

    Attributes:
        lexeme: a word of an open vocabulary.
        mode: the hands; None leaves the choice to the realizer.
    """

    SYNC_POINTS = _STROKE_POINTS
    OPEN_POINTS = True

    lexeme: str = field(metadata=attribute(Text()))
    mode: Mode | None = field(default=None, metadata=attribute(Enumeration(Mode)))


REFERENCE: Final = (OWN, "reference")
"""The attribute of a gesture, a head movement or a posture with its name in a library of motions; its lexeme is a word
for whoever has no such library."""

REACH: Final = (OWN, "reach")
"""The attribute of a pointing whose hand goes to its target; a word of `Reach`."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Pointing(Behavior):
    """Points at a target.

    Attributes:
        target: what it points at.
        mode: the hand; None leaves the choice to the realizer.
    """

    SYNC_POINTS = _STROKE_POINTS

    target: str = field(metadata=attribute(Target()))
    mode: Mode | None = field(default=None, metadata=attribute(Enumeration(Mode)))


# --- head and gaze


@dataclass(frozen=True, slots=True, kw_only=True)
class Head(Behavior):
    """Moves the head rhythmically.

    Attributes:
        lexeme: NOD, SHAKE, or another word.
        repetition: number of strokes.
        amount: extent of the movement, 0 to 1.
    """

    SYNC_POINTS = _STROKE_POINTS
    OPEN_POINTS = True

    lexeme: str = field(metadata=attribute(Text()))
    repetition: int = field(default=1, metadata=attribute(Integer(1, MOST_REPETITIONS)))
    amount: float = field(default=0.5, metadata=attribute(Float(0, 1)))

    @property
    def sync_points(self) -> tuple[str, ...]:
        """All sync points; with several repetitions, ``stroke:1`` to ``stroke:n`` replace ``stroke``."""
        if self.repetition == 1:
            return _STROKE_POINTS
        strokes = (f"stroke:{number}" for number in range(1, self.repetition + 1))
        return (*_STROKE_POINTS[:3], *strokes, *_STROKE_POINTS[4:])


@dataclass(frozen=True, slots=True, kw_only=True)
class HeadDirectionShift(Behavior):
    """Turns the head to a target and keeps it there."""

    SYNC_POINTS = _START_AND_END

    target: str = field(metadata=attribute(Target()))


@dataclass(frozen=True, slots=True, kw_only=True)
class Gaze(Behavior):
    """Looks at a target, then back.

    Attributes:
        target: what is looked at.
        influence: the part of the body that turns; None leaves the choice to the realizer.
        offset_angle: angle between the gaze and the target, degrees.
        offset_direction: direction of that angle.
    """

    SYNC_POINTS = _HOLD_POINTS

    target: str = field(metadata=attribute(Target()))
    influence: Influence | None = field(default=None, metadata=attribute(_INFLUENCE))
    offset_angle: float = field(default=0.0, metadata=attribute(Float(-360, 360)))
    offset_direction: OffsetDirection = field(
        default=OffsetDirection.RIGHT, metadata=attribute(Enumeration(OffsetDirection))
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class GazeShift(Gaze):
    """Looks at a target, which becomes the target of the resting gaze."""

    SYNC_POINTS = _START_AND_END


# --- face


@dataclass(frozen=True, slots=True, kw_only=True)
class FaceLexeme(Behavior):
    """A facial expression.

    Attributes:
        lexeme: a word of an open vocabulary, such as RAISE_BROWS.
        amount: strength of the expression, 0 to 1.
        overshoot: fraction by which the attack peak exceeds the amount.
    """

    SYNC_POINTS = _FACE_POINTS

    lexeme: str = field(metadata=attribute(Text()))
    amount: float = field(default=0.5, metadata=attribute(Float(0, 1)))
    overshoot: float = field(default=0.0, metadata=attribute(Float(0, 1)))


@dataclass(frozen=True, slots=True, kw_only=True)
class FaceFacs(Behavior):
    """An action unit of the Facial Action Coding System (Ekman and Friesen); a core extension.

    Attributes:
        au: number of the action unit.
        side: half of the face.
        amount: strength of the expression, 0 to 1.
    """

    NAMESPACE = BML_EXT
    SYNC_POINTS = _FACE_POINTS

    au: int = field(metadata=attribute(Integer(0, _MOST_ACTION_UNITS)))
    side: Side = field(default=Side.BOTH, metadata=attribute(Enumeration(Side)))
    amount: float = field(default=0.5, metadata=attribute(Float(0, 1)))


@dataclass(frozen=True, slots=True, kw_only=True)
class Face(Behavior):
    """Several expressions that are timed as one.

    Attributes:
        amount: strength of the whole, 0 to 1.
        overshoot: fraction by which the attack peak exceeds the amount.
        parts: the expressions; their ids may be empty, and they have no sync points of their own.
    """

    CHILDREN = ("faceLexeme", "faceFacs")
    SYNC_POINTS = _FACE_POINTS

    amount: float = field(default=0.5, metadata=attribute(Float(0, 1)))
    overshoot: float = field(default=0.0, metadata=attribute(Float(0, 1)))
    parts: tuple[FaceLexeme | FaceFacs, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class FaceShift(Face):
    """A face that becomes the resting face."""

    SYNC_POINTS = _START_AND_END


# --- the whole body


@dataclass(frozen=True, slots=True, kw_only=True)
class Stance:
    """The global body position of a posture."""

    type: StanceType = field(metadata=attribute(Enumeration(StanceType)))


@dataclass(frozen=True, slots=True, kw_only=True)
class Pose:
    """The pose of one part of the body.

    Attributes:
        part: of the body.
        lexeme: a word of an open vocabulary, such as ARMS_CROSSED.
    """

    part: PosePart = field(metadata=attribute(Enumeration(PosePart)))
    lexeme: str = field(metadata=attribute(Text()))


@dataclass(frozen=True, slots=True, kw_only=True)
class Posture(Behavior):
    """Takes a posture, then returns to the resting posture.

    Attributes:
        stance: None keeps the present one; then there is at least one pose.
        poses: at most one for each part of the body.
    """

    CHILDREN = ("stance", "pose")
    SYNC_POINTS = _HOLD_POINTS

    stance: StanceType | None
    poses: tuple[Pose, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class PostureShift(Posture):
    """A posture that becomes the resting posture."""

    SYNC_POINTS = _START_AND_END


@dataclass(frozen=True, slots=True, kw_only=True)
class Locomotion(Behavior):
    """Walks to a target, or moves there in another manner."""

    SYNC_POINTS = _START_AND_END

    target: str = field(default="", metadata=attribute(Target()))
    manner: str = field(default="WALK", metadata=attribute(Text()))


@dataclass(frozen=True, slots=True, kw_only=True)
class Wait(Behavior):
    """Does nothing for a while, or until an event.

    Attributes:
        duration: s; None if only the sync points determine it.
        max_wait: its maximum duration, s; None for no limit.
        event: name of the event that ends it, None for none.
    """

    SYNC_POINTS = _START_AND_END

    duration: float | None = field(default=None, metadata=attribute(Duration()))
    max_wait: float | None = field(default=None, metadata=attribute(Duration(), "max-wait"))
    event: str | None = field(default=None, metadata=attribute(EventName()))

    @classmethod
    def complete_syncs(
        cls, syncs: Mapping[str, SyncRef], values: Mapping[str, object], namespace: str
    ) -> Mapping[str, SyncRef]:
        """Ties its end to its event.

        Raises:
            RealizerError: ``two-ends``: its end is tied to something else, or it has a duration.
        """
        if (event := values.get("event")) is None:
            return syncs
        other = "duration" if values.get("duration") is not None else "end"
        if other == "duration" or other in syncs:
            raise RealizerError(TwoEnds(attribute=other))
        return MappingProxyType({**syncs, "end": SyncRef(ANTICIPATORS, EVENTS, str(event))})

    @property
    def until(self) -> SyncRef | None:
        """The point for which it waits, at most for ``max_wait``; None if it has a duration, or ends as others say.

        A point of its own block is no such point: the block is planned so that the two come together.
        """
        end = self.syncs.get("end")
        limited = self.duration is None and self.max_wait is not None
        return end if (limited and end is not None and end.block is not None) or self.event is not None else None
