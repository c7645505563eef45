"""A value that others may depend on."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from reactive_realizer.reactive.errors import PropagationCycleError

if TYPE_CHECKING:
    from reactive_realizer.reactive.graph import Graph

T = TypeVar("T")


class Cell(Generic[T]):
    """A node of the graph: a value, and the cells that are computed from it.

    Attributes:
        name: for people: errors, logs, the viewer.
        rank: greater than the rank of everything the cell depends on.
        sequence: order of creation; decides among cells of one rank, so that propagation has one order.
    """

    __slots__ = ("_observers", "_value", "dependents", "graph", "name", "rank", "sequence")

    def __init__(self, graph: "Graph", name: str, value: T) -> None:
        self.graph = graph
        self.name = name
        self.rank = 0
        self.sequence = graph.next_sequence()
        self.dependents: dict[Derived[Any], None] = {}
        self._observers: dict[object, Callable[[T], None]] = {}
        self._value = value

    @property
    def value(self) -> T:
        """The current value, never stale: inside a transaction what was written so far is propagated first."""
        self.graph.settle()
        return self._value

    def observe(self, callback: Callable[[T], None]) -> "Subscription":
        """Call ``callback(value)`` after each commit that changed this cell; it may not write."""
        subscription = Subscription(self._observers)
        self._observers[subscription] = callback
        return subscription

    def notify(self) -> None:
        """Tell the observers; one that is disposed of meanwhile is left out."""
        for key, callback in list(self._observers.items()):
            if key in self._observers:
                callback(self._value)

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.name} = {self._value}>"


class Subscription:
    """Undoes an `observe`; disposing twice is harmless."""

    def __init__(self, observers: dict[object, Any]) -> None:
        self._observers = observers

    def dispose(self) -> None:
        """Stop being told."""
        self._observers.pop(self, None)


class Source(Cell[T]):
    """A cell that is written from outside."""

    __slots__ = ()

    def set(self, value: T) -> None:
        """Write within a transaction; an equal value changes nothing."""
        self.graph.write(self, value)


class Derived(Cell[T]):
    """A cell computed from others by a pure formula over their values, in the order of ``dependencies``."""

    __slots__ = ("dependencies", "formula")

    def __init__(
        self, graph: "Graph", name: str, dependencies: tuple[Cell[Any], ...], formula: Callable[..., T]
    ) -> None:
        super().__init__(graph, name, formula(*(cell.value for cell in dependencies)))
        self.formula = formula
        self.dependencies: tuple[Cell[Any], ...] = ()
        self._link(dependencies)

    def rebind(self, dependencies: tuple[Cell[Any], ...], formula: Callable[..., T]) -> None:
        """Within a transaction, depend on other cells by another formula.

        Raises:
            PropagationCycleError: one of them depends on this cell; nothing changes.
        """
        self._refuse_cycle(dependencies)
        self._unlink()
        self.formula = formula
        self._link(dependencies)
        self.graph.write(self, formula(*(cell.value for cell in dependencies)))

    def pin(self, value: T) -> None:
        """Within a transaction, cut the cell from what it depends on and give it its last value."""
        self._unlink()
        self.graph.write(self, value)

    def compute(self) -> T:
        """The formula applied to the current values."""
        return self.formula(*[cell._value for cell in self.dependencies])

    def _link(self, dependencies: tuple[Cell[Any], ...]) -> None:
        self.dependencies = dependencies
        for cell in dependencies:
            cell.dependents[self] = None
        _raise_rank(self, 1 + max((cell.rank for cell in dependencies), default=-1))

    def _unlink(self) -> None:
        for cell in self.dependencies:
            cell.dependents.pop(self, None)
        self.dependencies = ()

    def _refuse_cycle(self, dependencies: tuple[Cell[Any], ...]) -> None:
        below: dict[Cell[Any], Cell[Any]] = {}
        waiting: list[Cell[Any]] = list(dependencies)
        while waiting:
            cell = waiting.pop()
            if cell is self:
                raise PropagationCycleError(_path(self, below))
            for source in getattr(cell, "dependencies", ()):
                if source not in below:
                    below[source] = cell
                    waiting.append(source)


def _raise_rank(cell: Cell[Any], rank: int) -> None:
    # Ranks only grow: a rank higher than needed costs nothing, lowering one would cost a walk.
    waiting = [(cell, rank)]
    while waiting:
        cell, rank = waiting.pop()
        if rank > cell.rank:
            cell.graph.rerank(cell, rank)
            waiting.extend((dependent, rank + 1) for dependent in cell.dependents)


def _path(cell: Cell[Any], below: dict[Cell[Any], Cell[Any]]) -> tuple[str, ...]:
    names = [cell.name]
    step = below.get(cell)
    while step is not None and step is not cell:
        names.append(step.name)
        step = below.get(step)
    return (*names, cell.name)
