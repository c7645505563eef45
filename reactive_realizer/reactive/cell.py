"""A value that others may depend on."""

import asyncio
import logging
from collections.abc import AsyncIterator, Callable
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from reactive_realizer.reactive.commit import Stamp
from reactive_realizer.reactive.errors import CellError
from reactive_realizer.reactive.failure import Failure
from reactive_realizer.reactive.order import raise_rank, refuse_cycle
from reactive_realizer.reactive.subscription import Subscription

if TYPE_CHECKING:
    from reactive_realizer.reactive.graph import Graph

T = TypeVar("T")

logger = logging.getLogger(__name__)


class Cell(Generic[T]):
    """A node of the graph: a value, and the cells that are computed from it.

    Attributes:
        name: for people: errors, logs, the viewer.
        rank: greater than the rank of everything the cell depends on.
        sequence: order of creation; decides among cells of one rank, so that propagation has one order.
        dependents: what is computed from it, in order of linking.
        dependencies: what it is computed from.
        stamp: of the commit that gave it its value; None for one made outside of a transaction and never changed.
        disposed: whether it keeps its value for ever.
    """

    __slots__ = (
        "__weakref__", "_value", "dependents", "disposed", "graph", "name", "observers", "rank", "sequence", "stamp",
    )  # fmt: skip

    dependencies: "tuple[Cell[Any], ...]" = ()

    _value: T | Failure

    def __init__(self, graph: "Graph", name: str) -> None:
        self.graph = graph
        self.name = name
        self.rank = 0
        self.dependents: dict[Derived[Any], None] = {}
        self.observers: dict[Subscription, None] = {}
        self.stamp: Stamp | None = None
        self.disposed = False
        self.sequence = graph.enter(self)

    @property
    def value(self) -> T:
        """The current value, never stale: inside a transaction what was written so far is propagated first.

        Raises:
            CellError: there is none, because its formula or one that it depends on raised.
        """
        if self.graph.waiting:  # asked here, for this is read more often than anything else
            self.graph.settle()
        value = self._value
        if isinstance(value, Failure):
            raise CellError(self.name, value)
        return value

    @property
    def result(self) -> T | Failure:
        """The current value, or why there is none."""
        self.graph.settle()
        return self._value

    def observe(self, tell: Callable[[T | Failure], None], ended: Callable[[], object] = lambda: None) -> Subscription:
        """Call ``tell(value)`` after each commit that changed this cell, and ``ended()`` when it is disposed of.

        Neither may write. What ``tell`` raises is logged, and the others are told.
        """
        return Subscription(self.observers, tell, ended)

    def changes(self) -> AsyncIterator[T | Failure]:
        """The values that commits give the cell from now on; who is slow gets the last one only.

        It ends when the cell is disposed of. Nothing is held between two values, so that it may be left anywhere.
        """
        return self._changes_since(self._value)

    def replace_by(self, other: "Cell[T]") -> None:
        """Within a transaction, have all that hangs on this cell hang on another one. Observers stay.

        Raises:
            PropagationCycleError: the other depends on one of those; nothing changes.
        """
        refuse_cycle(self.dependents, (other,))
        for dependent in list(self.dependents):
            dependent.hang_on(tuple(other if cell is self else cell for cell in dependent.dependencies))

    def dispose(self) -> None:
        """Take the cell out of propagation, at any time: it keeps the value it has.

        What hangs on it goes on with that value as a constant; its observers are told no more.
        """
        self.graph.settle()
        self.disposed = True
        for subscription in list(self.observers):
            subscription.dispose()
            subscription.ended()

    async def _changes_since(self, seen: T | Failure) -> AsyncIterator[T | Failure]:
        while True:
            # NaN is not equal to itself, but the same.
            if self._value is not seen and self._value != seen:
                seen = self._value
                yield seen
            elif self.disposed:
                return
            else:
                await self._next_change()

    async def _next_change(self) -> None:
        changed = asyncio.Event()
        subscription = self.observe(lambda _: changed.set(), changed.set)
        try:
            await changed.wait()
        finally:
            subscription.dispose()

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.name} = {self._value}>"


class Source(Cell[T]):
    """A cell that is written from outside."""

    __slots__ = ()

    def __init__(self, graph: "Graph", name: str, value: T) -> None:
        super().__init__(graph, name)
        self._value = value

    def set(self, value: T) -> None:
        """Write within a transaction; an equal value changes nothing.

        Raises:
            WriteOutsideTransactionError: no transaction is open.
            DisposedCellError: the cell keeps its value for ever.
        """
        self.graph.write(self, value)


class Derived(Cell[T]):
    """A cell computed from others by a pure formula over their values, in the order of ``dependencies``.

    A formula that raises leaves a `Failure` in the cell, and so does one of the cells it depends on; it heals with the
    next value that can be computed.

    Attributes:
        formula: gives the value; it only computes.
        waiting: whether it is to be computed before it is read; for the graph.
    """

    __slots__ = ("dependencies", "formula", "waiting")

    def __init__(
        self, graph: "Graph", name: str, dependencies: tuple[Cell[Any], ...], formula: Callable[..., T]
    ) -> None:
        super().__init__(graph, name)
        graph.settle()
        self.formula = formula
        self.waiting = False
        self._link(dependencies)
        self._value = self.compute()

    def rebind(self, dependencies: tuple[Cell[Any], ...], formula: Callable[..., T]) -> None:
        """Within a transaction, depend on other cells by another formula.

        Raises:
            PropagationCycleError: one of them depends on this cell; nothing changes.
            DisposedCellError: the cell keeps its value for ever.
        """
        refuse_cycle((self,), dependencies)
        self.hang_on(dependencies)
        self.formula = formula

    def hang_on(self, dependencies: tuple[Cell[Any], ...]) -> None:
        """Within a transaction, depend on other cells by the same formula; whoever calls has refused cycles."""
        self.graph.touch(self)
        self._unlink()
        self._link(dependencies)

    def pin(self, value: T) -> None:
        """Within a transaction, cut the cell from what it depends on and give it its last value.

        Raises:
            DisposedCellError: it has its last value.
        """
        self.graph.write(self, value)
        self.waiting = False
        self._unlink()

    def dispose(self) -> None:
        """Take the cell out of propagation, at any time: it keeps the value it has, cut from what it depends on."""
        super().dispose()
        self._unlink()

    def compute(self) -> T | Failure:
        """The formula applied to the current values, or why that is not possible."""
        values = []
        for cell in self.dependencies:
            value = cell._value
            if type(value) is Failure:
                return value
            values.append(value)
        try:
            return self.formula(*values)
        except Exception as error:
            logger.exception("the formula of '%s' raised", self.name)
            return Failure(self.name, f"{type(error).__name__}: {error}", error.with_traceback(None))

    def _link(self, dependencies: tuple[Cell[Any], ...]) -> None:
        self.dependencies: tuple[Cell[Any], ...] = dependencies
        rank = -1
        for cell in dependencies:
            cell.dependents[self] = None
            if cell.rank > rank:
                rank = cell.rank
        if rank >= self.rank:
            raise_rank(self, rank + 1)

    def _unlink(self) -> None:
        for cell in self.dependencies:
            cell.dependents.pop(self, None)
        self.dependencies = ()
