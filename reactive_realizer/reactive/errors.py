"""Misuse of the graph: mistakes of a programmer, not of a user."""

from reactive_realizer.reactive.failure import Failure


class ReactiveError(RuntimeError):
    """Base of the errors of this room."""


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
    """An observer wrote a cell; observers only look."""


class DisposedCellError(ReactiveError):
    """A cell was written after it was disposed of."""
