"""Transactions: many writes, one propagation, one record."""

import logging
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from heapq import heappop, heappush
from operator import attrgetter
from typing import Any

from reactive_realizer.reactive.cell import Cell, Derived
from reactive_realizer.reactive.commit import Change, Commit, Stamp
from reactive_realizer.reactive.errors import (
    DisposedCellError,
    WriteDuringCommitError,
    WriteOutsideTransactionError,
)

logger = logging.getLogger(__name__)

_SEQUENCE = attrgetter("sequence")
_tuple = tuple.__new__


class Graph:
    """Owns the cells' order and propagates changes through them.

    Cells that a write reaches are recomputed once each, in the order (rank, sequence), and no further than values
    really change (equality cut-off). Touched cells wait in one bucket a rank: measured several times cheaper than one
    heap of cells.

    Attributes:
        time: what its owner says the time is; noted in commits.
        waiting: ranks of which cells are to be recomputed, lowest first; mostly none.
    """

    def __init__(self) -> None:
        self.time = 0.0
        self._sequence = 0
        self._commits = 0
        self._depth = 0
        self._notifying = False
        self._buckets: dict[int, list[Derived[Any]]] = {}
        self.waiting: list[int] = []
        self._before: dict[Cell[Any], Any] = {}
        self._made: list[Cell[Any]] = []
        self._listeners: list[Callable[[Commit], None]] = []

    def listen(self, listener: Callable[[Commit], None]) -> None:
        """Call ``listener(commit)`` after every commit that changed or made something, and after the cells' observers.

        It may not write; what it raises is logged.
        """
        self._listeners.append(listener)

    @contextmanager
    def transaction(self, cause: str) -> Iterator[None]:
        """Writes inside are seen together, as one commit; a transaction within a transaction joins it.

        A body that raises commits what it wrote until then, so that the graph stays consistent: whoever may fail does
        so before opening a transaction.

        Raises:
            WriteDuringCommitError: opened by an observer or listener.
        """
        if self._notifying:
            raise WriteDuringCommitError(f"'{cause}' writes while a commit is being told")
        self._depth += 1
        try:
            yield
        finally:
            self._depth -= 1
            if self._depth == 0:
                self.settle()
                self._commit(cause)

    # --- for the cells

    def enter(self, cell: Cell[Any]) -> int:
        """Take in a new cell, which gets its number."""
        if self._depth:
            self._made.append(cell)
        self._sequence += 1
        return self._sequence

    def write(self, cell: Cell[Any], value: Any) -> None:
        """Give a cell its value and wake what depends on it."""
        self._check_writable(cell)
        self._give(cell, value)

    def touch(self, cell: Derived[Any]) -> None:
        """Have a derived cell recomputed before its value is next read."""
        self._check_writable(cell)
        if not cell.waiting:
            self._wake(cell)

    def rerank(self, cell: Derived[Any], rank: int) -> None:
        """Move a cell to a higher rank, also where it waits to be recomputed."""
        cell.rank = rank
        if cell.waiting:
            cell.waiting = False
            self._wake(cell)

    def settle(self) -> None:
        """Recompute what was touched, lowest rank first."""
        while self.waiting:
            rank = heappop(self.waiting)
            bucket = self._buckets.pop(rank)
            for cell in sorted(bucket, key=_SEQUENCE) if len(bucket) > 1 else bucket:
                # One that was pinned since is not to be computed, one that got another rank not here.
                if cell.waiting and cell.rank == rank:
                    cell.waiting = False
                    self._give(cell, cell.compute())

    def _give(self, cell: Cell[Any], value: Any) -> None:
        old = cell._value
        if value != old:
            self._before.setdefault(cell, old)
            cell._value = value
            for dependent in cell.dependents:
                if not dependent.waiting:
                    self._wake(dependent)

    def _check_writable(self, cell: Cell[Any]) -> None:
        if self._depth == 0:
            raise WriteOutsideTransactionError(f"'{cell.name}' is written outside a transaction")
        if cell.disposed:
            raise DisposedCellError(f"'{cell.name}' is written after it was disposed of")

    def _wake(self, cell: Derived[Any]) -> None:
        cell.waiting = True
        bucket = self._buckets.get(cell.rank)
        if bucket is None:
            self._buckets[cell.rank] = [cell]
            heappush(self.waiting, cell.rank)
        else:
            bucket.append(cell)

    def _commit(self, cause: str) -> None:
        before = self._before.items()
        # As `Change(...)` does, in half the time: every cell that changes comes by here.
        changes = tuple([_tuple(Change, (cell, old, cell._value)) for cell, old in before if cell._value != old])
        made = list(self._made)
        self._before.clear()
        self._made.clear()
        if not changes and not made:
            return
        self._commits += 1
        commit = Commit(Stamp(self._commits, cause, self.time), changes)
        for cell in made:
            cell.stamp = commit.stamp
        for change in changes:
            change.cell.stamp = commit.stamp
        self._tell(commit)

    def _tell(self, commit: Commit) -> None:
        self._notifying = True
        try:
            for cell, _, new in commit.changes:
                for subscription in list(cell.observers) if cell.observers else ():
                    # An observer may have disposed of one that comes after it.
                    if subscription in cell.observers:
                        _try(subscription.tell, new, cell.name)
            for listener in self._listeners:
                _try(listener, commit, commit.cause)
        finally:
            self._notifying = False


def _try(tell: Callable[[Any], None], value: object, about: str) -> None:
    try:
        tell(value)
    except Exception:
        logger.exception("%r, which was told of '%s', raised", tell, about)
