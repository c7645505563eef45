"""Transactions: many writes, one propagation, one record."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from heapq import heappop, heappush
from typing import Any

from reactive_realizer.reactive.cell import Cell, Derived
from reactive_realizer.reactive.commit import Change, Commit
from reactive_realizer.reactive.errors import WriteDuringCommitError, WriteOutsideTransactionError


class Graph:
    """Owns the cells' order and propagates changes through them.

    Cells that a write reaches are recomputed once each, in the order (rank, sequence), and no further than values
    really change (equality cut-off). Touched cells wait in one bucket a rank: measured several times cheaper than one
    heap of cells.
    """

    def __init__(self) -> None:
        self._sequence = 0
        self._commits = 0
        self._depth = 0
        self._notifying = False
        self._buckets: dict[int, dict[Derived[Any], None]] = {}
        self._ranks: list[int] = []
        self._before: dict[Cell[Any], Any] = {}
        self._listeners: list[Callable[[Commit], None]] = []

    def listen(self, listener: Callable[[Commit], None]) -> None:
        """Call ``listener(commit)`` after every commit that changed something, after the observers of the cells."""
        self._listeners.append(listener)

    @contextmanager
    def transaction(self, cause: str) -> Iterator[None]:
        """Writes inside are seen together, as one commit; a transaction within a transaction joins it.

        A body that raises commits what it wrote until then, so that the graph stays consistent: whoever may fail does
        so before opening a transaction. Formulas do not fail.

        Raises:
            WriteDuringCommitError: opened by an observer or listener.
        """
        if self._notifying:
            raise WriteDuringCommitError(f"'{cause}' writes while a commit is being told")
        self._depth += 1
        try:
            yield
        finally:
            if self._depth == 1:
                self.settle()
            self._depth -= 1
            if self._depth == 0:
                self._commit(cause)

    def write(self, cell: Cell[Any], value: Any) -> None:
        """Give a cell its value and wake what depends on it; for the cells themselves."""
        if self._depth == 0:
            raise WriteOutsideTransactionError(f"'{cell.name}' is written outside a transaction")
        old = cell._value
        if value == old:
            return
        self._before.setdefault(cell, old)
        cell._value = value
        for dependent in cell.dependents:
            self.touch(dependent)

    def touch(self, cell: Derived[Any]) -> None:
        """Have a derived cell recomputed before its value is next read."""
        if self._depth == 0:
            raise WriteOutsideTransactionError(f"'{cell.name}' is changed outside a transaction")
        bucket = self._buckets.get(cell.rank)
        if bucket is None:
            bucket = self._buckets[cell.rank] = {}
            heappush(self._ranks, cell.rank)
        bucket[cell] = None

    def settle(self) -> None:
        """Recompute what was touched, lowest rank first."""
        while self._ranks:
            rank = heappop(self._ranks)
            for cell in sorted(self._buckets.pop(rank), key=_by_sequence):
                # A touched cell may have been pinned since: then it has no formula to follow any more.
                if cell.dependencies:
                    self.write(cell, cell.compute())

    def rerank(self, cell: Cell[Any], rank: int) -> None:
        """Move a cell to a higher rank, also where it waits to be recomputed; for the cells themselves."""
        bucket = self._buckets.get(cell.rank, {})
        waiting = cell in bucket
        if waiting:
            bucket.pop(cell)  # type: ignore[call-overload]
        cell.rank = rank
        if waiting:
            self.touch(cell)  # type: ignore[arg-type]

    def next_sequence(self) -> int:
        """A number for a new cell."""
        self._sequence += 1
        return self._sequence

    def _commit(self, cause: str) -> None:
        changes = tuple(Change(cell, old, cell._value) for cell, old in self._before.items() if cell._value != old)
        self._before.clear()
        if not changes:
            return
        self._commits += 1
        commit = Commit(self._commits, cause, changes)
        self._notifying = True
        try:
            for change in changes:
                change.cell.notify()
            for listener in self._listeners:
                listener(commit)
        finally:
            self._notifying = False


def _by_sequence(cell: Cell[Any]) -> int:
    return cell.sequence
