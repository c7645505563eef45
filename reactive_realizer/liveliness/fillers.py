"""What speakers say to hold the floor, by language, read from a data file (assets/liveliness/fillers.toml)."""

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from random import Random
from typing import Any, Final

from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.file_cache import remembered

_DEFAULT: Final = "en"
"""The language if the name of a voice is not the tag of a language with fillers."""

_MOST: Final = 20
_LONGEST: Final = 60.0
"""Upper limits of the number of fillers, and of silences, s."""


class BadFillers(Fault):
    """A file of fillers that cannot be read."""

    code = "bad-fillers"
    template = "{file}: {reason}"
    file: str
    reason: str


@dataclass(frozen=True, slots=True)
class Fillers:
    """How speakers hold the floor.

    Attributes:
        wait: silence after a speech, s, before the first filler.
        pauses: the shortest and the longest silence after a filler, s.
        most: how many fillers follow a speech.
        words: for each language, the fillers that may come first, and those that may come later.
    """

    wait: float
    pauses: tuple[float, float]
    most: int
    words: Mapping[str, tuple[Sequence[str], Sequence[str]]]

    def choose(self, voice: str | None, seed: str) -> list[tuple[str, float]]:
        """Fillers in the language of a voice, each with the silence after it, s; the same ones for the same seed.

        None is said twice in a row.
        """
        language = (voice or "").lower().partition("-")[0]
        first, later = self.words.get(language, self.words[_DEFAULT])
        random = Random(seed)
        chosen = [random.choice(first)]
        while len(chosen) < self.most:
            chosen.append(random.choice([each for each in later if each != chosen[-1]] or later))
        return [(each, random.uniform(*self.pauses)) for each in chosen]


NO_FILLERS: Final = Fillers(0.0, (0.0, 0.0), 0, {})
"""Fillers for a realizer whose characters never hold the floor."""


@remembered
def read_fillers(path: Path) -> Fillers:
    """Read a file of fillers.

    Raises:
        RealizerError: "bad-fillers": it is not TOML, or a key is missing or has a bad value.
    """
    try:
        return _fillers(tomllib.loads(path.read_text("utf-8")))
    except KeyError as problem:
        raise RealizerError(BadFillers(file=path.name, reason=f"the key {problem} is missing")) from problem
    except (ValueError, TypeError, AttributeError, RecursionError) as problem:
        raise RealizerError(BadFillers(file=path.name, reason=str(problem))) from problem


def _fillers(table: Mapping[str, Any]) -> Fillers:
    shortest, longest = (_between("pauses", value, 0.0, _LONGEST) for value in _pair(table["pauses"]))
    most = _between("most", table["most"], 1, _MOST)
    read = (
        (name.lower(), _texts(name, own, "first"), _texts(name, own, "later")) for name, own in table["words"].items()
    )
    words = {name: (first, later) for name, first, later in read}
    if _DEFAULT not in words:
        raise ValueError(f"there are no words for '{_DEFAULT}'")
    return Fillers(_between("wait", table["wait"], 0.0, _LONGEST), (shortest, longest), int(most), words)


def _pair(value: object) -> list[object]:
    if not isinstance(value, list) or len(value) != 2:
        raise ValueError(f"pauses is {value!r}, not the shortest and the longest pause")
    return value


def _between(name: str, value: object, low: float, high: float) -> float:
    if not isinstance(value, int | float) or not low <= value <= high:
        raise ValueError(f"{name} is {value!r}, not a number from {low:g} to {high:g}")
    return float(value)


def _texts(language: str, table: Mapping[str, Any], key: str) -> tuple[str, ...]:
    texts = table[key]
    if not isinstance(texts, list) or not texts or not all(isinstance(text, str) and text.strip() for text in texts):
        raise ValueError(f"words.{language}.{key} is not a list of texts")
    return tuple(texts)
