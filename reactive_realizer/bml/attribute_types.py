"""The types of attributes: each reads a value from text, and describes the values it takes."""

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import ClassVar, Final

from reactive_realizer.bml.names import BLOCK
from reactive_realizer.bml.sync_ref import NUMBER
from reactive_realizer.bml.value_faults import NotAnEvent, NotAnId, NotAVector, NotWhole, OutOfRange, UnknownWord
from reactive_realizer.bml.vocabulary import Composition
from reactive_realizer.errors import NotANumber, RealizerError
from reactive_realizer.limits import Limits

_SIGNED_NUMBER: Final = re.compile(rf"[+-]?{NUMBER}")
_ID: Final = re.compile(r"[^\s:+]{1,200}")
_OFFSET: Final = re.compile(rf"-{NUMBER}$")
_FARTHEST: Final = 1e6
"""Largest component of a vector."""
_AFTER: Final = re.compile(r"\s*(APPEND|CHUNK)[-_]?AFTER\s*\((.*)\)\s*", re.IGNORECASE | re.DOTALL)


@dataclass(frozen=True, slots=True)
class Text:
    """Any text, as written: ids of targets, words of open vocabularies."""

    description: ClassVar[str] = "text"

    def read(self, text: str, limits: Limits) -> str:
        """The text itself."""
        return text


@dataclass(frozen=True, slots=True)
class Target(Text):
    """The name of an object in the world."""

    description: ClassVar[str] = "name of a target"


@dataclass(frozen=True, slots=True)
class Id:
    """An id that a sync reference can name."""

    description: ClassVar[str] = "id"

    def read(self, text: str, limits: Limits) -> str:
        """The id, without the white space around it."""
        name = text.strip()
        if name == BLOCK or not _ID.fullmatch(name):
            raise RealizerError(NotAnId())
        return name


@dataclass(frozen=True, slots=True)
class EventName:
    """The name of an event, which a sync reference can name: an id that does not end like an offset."""

    description: ClassVar[str] = "name of an event"

    def read(self, text: str, limits: Limits) -> str:
        """The name, without the white space around it."""
        name = text.strip()
        if not _ID.fullmatch(name) or _OFFSET.search(name):
            raise RealizerError(NotAnEvent())
        return name


@dataclass(frozen=True, slots=True)
class IdList:
    """Zero or more ids, separated by commas."""

    description: ClassVar[str] = "ids, separated by commas"

    def read(self, text: str, limits: Limits) -> tuple[str, ...]:
        """The ids in the order of writing, without repetitions."""
        names = text.split(",") if text.strip() else []
        return tuple(dict.fromkeys(Id().read(name, limits) for name in names))


@dataclass(frozen=True, slots=True)
class BehaviorId:
    """The id of a behavior, optionally after the id of its block."""

    description: ClassVar[str] = "[block:]behavior"

    def read(self, text: str, limits: Limits) -> str:
        """The ids as written, without the white space around them."""
        names = text.split(":")
        if len(names) > 2:
            raise RealizerError(NotAnId())
        return ":".join(Id().read(name, limits) for name in names)


@dataclass(frozen=True, slots=True)
class Boolean:
    """A boolean of XML Schema, in any case."""

    description: ClassVar[str] = "true, false"

    def read(self, text: str, limits: Limits) -> bool:
        """The truth value."""
        word = text.strip().lower()
        if word not in {"true", "false", "1", "0"}:
            raise RealizerError(UnknownWord(word=text, known=("true", "false")))
        return word in {"true", "1"}


@dataclass(frozen=True, slots=True)
class Float:
    """A finite number in a range."""

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
class Vector:
    """Three finite numbers, separated by spaces."""

    description: ClassVar[str] = "three numbers"

    def read(self, text: str, limits: Limits) -> tuple[float, float, float]:
        """The numbers."""
        parts = text.split()
        if len(parts) != 3:
            raise RealizerError(NotAVector(size=len(parts)))
        x, y, z = (_within(_finite(part), -_FARTHEST, _FARTHEST) for part in parts)
        return x, y, z


@dataclass(frozen=True, slots=True)
class Integer:
    """A whole number in a range."""

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
            raise RealizerError(NotWhole())
        return int(value)


@dataclass(frozen=True, slots=True)
class Duration:
    """A duration from 0 s to the limit of times."""

    description: ClassVar[str] = "seconds"

    def read(self, text: str, limits: Limits) -> float:
        """The duration in seconds."""
        return _within(_finite(text), 0.0, limits.time_seconds)


@dataclass(frozen=True, slots=True)
class Enumeration:
    """A word of a closed vocabulary, in any case, its parts joined by ``_``, ``-`` or nothing.

    Attributes:
        words: the vocabulary.
        synonyms: other words, in capital letters and without separators.
    """

    words: type[StrEnum]
    synonyms: Mapping[str, StrEnum] = field(default_factory=dict)

    @property
    def description(self) -> str:
        """The words of the vocabulary, without the synonyms."""
        return ", ".join(self.words)

    def read(self, text: str, limits: Limits) -> StrEnum:
        """The word."""
        known: dict[str, StrEnum] = {**{_plain(word): word for word in self.words}, **self.synonyms}
        word = known.get(_plain(text.strip()))
        if word is None:
            raise RealizerError(UnknownWord(word=text, known=tuple(self.words)))
        return word


@dataclass(frozen=True, slots=True)
class CompositionValue:
    """The value of a ``composition`` attribute.

    Attributes:
        composition: its word; MERGE if the attribute lists blocks instead.
        append_after: ids of the blocks that end before this one starts.
        chunk_after: ids of the blocks that subside before this one starts.
    """

    composition: Composition = Composition.MERGE
    append_after: tuple[str, ...] = ()
    chunk_after: tuple[str, ...] = ()


_LISTS_OF_BLOCKS: Final = ("APPEND-AFTER(ids)", "CHUNK-AFTER(ids)")


@dataclass(frozen=True, slots=True)
class CompositionType:
    """A word of `Composition`, or a list of blocks: ``APPEND-AFTER(b1,b2)`` (thesis 6.6.8.1), ``CHUNK-AFTER(b1)``."""

    description: ClassVar[str] = ", ".join((*Composition, *_LISTS_OF_BLOCKS))

    def read(self, text: str, limits: Limits) -> CompositionValue:
        """The word or the blocks; a word may be in any case, its parts joined by ``_``, ``-`` or nothing."""
        after = _AFTER.fullmatch(text)
        if after is not None:
            blocks = IdList().read(after[2], limits)
            if after[1].upper() == "APPEND":
                return CompositionValue(append_after=blocks)
            return CompositionValue(chunk_after=blocks)
        try:
            return CompositionValue(Composition(str(Enumeration(Composition).read(text, limits))))
        except RealizerError:
            raise RealizerError(UnknownWord(word=text, known=(*Composition, *_LISTS_OF_BLOCKS))) from None


def _plain(word: str) -> str:
    return re.sub(r"[-_]", "", word).upper()


def _finite(text: str) -> float:
    if not _SIGNED_NUMBER.fullmatch(text.strip()) or not math.isfinite(float(text)):
        raise RealizerError(NotANumber())
    return float(text)


def _within(value: float, low: float, high: float) -> float:
    if not low <= value <= high:
        raise RealizerError(OutOfRange(low=f"{low:g}", high=f"{high:g}"))
    return value
