"""Failures of formulas, which are values, and misuse of the graph, which is a programming error."""

from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True)
class Failure:
    """The value of a cell whose formula raised. It propagates, is recorded and heals like any other value.

    Two failures with the same reason are equal, so that a repeated failure does not count as a change.

    Attributes:
        cell: name of the cell whose formula raised.
        reason: the error, for people.
        error: the error.
    """

    cell: str
    reason: str
    error: Exception = field(compare=False, repr=False)


class ReactiveError(RuntimeError):
    """Base of the errors of this package."""


class CellError(ReactiveError):
    """A cell was read that has no value, because its formula, or one that it depends on, raised."""

    def __init__(self, name: str, failure: Failure) -> None:
        by = "" if failure.cell == name else f" through '{failure.cell}'"
        super().__init__(f"'{name}' has failed{by}: {failure.reason}")
        self.failure = failure


class PropagationCycleError(ReactiveError):
    """A cell would depend on itself; ``path`` names the cells from it back to itself."""

    def __init__(self, path: tuple[str, ...]) -> None:
        super().__init__("a cell would depend on itself: " + " -> ".join(path))
        self.path = path


class WriteOutsideTransactionError(ReactiveError):
    """A cell was written while no transaction was open."""


class WriteDuringCommitError(ReactiveError):
    """An observer wrote a cell; observers may only read."""


class DisposedCellError(ReactiveError):
    """A cell was written after it was disposed of."""
