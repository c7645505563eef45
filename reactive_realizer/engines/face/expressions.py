"""Expressions as weights of morph targets: lexemes, emotions and action units, from the tables in assets/face."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any

from reactive_realizer.bml.vocabulary import Side
from reactive_realizer.embodiment.avatar import SKIN_COLORS
from reactive_realizer.engines.face.face_timing import TIMING, FaceShape
from reactive_realizer.engines.face.json_table import bad_entry, read_number, read_table, read_timing, read_weights
from reactive_realizer.engines.face.weights import Weights, added, limited, scaled
from reactive_realizer.errors import CreationFault, RealizerError
from reactive_realizer.file_cache import remembered
from reactive_realizer.planunit.timing import Timing

_MOST = 2.0
"""Largest weight of a lexeme in the table; it is reached at an amount of 0.5."""

_HALVES = {Side.LEFT: ("Left",), Side.RIGHT: ("Right",), Side.BOTH: ("Left", "Right")}


class NoFace(CreationFault):
    """No face lexeme has the name."""

    code = "no-face"
    template = "there is no face lexeme '{lexeme}'; available: {known}"
    unknown = "lexeme"
    lexeme: str
    known: tuple[str, ...]


class NoActionUnit(CreationFault):
    """An action unit that the face does not have: it moves the head or the eyes, or no blend shape is like it."""

    code = "no-action-unit"
    template = "there is no action unit {au}; available: {known}"
    au: int
    known: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class ActionUnit:
    """A unit of the Facial Action Coding System.

    Attributes:
        name: in English.
        middle: weights of morph targets that have no sides.
        sides: weights of morph targets whose names end in Left or Right.
        timing: that it prefers.
    """

    name: str
    middle: Weights
    sides: Weights
    timing: Timing = TIMING

    def weights(self, side: Side) -> Weights:
        """Those at intensity 1. What has no sides moves whole."""
        halves = {f"{morph}{half}": weight for morph, weight in self.sides.items() for half in _HALVES[side]}
        return {**self.middle, **halves}


@dataclass(frozen=True, slots=True)
class Expressions:
    """The face lexemes and the action units.

    Attributes:
        lexemes: weights at amount 1 of each lexeme, under all of its names; one above 1 is reached at a smaller amount.
        names: of the lexemes, each once.
        units: by number.
        timings: of lexemes with a timing of their own.
    """

    lexemes: Mapping[str, Weights]
    names: tuple[str, ...]
    units: Mapping[int, ActionUnit]
    timings: Mapping[str, Timing]

    @staticmethod
    @remembered
    def read(lexemes: Path, units: Path) -> "Expressions":
        """Reads the formats of assets/face/lexemes.json and assets/face/action_units.json.

        Raises:
            RealizerError: "bad-asset": a file has another format; the error names the entry.
            OSError: a file cannot be read.
        """
        by_number = {
            read_number(units, name): _unit(units, name, entry) for name, entry in read_table(units, "units").items()
        }
        words = {
            name: read_weights(lexemes, name, entry, _MOST) for name, entry in read_table(lexemes, "lexemes").items()
        }
        for name, entry in read_table(lexemes, "emotions", {}).items():
            words[name] = _emotion(lexemes, name, entry, by_number)
        names = tuple(map(_word, words))
        timings = {
            name: read_timing(lexemes, name, entry) for name, entry in read_table(lexemes, "durations", {}).items()
        }
        for name, meant in read_table(lexemes, "synonyms", {}).items():
            if meant not in words:
                raise bad_entry(lexemes, name, f"there is no lexeme {meant!r}")
            words[name] = words[meant]
            if meant in timings:
                timings[name] = timings[meant]
        by_word = MappingProxyType({_word(name): weights for name, weights in words.items()})
        timed = {_word(name): timing for name, timing in timings.items()}
        return Expressions(by_word, names, by_number, timed)

    def face(self, lexeme: str, amount: float) -> FaceShape:
        """The expression of a lexeme at an amount, 0 to 1.

        Raises:
            RealizerError: "no-face".
        """
        word = _word(lexeme)
        weights = self.lexemes.get(word)
        if weights is None:
            raise RealizerError(NoFace(lexeme=lexeme, known=tuple(self.lexemes)))
        return FaceShape(limited(scaled(weights, amount)), self.timings.get(word, TIMING))

    def unit(self, number: int) -> ActionUnit:
        """The action unit with a number.

        Raises:
            RealizerError: "no-action-unit".
        """
        unit = self.units.get(number)
        if unit is None:
            raise RealizerError(NoActionUnit(au=number, known=tuple(self.units)))
        return unit


def _emotion(path: Path, name: str, entry: object, units: Mapping[int, ActionUnit]) -> Weights:
    """The sum of action units, each written as its number and, where one half moves, its side: "12 RIGHT".

    Colors of the skin are among them, by their names.
    """
    parts: list[Weights] = []
    for written, intensity in read_weights(path, name, entry).items():
        if written in SKIN_COLORS:
            parts.append({written: intensity})
            continue
        number, _, side = written.partition(" ")
        if not number.isdecimal() or int(number) not in units or side not in ("", *Side):
            raise bad_entry(path, name, f"{written!r} is not an action unit")
        half = Side(side) if side else Side.BOTH
        parts.append(scaled(units[int(number)].weights(half), intensity))
    return MappingProxyType(limited(added(parts)))


def _unit(path: Path, name: str, entry: Any) -> ActionUnit:
    if not isinstance(entry, dict) or not isinstance(entry.get("name"), str):
        raise bad_entry(path, name, "an action unit has a name")
    middle, sides = (read_weights(path, name, entry.get(part, {})) for part in ("middle", "sides"))
    timing = read_timing(path, name, entry["durations"]) if "durations" in entry else TIMING
    return ActionUnit(entry["name"], middle, sides, timing)


def _word(lexeme: str) -> str:
    return lexeme.upper().replace("-", "_")
