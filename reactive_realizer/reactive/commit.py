"""What one transaction changed, as data."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from reactive_realizer.reactive.cell import Cell


class Change(NamedTuple):
    """A cell that has another value after a commit than before."""

    cell: "Cell[Any]"
    old: Any
    new: Any


@dataclass(frozen=True, slots=True)
class Commit:
    """The record of a transaction.

    Attributes:
        sequence: number of the commit, from 1.
        cause: who wrote, for people.
        changes: in order of recomputation; a cell that went A -> B -> A is not among them.
    """

    sequence: int
    cause: str
    changes: tuple[Change, ...]
