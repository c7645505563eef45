"""The behaviors of the face."""

from dataclasses import dataclass, field

from reactive_realizer.bml.attribute_types import Integer, Number, Text, Word
from reactive_realizer.bml.attributes import attribute
from reactive_realizer.bml.behavior import Behavior, SyncPoints
from reactive_realizer.bml.names import BML_EXT
from reactive_realizer.bml.words import Side

_FACE_POINTS: SyncPoints = ("start", "attackPeak", "relax", "end")
_MOST_ACTION_UNITS = 99


@dataclass(frozen=True, slots=True, kw_only=True)
class FaceLexeme(Behavior):
    """An expression of the face by an open word.

    Attributes:
        lexeme: such as RAISE_BROWS.
        amount: from 0 to 1 (the most there is).
        overshoot: by what fraction the attack peak exceeds the amount.
    """

    SYNC_POINTS = _FACE_POINTS

    lexeme: str = field(metadata=attribute(Text()))
    amount: float = field(default=0.5, metadata=attribute(Number(0, 1)))
    overshoot: float = field(default=0.0, metadata=attribute(Number(0, 1)))


@dataclass(frozen=True, slots=True, kw_only=True)
class FaceFacs(Behavior):
    """An action unit of the Facial Action Coding System (Ekman and Friesen); a core extension.

    Attributes:
        au: number of the action unit.
        side: of the face.
        amount: from 0 to 1 (the most there is).
    """

    NAMESPACE = BML_EXT
    SYNC_POINTS = _FACE_POINTS

    au: int = field(metadata=attribute(Integer(0, _MOST_ACTION_UNITS)))
    side: Side = field(default=Side.BOTH, metadata=attribute(Word(Side)))
    amount: float = field(default=0.5, metadata=attribute(Number(0, 1)))


@dataclass(frozen=True, slots=True, kw_only=True)
class Face(Behavior):
    """Several expressions as one.

    Attributes:
        amount: from 0 to 1 (the most there is).
        overshoot: by what fraction the attack peak exceeds the amount.
        parts: the expressions; their ids may be empty, their times are the face's.
    """

    CHILDREN = ("faceLexeme", "faceFacs")
    SYNC_POINTS = _FACE_POINTS

    amount: float = field(default=0.5, metadata=attribute(Number(0, 1)))
    overshoot: float = field(default=0.0, metadata=attribute(Number(0, 1)))
    parts: tuple[FaceLexeme | FaceFacs, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class FaceShift(Face):
    """As a face; it becomes the one to which the others return."""

    SYNC_POINTS = ("start", "end")
