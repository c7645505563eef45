"""Reads face lexemes: the morph target weights of each lexeme of a faceLexeme behavior."""

import json
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType

from reactive_realizer.binding.faults import BadAsset
from reactive_realizer.errors import RealizerError

FaceLexemes = Mapping[str, Mapping[str, float]]
"""Lexeme -> morph target -> weight at amount 1, 0 to 1."""


def read_face_lexemes(path: Path) -> FaceLexemes:
    """Read the lexemes of a JSON file: an object "lexemes" that contains one object of weights for each lexeme.

    Raises:
        RealizerError: "bad-asset": the file has another format; the error names the lexeme.
        OSError: the file cannot be read.
    """
    try:
        table = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as problem:
        row = getattr(problem, "lineno", 1)
        raise RealizerError(BadAsset(file=path.name, row=row, element="JSON", reason=str(problem))) from problem
    lexemes = table.get("lexemes") if isinstance(table, dict) else None
    if not isinstance(lexemes, dict):
        raise RealizerError(BadAsset(file=path.name, row=1, element="lexemes", reason="no object of that name"))
    return MappingProxyType({name: _weights(path.name, name, weights) for name, weights in lexemes.items()})


def _weights(file: str, lexeme: str, weights: object) -> Mapping[str, float]:
    if not isinstance(weights, dict) or not all(_is_weight(weight) for weight in weights.values()):
        raise RealizerError(BadAsset(file=file, row=1, element=lexeme, reason="weights are numbers from 0 to 1"))
    return MappingProxyType({morph: float(weight) for morph, weight in weights.items()})


def _is_weight(weight: object) -> bool:
    return isinstance(weight, int | float) and not isinstance(weight, bool) and 0.0 <= weight <= 1.0
