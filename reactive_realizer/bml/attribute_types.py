"""What values attributes may have."""

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import ClassVar, Final

from reactive_realizer.bml.names import BLOCK
from reactive_realizer.bml.sync_ref import NUMBER
from reactive_realizer.errors import error
from reactive_realizer.limits import Limits

_SIGNED: Final = re.compile(rf"[+-]?{NUMBER}")


@dataclass(frozen=True, slots=True)
class Text:
    """Any text, as written: ids of targets, words of open vocabularies."""

    description: ClassVar[str] = "text"

    def read(self, text: str, limits: Limits) -> str:
        """The text itself."""
        return text


@dataclass(frozen=True, slots=True)
class Target(Text):
    """The name of something in the world."""

    description: ClassVar[str] = "name of a target"


@dataclass(frozen=True, slots=True)
class Name:
    """An id that a reference can name."""

    description: ClassVar[str] = "id"

    def read(self, text: str, limits: Limits) -> str:
        """The id, without the white space around it."""
        name = text.strip()
        if name == BLOCK or not re.fullmatch(r"[^\s:+]{1,200}", name):
            raise error("not-an-id")
        return name


@dataclass(frozen=True, slots=True)
class Names:
    """Ids with commas between them, each once; there may be none."""

    description: ClassVar[str] = "ids, separated by commas"

    def read(self, text: str, limits: Limits) -> tuple[str, ...]:
        """The ids, in order of writing."""
        names = text.split(",") if text.strip() else []
        return tuple(dict.fromkeys(Name().read(name, limits) for name in names))


@dataclass(frozen=True, slots=True)
class BehaviorName:
    """The id of a behavior, with that of its block before it or without."""

    description: ClassVar[str] = "[block:]behavior"

    def read(self, text: str, limits: Limits) -> str:
        """Both ids, without the white space around them."""
        names = text.split(":")
        if len(names) > 2:
            raise error("not-an-id")
        return ":".join(Name().read(name, limits) for name in names)


@dataclass(frozen=True, slots=True)
class Boolean:
    """Yes or no, as XML Schema writes it, in any case."""

    description: ClassVar[str] = "true, false"

    def read(self, text: str, limits: Limits) -> bool:
        """Whether it is yes."""
        word = text.strip().lower()
        if word not in {"true", "false", "1", "0"}:
            raise error("unknown-word", known=self.description)
        return word in {"true", "1"}


@dataclass(frozen=True, slots=True)
class Number:
    """A finite number within a range."""

    low: float = -math.inf
    high: float = math.inf

    @property
    def description(self) -> str:
        """The range."""
        if math.isinf(self.low) and math.isinf(self.high):
            return "number"
        return f"number, {self.low:g} to {self.high:g}"

    def read(self, text: str, limits: Limits) -> float:
        """The number."""
        return _within(_finite(text), self.low, self.high)


@dataclass(frozen=True, slots=True)
class Integer:
    """A whole number within a range."""

    low: int
    high: int

    @property
    def description(self) -> str:
        """The range."""
        return f"whole number, {self.low} to {self.high}"

    def read(self, text: str, limits: Limits) -> int:
        """The whole number."""
        value = _within(_finite(text), self.low, self.high)
        if value != int(value):
            raise error("not-whole")
        return int(value)


@dataclass(frozen=True, slots=True)
class Duration:
    """Seconds from 0 to the limit of times."""

    description: ClassVar[str] = "seconds"

    def read(self, text: str, limits: Limits) -> float:
        """The duration in seconds."""
        return _within(_finite(text), 0.0, limits.time_seconds)


@dataclass(frozen=True, slots=True)
class Word:
    """A word of a closed vocabulary, in any case, with ``_``, ``-`` or nothing between its parts."""

    words: type[StrEnum]
    synonyms: Mapping[str, StrEnum] = field(default_factory=dict)

    @property
    def description(self) -> str:
        """The words of the standard."""
        return ", ".join(self.words)

    def read(self, text: str, limits: Limits) -> StrEnum:
        """The word."""
        known: dict[str, StrEnum] = {**{_plain(word): word for word in self.words}, **self.synonyms}
        word = known.get(_plain(text.strip()))
        if word is None:
            raise error("unknown-word", known=self.description)
        return word


def _plain(word: str) -> str:
    return re.sub(r"[-_]", "", word).upper()


def _finite(text: str) -> float:
    if not _SIGNED.fullmatch(text.strip()) or not math.isfinite(float(text)):
        raise error("not-a-number")
    return float(text)


def _within(value: float, low: float, high: float) -> float:
    if not low <= value <= high:
        raise error("out-of-range", low=f"{low:g}", high=f"{high:g}")
    return value
