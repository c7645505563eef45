"""Expressions as weights of morph targets: lexemes, emotions and action units, from the tables in assets/face."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any, Self

from reactive_realizer.binding.faults import BadAsset
from reactive_realizer.bml.behaviors import FaceFacs, FaceLexeme
from reactive_realizer.bml.vocabulary import Side
from reactive_realizer.errors import CreationFault, RealizerError

Weights = Mapping[str, float]
"""Weights of morph targets, 0 to 1."""

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
    """

    name: str
    middle: Weights
    sides: Weights

    def weights(self, side: Side) -> Weights:
        """Those at intensity 1. What has no sides moves whole."""
        halves = {f"{morph}{half}": weight for morph, weight in self.sides.items() for half in _HALVES[side]}
        return {**self.middle, **halves}


@dataclass(frozen=True, slots=True)
class Expressions:
    """The face lexemes and the action units.

    Attributes:
        lexemes: weights at amount 1 of each lexeme, under all of its names.
        names: of the lexemes, each once.
        units: by number.
    """

    lexemes: Mapping[str, Weights]
    names: tuple[str, ...]
    units: Mapping[int, ActionUnit]

    @classmethod
    def read(cls, lexemes: Path, units: Path) -> Self:
        """Reads the formats of assets/face/lexemes.json and assets/face/action_units.json.

        Raises:
            RealizerError: "bad-asset": a file has another format; the error names the entry.
            OSError: a file cannot be read.
        """
        by_number = {_number(units, name): _unit(units, name, entry) for name, entry in _table(units, "units").items()}
        words = {name: _weights(lexemes, name, entry) for name, entry in _table(lexemes, "lexemes").items()}
        for name, entry in _table(lexemes, "emotions", {}).items():
            words[name] = _emotion(lexemes, name, entry, by_number)
        names = tuple(map(_word, words))
        for name, meant in _table(lexemes, "synonyms", {}).items():
            if meant not in words:
                raise _bad(lexemes, name, f"there is no lexeme {meant!r}")
            words[name] = words[meant]
        return cls(MappingProxyType({_word(name): weights for name, weights in words.items()}), names, by_number)

    def weights(self, part: FaceLexeme | FaceFacs) -> Weights:
        """Those of an expression at amount 1.

        Raises:
            RealizerError: "no-face" or "no-action-unit".
        """
        if isinstance(part, FaceLexeme):
            weights = self.lexemes.get(_word(part.lexeme))
            if weights is None:
                raise RealizerError(NoFace(lexeme=part.lexeme, known=tuple(self.lexemes)))
            return weights
        unit = self.units.get(part.au)
        if unit is None:
            raise RealizerError(NoActionUnit(au=part.au, known=tuple(self.units)))
        return unit.weights(part.side)


def added(faces: Sequence[Weights]) -> dict[str, float]:
    """The sum of several weights; it may exceed 1."""
    total: dict[str, float] = {}
    for face in faces:
        for morph, weight in face.items():
            total[morph] = total.get(morph, 0.0) + weight
    return total


def limited(weights: Weights) -> dict[str, float]:
    """Weights that are at most 1."""
    return {morph: min(weight, 1.0) for morph, weight in weights.items()}


def _emotion(path: Path, name: str, entry: object, units: Mapping[int, ActionUnit]) -> Weights:
    """The sum of action units, each written as its number and, where one half moves, its side: "12 RIGHT"."""
    parts: list[Weights] = []
    for written, intensity in _weights(path, name, entry).items():
        number, _, side = written.partition(" ")
        if not number.isdecimal() or int(number) not in units or side not in ("", *Side):
            raise _bad(path, name, f"{written!r} is not an action unit")
        half = Side(side) if side else Side.BOTH
        parts.append({morph: intensity * weight for morph, weight in units[int(number)].weights(half).items()})
    return MappingProxyType(limited(added(parts)))


def _unit(path: Path, name: str, entry: Any) -> ActionUnit:
    if not isinstance(entry, dict) or not isinstance(entry.get("name"), str):
        raise _bad(path, name, "an action unit has a name")
    return ActionUnit(entry["name"], *(_weights(path, name, entry.get(part, {})) for part in ("middle", "sides")))


def _number(path: Path, name: str) -> int:
    if not name.isdecimal():
        raise _bad(path, name, "action units are named by their numbers")
    return int(name)


def _table(path: Path, name: str, default: Mapping[str, Any] | None = None) -> Mapping[str, Any]:
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as problem:
        row = getattr(problem, "lineno", 1)
        raise RealizerError(BadAsset(file=path.name, row=row, element="JSON", reason=str(problem))) from problem
    table = content.get(name, default) if isinstance(content, dict) else None
    if not isinstance(table, Mapping):
        raise _bad(path, name, "no object of that name")
    return table


def _weights(path: Path, name: str, entry: object) -> Weights:
    if not isinstance(entry, dict) or not all(_is_weight(weight) for weight in entry.values()):
        raise _bad(path, name, "weights are numbers from 0 to 1")
    return MappingProxyType({morph: float(weight) for morph, weight in entry.items()})


def _is_weight(weight: object) -> bool:
    return isinstance(weight, int | float) and not isinstance(weight, bool) and 0.0 <= weight <= 1.0


def _bad(path: Path, element: str, reason: str) -> RealizerError:
    return RealizerError(BadAsset(file=path.name, row=1, element=element, reason=reason))


def _word(lexeme: str) -> str:
    return lexeme.upper().replace("-", "_")
