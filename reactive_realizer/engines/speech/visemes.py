"""From phonemes to visemes, and from visemes to the blend shapes of a face: a table that anyone can edit."""

import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Self

SILENCE = "sil"
"""The viseme of a closed mouth at rest."""


@dataclass(frozen=True, slots=True)
class VisemeTable:
    """The shapes that a mouth takes while it speaks.

    Attributes:
        phonemes: viseme of each letter or pair of letters of the International Phonetic Alphabet, pairs first.
        morphs: of each viseme but silence the weights, 0..1, of ARKit blend shapes.
    """

    phonemes: Mapping[str, str]
    morphs: Mapping[str, Mapping[str, float]]

    @classmethod
    def from_toml(cls, text: str) -> Self:
        """Reads the format of assets/visemes/visemes.toml."""
        table = tomllib.loads(text)
        phonemes = [(letters, viseme) for viseme, listed in table["phonemes"].items() for letters in listed]
        return cls(dict(sorted(phonemes, key=lambda entry: len(entry[0]), reverse=True)), table["morphs"])

    def visemes(self, symbol: str) -> tuple[str, ...]:
        """The visemes of a phoneme, in order: two for a diphthong, silence for a pause, none for an unknown sound."""
        if not symbol:
            return (SILENCE,)
        return tuple(self.phonemes[letters] for letters in re.findall("|".join(self.phonemes), symbol))

    def blend(self, weights: Mapping[str, float]) -> dict[str, float]:
        """Weights of ARKit blend shapes, 0..1, for weights of visemes whose sum is at most 1."""
        blended: dict[str, float] = {}
        for viseme, weight in weights.items():
            for morph, share in self.morphs.get(viseme, {}).items():
                blended[morph] = blended.get(morph, 0.0) + weight * share
        return blended


@cache
def default_table() -> VisemeTable:
    """The table that comes with the package."""
    return VisemeTable.from_toml((files("reactive_realizer") / "assets/visemes/visemes.toml").read_text("utf-8"))
