"""Cells and the graph that propagates changes through them: many writes, one propagation, one record."""

import logging
from abc import abstractmethod
from collections.abc import Callable, Collection
from dataclasses import dataclass
from heapq import heappop, heappush
from operator import attrgetter
from typing import Any, Generic, NamedTuple, TypeVar

from reactive_realizer.reactive.errors import (
    CellError,
    DisposedCellError,
    Failure,
    WriteDuringCommitError,
    WriteOutsideTransactionError,
)

T = TypeVar("T")

logger = logging.getLogger(__name__)

_SEQUENCE = attrgetter("sequence")
_tuple = tuple.__new__


class Cell(Generic[T]):
    """A node of the graph: a value that other cells may depend on.

    Attributes:
        name: for people: errors, logs, the viewer.
        rank: greater than the rank of every cell that it depends on.
        sequence: order of creation; decides among cells of one rank, so that propagation has one order.
        dependents: the cells that are computed from it, in order of linking.
        dependencies: the cells that it is computed from.
        stale: whether it has to be recomputed before it is read.
        stamp: of the commit that gave it its value; None if it was made outside of a transaction and never changed.
        disposed: whether it keeps its value forever.
    """

    __slots__ = (
        "__weakref__", "_value", "dependents", "disposed", "graph", "name", "observers", "rank", "sequence", "stale",
        "stamp",
    )  # fmt: skip

    dependencies: "tuple[Cell[Any], ...]" = ()

    _value: T | Failure

    def __init__(self, graph: "Graph", name: str) -> None:
        self.graph = graph
        self.name = name
        self.rank = 0
        self.dependents: dict[Cell[Any], None] = {}
        self.observers: dict[Observer, None] = {}
        self.stale = False
        self.stamp: Stamp | None = None
        self.disposed = False
        self.sequence = graph.enter(self)

    @property
    def value(self) -> T:
        """The current value, never stale: inside a transaction all earlier writes are propagated first.

        Raises:
            CellError: it has no value, because its formula, or one that it depends on, raised.
        """
        if self.graph.stale_ranks:  # tested here, because no other property is read as often
            self.graph.settle()
        value = self._value
        if isinstance(value, Failure):
            raise CellError(self.name, value)
        return value

    @property
    def result(self) -> T | Failure:
        """The current value, or the failure that replaces it."""
        self.graph.settle()
        return self._value

    def compute(self) -> T | Failure:
        """Its value, recomputed if it depends on other cells."""
        return self._value

    def depends_on(self, other: "Cell[Any]") -> bool:
        """Whether this is the other cell, or is computed from it, directly or through others."""
        seen: set[Cell[Any]] = {other}
        waiting: list[Cell[Any]] = [other]
        while waiting:
            cell = waiting.pop()
            if cell is self:
                return True
            new = [each for each in cell.dependents if each not in seen and each.rank <= self.rank]
            seen.update(new)
            waiting += new
        return False

    def observe(
        self, notify: Callable[["Change"], object], ended: Callable[[], object] = lambda: None
    ) -> "Subscription":
        """Call ``notify(change)`` after each commit that changed this cell, and ``ended()`` when it is disposed of.

        Neither may write. An error that ``notify`` raises is logged.
        """
        return Subscription(self.observers, notify, ended)

    def attach(self, observer: "Observer") -> None:
        """As `observe`, with an observer of several cells."""
        self.observers[observer] = None

    def detach(self, observer: "Observer") -> None:
        """Have an observer not be notified any more."""
        self.observers.pop(observer, None)

    def dispose(self) -> None:
        """Take the cell out of propagation, at any time: it keeps its value.

        Its dependents keep using that value as a constant; its observers are no longer notified.
        """
        self.graph.settle()
        self.disposed = True
        observers = list(self.observers)
        self.observers.clear()
        for observer in observers:
            observer.ended()

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.name} = {self._value}>"


class Observer:
    """What is notified after each commit that changed a cell, and when the cell is disposed of."""

    __slots__ = ()

    @abstractmethod
    def notify(self, change: "Change") -> None:
        """A commit has changed a cell."""

    def ended(self) -> None:
        """A cell was disposed of."""


class Subscription(Observer):
    """An observer of one cell, until it is disposed of; disposing twice is harmless."""

    __slots__ = ("_ended", "_notify", "_observers")

    def __init__(
        self,
        observers: dict[Observer, None],
        notify: Callable[["Change"], object],
        ended: Callable[[], object],
    ) -> None:
        self._notify = notify
        self._ended = ended
        self._observers = observers
        observers[self] = None

    def notify(self, change: "Change") -> None:
        """Call the function for changes."""
        self._notify(change)

    def ended(self) -> None:
        """Call the function for the end."""
        self._ended()

    def dispose(self) -> None:
        """Stop observing."""
        self._observers.pop(self, None)


class Change(NamedTuple):
    """A cell whose value a commit changed; a value may be a `Failure`."""

    cell: Cell[Any]
    old: Any
    new: Any


@dataclass(frozen=True, slots=True)
class Stamp:
    """Identifies a commit; each cell keeps the stamp of the commit that gave it its value.

    Attributes:
        sequence: number of the commit, from 1.
        cause: the reason for the transaction, for people.
        time: of the commit, as the owner of the graph sets it.
    """

    sequence: int
    cause: str
    time: float


@dataclass(frozen=True, slots=True)
class Commit:
    """The record of a transaction that changed or made something.

    Attributes:
        stamp: identifies it.
        changes: in order of recomputation; a cell that went A -> B -> A is not among them.
    """

    stamp: Stamp
    changes: tuple[Change, ...]


class _Transaction:
    """Writes that are committed together. A generator would take twice as long, and ticks have dozens of these."""

    __slots__ = ("_cause", "_graph")

    def __init__(self, graph: "Graph", cause: str) -> None:
        self._graph = graph
        self._cause = cause

    def __enter__(self) -> None:
        self._graph._begin(self._cause)

    def __exit__(self, *_: object) -> None:
        self._graph._end(self._cause)


class Graph:
    """Propagates changes through cells, in transactions.

    Cells that a write reaches are recomputed once each, in the order (rank, sequence), and only where a value they
    depend on has really changed. Stale cells wait in one bucket per rank: measured several times cheaper than one heap
    of cells.

    Attributes:
        time: noted in commits; its owner sets it.
        stale_ranks: a heap of the ranks that have stale cells; mostly empty.
    """

    def __init__(self) -> None:
        self.time = 0.0
        self.stale_ranks: list[int] = []
        self._buckets: dict[int, list[Cell[Any]]] = {}
        self._sequence = 0
        self._commits = 0
        self._depth = 0
        self._notifying = False
        self._before: dict[Cell[Any], Any] = {}
        self._made: list[Cell[Any]] = []
        self._rules: list[Callable[[Collection[Cell[Any]]], None]] = []
        self._listeners: list[Callable[[Commit], None]] = []

    def listen(self, listener: Callable[[Commit], None]) -> None:
        """Call ``listener(commit)`` after every commit that changed or made something, and after the cells' observers.

        It may not write; an error that it raises is logged.
        """
        self._listeners.append(listener)

    def before_commit(self, rule: Callable[[Collection[Cell[Any]]], None]) -> None:
        """Call ``rule(changed)`` at the end of every transaction that changed cells, before it commits.

        The rule may write, as part of the transaction; the cells that this changes are added to ``changed``.
        """
        self._rules.append(rule)

    def transaction(self, cause: str) -> "_Transaction":
        """A context manager that commits the writes of its body together; one within another joins it.

        If the body raises, its writes until then are committed, so that the graph stays consistent: do what may fail
        before opening a transaction.

        Raises:
            WriteDuringCommitError: opened by an observer or listener.
        """
        return _Transaction(self, cause)

    def _begin(self, cause: str) -> None:
        if self._notifying:
            raise WriteDuringCommitError(f"'{cause}' writes during a commit")
        self._depth += 1

    def _end(self, cause: str) -> None:
        self._depth -= 1
        if self._depth == 0:
            self.settle()
            try:
                self._apply_rules()
            finally:
                self._commit(cause)

    # --- for the cells

    def enter(self, cell: Cell[Any]) -> int:
        """Register a new cell, and return its sequence number."""
        if self._depth:
            self._made.append(cell)
        self._sequence += 1
        return self._sequence

    def write(self, cell: Cell[Any], value: Any) -> None:
        """Give a cell a value.

        Raises:
            WriteOutsideTransactionError: no transaction is open.
            DisposedCellError: the cell keeps its value forever.
        """
        self._check_writable(cell)
        self._give(cell, value)

    def touch(self, cell: Cell[Any]) -> None:
        """Mark a cell for recomputation, because its formula or its dependencies have changed.

        Raises:
            WriteOutsideTransactionError: no transaction is open.
            DisposedCellError: the cell keeps its value forever.
        """
        self._check_writable(cell)
        if not cell.stale:
            self._mark_stale(cell)

    def rerank(self, cell: Cell[Any], rank: int) -> None:
        """Move a cell to a higher rank, also while it waits to be recomputed."""
        cell.rank = rank
        if cell.stale:
            self._mark_stale(cell)

    def settle(self) -> None:
        """Recompute the stale cells, lowest rank first."""
        while self.stale_ranks:
            rank = heappop(self.stale_ranks)
            bucket = self._buckets.pop(rank)
            for cell in sorted(bucket, key=_SEQUENCE) if len(bucket) > 1 else bucket:
                # It may have been pinned or moved to another rank in the meantime.
                if cell.stale and cell.rank == rank:
                    cell.stale = False
                    self._give(cell, cell.compute())

    def _give(self, cell: Cell[Any], value: Any) -> None:
        old = cell._value
        if value != old:
            self._before.setdefault(cell, old)
            cell._value = value
            for dependent in cell.dependents:
                if not dependent.stale:
                    self._mark_stale(dependent)

    def _check_writable(self, cell: Cell[Any]) -> None:
        if self._depth == 0:
            raise WriteOutsideTransactionError(f"'{cell.name}' is written outside a transaction")
        if cell.disposed:
            raise DisposedCellError(f"'{cell.name}' is written after it was disposed of")

    def _mark_stale(self, cell: Cell[Any]) -> None:
        cell.stale = True
        bucket = self._buckets.get(cell.rank)
        if bucket is None:
            self._buckets[cell.rank] = [cell]
            heappush(self.stale_ranks, cell.rank)
        else:
            bucket.append(cell)

    def _apply_rules(self) -> None:
        if not self._before:
            return
        self._depth += 1
        try:
            for rule in self._rules:
                rule(self._before.keys())
        finally:
            self._depth -= 1
            self.settle()

    def _commit(self, cause: str) -> None:
        before = self._before.items()
        # Equivalent to `Change(...)`, in half the time: this runs for every changed cell.
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
        self._notify(commit)

    def _notify(self, commit: Commit) -> None:
        self._notifying = True
        try:
            for change in commit.changes:
                cell = change[0]
                for observer in tuple(cell.observers) if cell.observers else ():
                    # An observer may have detached one that comes after it.
                    if observer in cell.observers:
                        try:
                            observer.notify(change)
                        except Exception:
                            _log_failure(observer, cell.name)
            for listener in self._listeners:
                try:
                    listener(commit)
                except Exception:
                    _log_failure(listener, commit.stamp.cause)
        finally:
            self._notifying = False


def _log_failure(notified: object, about: str) -> None:
    """Log the exception of what was notified."""
    logger.exception("%r, which was notified of '%s', raised", notified, about)
