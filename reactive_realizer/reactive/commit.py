"""What one transaction changed, as data."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from reactive_realizer.reactive.cell import Cell


class Change(NamedTuple):
    """A cell that has another value after a commit than before; a value may be a `Failure`."""

    cell: "Cell[Any]"
    old: Any
    new: Any


@dataclass(frozen=True, slots=True)
class Stamp:
    """Which commit it was; each cell keeps that of the one that gave it its value.

    Attributes:
        sequence: number of the commit, from 1.
        cause: who wrote, for people.
        time: when, as the owner of the graph tells time.
    """

    sequence: int
    cause: str
    time: float


@dataclass(frozen=True, slots=True)
class Commit:
    """The record of a transaction that changed or made something.

    Attributes:
        stamp: which it was.
        changes: in order of recomputation; a cell that went A -> B -> A is not among them.
    """

    stamp: Stamp
    changes: tuple[Change, ...]

    @property
    def sequence(self) -> int:
        """Number of the commit, from 1."""
        return self.stamp.sequence

    @property
    def cause(self) -> str:
        """Who wrote, for people."""
        return self.stamp.cause
