"""The symbols of MURML, and what they mean (symbols.toml)."""

import math
import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any, Final

from reactive_realizer.bml.key_poses import Coordinates
from reactive_realizer.bml.murml.description import GesturePlace, HandShape, Heading, Point, Scope, Slot, SlotValue
from reactive_realizer.bml.murml.faults import BadMurmlValue, UnknownSymbol
from reactive_realizer.errors import RealizerError, quoted

_FARTHEST: Final = 1e6
_SHORTEST: Final = 1e-6
"""A shorter vector has no direction."""

_AXES: Final[Mapping[str, Coordinates]] = MappingProxyType(
    {
        "L": (1.0, 0.0, 0.0),
        "R": (-1.0, 0.0, 0.0),
        "U": (0.0, 1.0, 0.0),
        "D": (0.0, -1.0, 0.0),
        "A": (0.0, 0.0, 1.0),
        "T": (0.0, 0.0, -1.0),
    }
)
"""The letters of directions: left, right, up, down, away from the body, toward it."""

_HEADING: Final = re.compile(r"(?:Dir|Palm)([LRUDAT]+)")
_HAND_SHAPE: Final = re.compile(r"[\w.-]+")


@dataclass(frozen=True, slots=True)
class Symbols:
    """The tables of symbols.toml, symbol to meaning.

    Attributes:
        heights: of locations.
        directions: of locations, degrees to the left.
        distances: of locations, in lengths of the arm.
        ways: lengths of movements, in lengths of the arm.
        extents: heights of curves, in lengths of their chords.
        roundnesses: of curves, -1 to 1.
        skewednesses: of curves, -1 to 1.
        hand_shapes: names of stored poses.
    """

    heights: Mapping[str, float]
    directions: Mapping[str, float]
    distances: Mapping[str, float]
    ways: Mapping[str, float]
    extents: Mapping[str, float]
    roundnesses: Mapping[str, float]
    skewednesses: Mapping[str, float]
    hand_shapes: Mapping[str, str]


def _read() -> Symbols:
    tables: dict[str, Any] = tomllib.loads(Path(__file__).with_name("symbols.toml").read_text(encoding="utf-8"))
    return Symbols(**{name: MappingProxyType(table) for name, table in tables.items()})


SYMBOLS: Final = _read()


def value_of(slot: Slot, scope: Scope, text: str) -> SlotValue:
    """The value of a slot of one arm.

    Raises:
        RealizerError: "murml-unknown-symbol" or "murml-bad-value".
    """
    match slot:
        case Slot.HAND_LOCATION:
            return _location(text)
        case Slot.HAND_SHAPE:
            return _hand_shape(text)
        case Slot.EXT_FINGER_ORIENTATION:
            return Heading(direction_of(slot, text))
        case Slot.PALM_ORIENTATION:
            return Heading(_palm(scope, text))


def direction_of(slot: str, text: str) -> Coordinates:
    """The direction of a symbol such as DirUL or DirALAA, of which each letter counts, or of three numbers.

    Raises:
        RealizerError: it is neither, or it has no length.
    """
    symbol = _HEADING.fullmatch(text.strip())
    if symbol:
        letters = [_AXES[letter] for letter in symbol[1]]
        vector = (sum(x for x, _, _ in letters), sum(y for _, y, _ in letters), sum(z for _, _, z in letters))
    else:
        vector = _vector(slot, text, "a direction has letters of L, R, U, D, A and T, such as DirUL, or three numbers")
    if math.hypot(*vector) < _SHORTEST:
        raise _bad(slot, text, "it has no direction")
    return vector


def number_of(slot: str, text: str, symbols: Mapping[str, float]) -> float:
    """The length that a text or a symbol denotes.

    Raises:
        RealizerError: it is neither, or below 0.
    """
    number = _known_number(slot, text, symbols)
    if number < 0.0:
        raise _bad(slot, text, "it must not be below 0")
    return number


def degree_of(slot: str, text: str, symbols: Mapping[str, float]) -> float:
    """The number from -1 to 1 that a text or a symbol denotes.

    Raises:
        RealizerError: it is neither.
    """
    number = _known_number(slot, text, symbols)
    if abs(number) > 1.0:
        raise _bad(slot, text, "it must be from -1 to 1")
    return number


def _known_number(slot: str, text: str, symbols: Mapping[str, float]) -> float:
    if text in symbols:
        return symbols[text]
    number = _number(text)
    if number is None:
        raise RealizerError(UnknownSymbol(slot=slot, symbol=quoted(text), known=tuple(symbols)))
    return number


def _location(text: str) -> GesturePlace | Point:
    words = text.split()
    if words and _number(words[0]) is not None:
        return Point(_vector(Slot.HAND_LOCATION, text, "a place has three numbers: to the left, up, ahead, in m"))
    height, direction, distance = (
        _symbol(word, table)
        for word, table in zip(
            [*words, "LocCCenter", "LocNorm"][:3] if len(words) == 1 else _with_direction(words),
            (SYMBOLS.heights, SYMBOLS.directions, SYMBOLS.distances),
            strict=True,
        )
    )
    return GesturePlace(height, direction, distance)


def _with_direction(words: list[str]) -> list[str]:
    """The three symbols of a location; a direction may be left out."""
    if len(words) == 2:
        return [words[0], "LocCCenter", words[1]] if words[1] in SYMBOLS.distances else [*words, "LocNorm"]
    if len(words) != 3:
        raise _bad(Slot.HAND_LOCATION, " ".join(words), "a place has a height, a direction and a distance")
    return words


def _symbol(word: str, table: Mapping[str, float]) -> float:
    if word not in table:
        raise RealizerError(UnknownSymbol(slot=Slot.HAND_LOCATION, symbol=quoted(word), known=tuple(table)))
    return table[word]


def _hand_shape(text: str) -> HandShape:
    name = text.split("(")[0].strip()
    if not _HAND_SHAPE.fullmatch(name):
        raise _bad(Slot.HAND_SHAPE, text, "it is no name of a hand shape")
    return HandShape(SYMBOLS.hand_shapes.get(name, name))


def _palm(scope: Scope, text: str) -> Coordinates:
    """The direction of a palm; a number is its turn about fingers that point ahead, degrees.

    As in AsapRealizer, whose left palm faces right at 0, down at 90 and left at 180, and whose right one is mirrored.
    """
    degrees = _number(text)
    if degrees is None:
        return direction_of(Slot.PALM_ORIENTATION, text)
    turn = math.radians(degrees)
    right, down = math.cos(turn), math.sin(turn)
    return (-right, -down, 0.0) if scope is Scope.LEFT else (right, down, 0.0)


def _vector(slot: str, text: str, expected: str) -> Coordinates:
    numbers = [_number(part) for part in text.split()]
    if len(numbers) != 3 or None in numbers:
        raise _bad(slot, text, expected)
    x, y, z = (number for number in numbers if number is not None)
    return (x, y, z)


def _number(text: str) -> float | None:
    """The number in a text; None if there is none, or one that no coordinate has."""
    try:
        value = float(text)
    except ValueError:
        return None
    return value if abs(value) <= _FARTHEST else None


def _bad(slot: str, text: str, reason: str) -> RealizerError:
    return RealizerError(BadMurmlValue(slot=slot, value=quoted(text), reason=reason))
