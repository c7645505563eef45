"""The lexicon of an engine: the behaviors and lexemes that it can play."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Protocol, runtime_checkable

from reactive_realizer.planunit.parameter import Range


@dataclass(frozen=True, slots=True)
class Changeable:
    """A parameter of a lexicon entry: its default value and its range."""

    default: float
    range: Range


@dataclass(frozen=True, slots=True)
class LexiconEntry:
    """A lexeme that a planner may use, or an element without lexemes.

    Attributes:
        element: local name of the behavior's element; "pose" for a part of a posture.
        lexeme: the lexeme, or the name of an animation; empty for an element without either.
        constraints: other attributes that the behavior must have for it, attribute to value.
        sync_points: in the order of time.
        duration: its preferred duration, s; None if it has none.
        parameters: by their names in BML.
        file: name of its file, if it has one.
        problem: the reason for which it cannot be played; None if it can.
    """

    element: str
    lexeme: str
    constraints: Mapping[str, str] = field(default_factory=dict)
    sync_points: tuple[str, ...] = ()
    duration: float | None = None
    parameters: Mapping[str, Changeable] = field(default_factory=dict)
    file: str | None = None
    problem: str | None = None


@runtime_checkable
class LexiconProvider(Protocol):
    """An engine with a lexicon."""

    def lexicon(self) -> Iterator[LexiconEntry]:
        """The entries, including those that cannot be played; may read files."""
        ...


def lexicon_of(engines: Iterable[object]) -> list[LexiconEntry]:
    """The entries of all engines that have a lexicon, in the order of the engines."""
    return [entry for engine in engines if isinstance(engine, LexiconProvider) for entry in engine.lexicon()]
