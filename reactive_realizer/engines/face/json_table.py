"""Reads the tables of the face, which are JSON files."""

import json
from collections.abc import Mapping
from math import inf
from pathlib import Path
from types import MappingProxyType
from typing import Any, TypeGuard

from reactive_realizer.binding.faults import BadAsset
from reactive_realizer.engines.face.face_timing import TIMING, expression_timing
from reactive_realizer.engines.face.weights import Weights
from reactive_realizer.errors import RealizerError
from reactive_realizer.planunit.timing import Timing


def read_table(path: Path, name: str, default: Mapping[str, Any] | None = None) -> Mapping[str, Any]:
    """The object with a name in a JSON file.

    Raises:
        RealizerError: "bad-asset": the file is not JSON, or has no such object and there is no default.
        OSError: the file cannot be read.
    """
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as problem:
        row = getattr(problem, "lineno", 1)
        raise RealizerError(BadAsset(file=path.name, row=row, element="JSON", reason=str(problem))) from problem
    table = content.get(name, default) if isinstance(content, dict) else None
    if not isinstance(table, Mapping):
        raise bad_entry(path, name, "no object of that name")
    return table


def read_weights(path: Path, name: str, entry: object, most: float = 1.0) -> Weights:
    """The weights in an entry of a table, from 0 to a number.

    Raises:
        RealizerError: "bad-asset": they are no weights.
    """
    if not isinstance(entry, dict) or not all(_is_weight(weight, most) for weight in entry.values()):
        raise bad_entry(path, name, f"weights are numbers from 0 to {most:g}")
    return MappingProxyType({morph: float(weight) for morph, weight in entry.items()})


def read_timing(path: Path, name: str, entry: object) -> Timing:
    """The timing in an entry of a table: the durations of attack, hold and decay, s.

    Raises:
        RealizerError: "bad-asset": they are no durations.
    """
    if not isinstance(entry, list) or len(entry) != len(TIMING.phases) or not all(map(_is_duration, entry)):
        raise bad_entry(path, name, "durations are three numbers of seconds above 0")
    return expression_timing(*map(float, entry))


def read_number(path: Path, name: str) -> int:
    """The number that names an entry.

    Raises:
        RealizerError: "bad-asset": it is no number.
    """
    if not name.isdecimal():
        raise bad_entry(path, name, "these entries are named by their numbers")
    return int(name)


def bad_entry(path: Path, name: str, reason: str) -> RealizerError:
    """An error about an entry of a table."""
    return RealizerError(BadAsset(file=path.name, row=1, element=name, reason=reason))


def _is_weight(weight: object, most: float) -> bool:
    return _is_number(weight) and 0.0 <= weight <= most


def _is_duration(duration: object) -> bool:
    return _is_number(duration) and 0.0 < duration < inf


def _is_number(value: object) -> TypeGuard[float]:
    return isinstance(value, int | float) and not isinstance(value, bool)
