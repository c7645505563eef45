"""Misuse of the graph: mistakes of a programmer, not of a user."""


class ReactiveError(RuntimeError):
    """Base of the errors of this room."""


class PropagationCycleError(ReactiveError):
    """A cell would depend on itself; ``path`` names the cells from it back to itself."""

    def __init__(self, path: tuple[str, ...]) -> None:
        super().__init__("a cell would depend on itself: " + " -> ".join(path))
        self.path = path


class WriteOutsideTransactionError(ReactiveError):
    """A cell was written while no transaction was open."""


class WriteDuringCommitError(ReactiveError):
    """An observer wrote a cell; observers only look."""
