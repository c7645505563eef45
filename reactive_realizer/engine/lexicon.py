"""The words that an engine has a form for."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Protocol, runtime_checkable

from reactive_realizer.planunit.parameter import Range


@dataclass(frozen=True, slots=True)
class Changeable:
    """A parameter of what plays a word: its value where nobody says otherwise, and the values that mean something."""

    default: float
    range: Range


@dataclass(frozen=True, slots=True)
class Word:
    """What a planner may ask for, and what comes of it.

    Attributes:
        element: local name of the behavior's element; "pose" for a part of a posture.
        lexeme: the word itself, also the name of an animation; empty for an element that wants none.
        constraints: what else the behavior has to say for it, attribute to value.
        sync_points: in the order in which they are reached.
        duration: how long it takes where nothing else is asked for, s; None where that is nothing of its own.
        parameters: by their names in BML.
        file: name of the file that it is made of, if there is one.
        problem: why it does not play; None for what does.
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
class WordProvider(Protocol):
    """An engine that knows words."""

    def words(self) -> Iterator[Word]:
        """Those it was told of, also those that do not play; it may read files."""
        ...


def words_of(engines: Iterable[object]) -> list[Word]:
    """The words of all engines that know some, in their order."""
    return [word for engine in engines if isinstance(engine, WordProvider) for word in engine.words()]
