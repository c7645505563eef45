"""Parameters of a behavior that may be changed while it plays (thesis 6.6.6)."""

from collections.abc import Collection
from dataclasses import dataclass
from typing import NamedTuple

from reactive_realizer.reactive.cell import Source


class Range(NamedTuple):
    """The valid values of a parameter, both ends included, in the unit of the parameter."""

    low: float
    high: float

    def __contains__(self, value: object) -> bool:
        return isinstance(value, int | float) and self.low <= value <= self.high


def spelled(word: str, known: Collection[str]) -> str:
    """A word in the spelling of the known word that differs from it only in case or in ``-`` for ``_``.

    An unknown word is returned as it is, and so is a known one.
    """
    if word in known:
        return word
    return next((each for each in known if _folded(each) == _folded(word)), word)


def _folded(word: str) -> str:
    return word.strip().casefold().replace("_", "-")


@dataclass(slots=True, eq=False)
class Parameter:
    """A parameter of a playing unit. Readers of its cell follow its changes.

    Attributes:
        cell: the value.
        range: of valid values.
        owner: the unit that changes it; if two do, the one that started later.
    """

    cell: Source[float]
    range: Range
    owner: object = None

    @property
    def value(self) -> float:
        """The present value."""
        return self.cell.value

    def set(self, value: float) -> None:
        """Set the value, in its own transaction or within one; only the scheduler calls this.

        The parameter of a behavior that has ended keeps its value.
        """
        if self.cell.disposed:
            return
        with self.cell.graph.transaction(f"set {self.cell.name}"):
            self.cell.set(value)
