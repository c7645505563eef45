"""What of a behavior may be changed while it plays (thesis 6.6.6)."""

from collections.abc import Collection
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from reactive_realizer.reactive.cell import Source

if TYPE_CHECKING:
    from reactive_realizer.planunit.plan_unit import PlanUnit


class Range(NamedTuple):
    """The values that mean something, both ends among them, in the unit of the parameter."""

    low: float
    high: float

    def __contains__(self, value: object) -> bool:
        return isinstance(value, int | float) and self.low <= value <= self.high


def spelled(word: str, known: Collection[str]) -> str:
    """A name or another word as those spell it who know it: it may be said in any case, `_` like `-`.

    What nobody knows stays as it is said. Of names that are the same word, as of formulas, each keeps its own.
    """
    if word in known:
        return word
    return next((each for each in known if _folded(each) == _folded(word)), word)


def _folded(word: str) -> str:
    return word.strip().casefold().replace("_", "-")


@dataclass(slots=True, eq=False)
class Parameter:
    """A value of a unit as a cell: whatever shows it follows.

    Attributes:
        unit: whose it is.
        cell: the value.
        range: of its values.
        owner: the unit that changed it last; of two that change it, the later start wins.
    """

    unit: "PlanUnit"
    cell: Source[float]
    range: Range
    owner: "PlanUnit | None" = None

    @property
    def value(self) -> float:
        """What it is now."""
        return self.cell.value

    def set(self, value: float) -> None:
        """Give it a value, as a transaction of its own or within one; for the scheduler alone."""
        with self.cell.graph.transaction(f"set {self.cell.name}"):
            self.cell.set(value)
