"""The behaviors of BML 1.0 that move and speak; face.py and posture.py have those made of parts.

An element's name is its class's with a small first letter. Defaults that the standard's readers disagree about are
OpenBMLParser's.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

from reactive_realizer.bml.attribute_types import Duration, Integer, Name, Number, Target, Text, Word
from reactive_realizer.bml.attributes import attribute
from reactive_realizer.bml.behavior import Behavior, SyncPoints
from reactive_realizer.bml.words import Influence, Mode, OffsetDirection

_STROKE_POINTS: SyncPoints = ("start", "ready", "strokeStart", "stroke", "strokeEnd", "relax", "end")
_HOLD_POINTS: SyncPoints = ("start", "ready", "relax", "end")
_SHIFT_POINTS: SyncPoints = ("start", "end")
_INFLUENCE = Word(Influence, {"NECK": Influence.HEAD, "TORSO": Influence.WAIST})
MOST_REPETITIONS = 100
"""Strokes of a head; each is a sync point."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Mark:
    """An inline sync point of a speech: it stands before the character of that index, or at the end of the text."""

    id: str = field(metadata=attribute(Name()))
    char_index: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Speech(Behavior):
    """Says a text.

    Attributes:
        text: with single spaces.
        marks: its inline sync points, in the order of the text.
    """

    CHILDREN = ("text",)
    SYNC_POINTS = _SHIFT_POINTS

    text: str
    marks: tuple[Mark, ...] = ()

    @property
    def sync_points(self) -> tuple[str, ...]:
        """Start, the marks, end."""
        return ("start", *(mark.id for mark in self.marks), "end")


@dataclass(frozen=True, slots=True, kw_only=True)
class Gesture(Behavior):
    """Moves arms and hands as an open word says; the hands may be left to the realizer."""

    SYNC_POINTS = _STROKE_POINTS
    OPEN_POINTS = True

    lexeme: str = field(metadata=attribute(Text()))
    mode: Mode | None = field(default=None, metadata=attribute(Word(Mode)))


@dataclass(frozen=True, slots=True, kw_only=True)
class Pointing(Behavior):
    """Points at a target; the hand may be left to the realizer."""

    SYNC_POINTS = _STROKE_POINTS

    target: str = field(metadata=attribute(Target()))
    mode: Mode | None = field(default=None, metadata=attribute(Word(Mode)))


@dataclass(frozen=True, slots=True, kw_only=True)
class Head(Behavior):
    """Moves the head rhythmically.

    Attributes:
        lexeme: NOD, SHAKE, or another word.
        repetition: number of strokes.
        amount: from 0 to 1 (the most there is).
    """

    SYNC_POINTS = _STROKE_POINTS
    OPEN_POINTS = True

    lexeme: str = field(metadata=attribute(Text()))
    repetition: int = field(default=1, metadata=attribute(Integer(1, MOST_REPETITIONS)))
    amount: float = field(default=0.5, metadata=attribute(Number(0, 1)))

    @property
    def sync_points(self) -> tuple[str, ...]:
        """With more than one repetition there are ``stroke:1`` to ``stroke:n`` in the place of stroke."""
        if self.repetition == 1:
            return _STROKE_POINTS
        strokes = (f"stroke:{number}" for number in range(1, self.repetition + 1))
        return (*_STROKE_POINTS[:3], *strokes, *_STROKE_POINTS[4:])

    @classmethod
    def tied_by(cls, values: Mapping[str, object]) -> SyncPoints:
        """One that strokes several times has no single stroke to be tied."""
        several = values.get("repetition", 1) != 1
        return tuple(point for point in _STROKE_POINTS if point != "stroke") if several else _STROKE_POINTS


@dataclass(frozen=True, slots=True, kw_only=True)
class HeadDirectionShift(Behavior):
    """Turns the head to a target and leaves it there."""

    SYNC_POINTS = _SHIFT_POINTS

    target: str = field(metadata=attribute(Target()))


@dataclass(frozen=True, slots=True, kw_only=True)
class Gaze(Behavior):
    """Looks at a target, and back.

    Attributes:
        target: what is looked at.
        influence: how much of the body takes part; None leaves it to the realizer.
        offset_angle: by how many degrees the gaze misses the target.
        offset_direction: to which side.
    """

    SYNC_POINTS = _HOLD_POINTS

    target: str = field(metadata=attribute(Target()))
    influence: Influence | None = field(default=None, metadata=attribute(_INFLUENCE))
    offset_angle: float = field(default=0.0, metadata=attribute(Number(-360, 360)))
    offset_direction: OffsetDirection = field(default=OffsetDirection.RIGHT, metadata=attribute(Word(OffsetDirection)))


@dataclass(frozen=True, slots=True, kw_only=True)
class GazeShift(Gaze):
    """As a gaze; the target becomes the one to which the eyes come back."""

    SYNC_POINTS = _SHIFT_POINTS


@dataclass(frozen=True, slots=True, kw_only=True)
class Locomotion(Behavior):
    """Walks to a target, or moves there in another manner."""

    SYNC_POINTS = _SHIFT_POINTS

    target: str = field(metadata=attribute(Target()))
    manner: str = field(default="WALK", metadata=attribute(Text()))


@dataclass(frozen=True, slots=True, kw_only=True)
class Wait(Behavior):
    """Does nothing for a while.

    Attributes:
        duration: seconds, None where only its sync points say it.
        max_wait: the most seconds it lasts, None for no bound.
    """

    SYNC_POINTS = _SHIFT_POINTS

    duration: float | None = field(default=None, metadata=attribute(Duration()))
    max_wait: float | None = field(default=None, metadata=attribute(Duration(), "max-wait"))
