"""The kinds of cells: sources, which are written, and cells that are computed from others or accumulate them."""

import logging
from collections.abc import Callable, Collection, Iterable
from typing import Any, TypeVar

from reactive_realizer.reactive.errors import Failure, PropagationCycleError
from reactive_realizer.reactive.graph import Cell, Graph

T = TypeVar("T")

logger = logging.getLogger(__name__)


class Source(Cell[T]):
    """A cell with a value that is written, not computed."""

    __slots__ = ()

    def __init__(self, graph: Graph, name: str, value: T) -> None:
        super().__init__(graph, name)
        self._value = value

    def set(self, value: T) -> None:
        """Write within a transaction; an equal value changes nothing.

        Raises:
            WriteOutsideTransactionError: no transaction is open.
            DisposedCellError: the cell keeps its value forever.
        """
        self.graph.write(self, value)


class Derived(Cell[T]):
    """A cell computed from others by a pure formula over their values, in the order of ``dependencies``.

    If a formula raises, or a cell that it depends on has failed, the value is a `Failure`; it heals with the next value
    that can be computed.

    Attributes:
        formula: computes the value; it has no effects.
    """

    __slots__ = ("dependencies", "formula")

    def __init__(self, graph: Graph, name: str, dependencies: tuple[Cell[Any], ...], formula: Callable[..., T]) -> None:
        super().__init__(graph, name)
        if graph.stale_ranks:
            graph.settle()
        self.formula = formula
        self._link(dependencies)
        self._value = self.compute()

    def rebind(self, dependencies: tuple[Cell[Any], ...], formula: Callable[..., T]) -> None:
        """Within a transaction, depend on other cells by another formula.

        Raises:
            PropagationCycleError: one of them depends on this cell; nothing changes.
            DisposedCellError: the cell keeps its value forever.
        """
        _refuse_cycle((self,), dependencies)
        self._relink(dependencies)
        self.formula = formula

    def pin(self, value: T) -> None:
        """Within a transaction, cut the cell from what it depends on and give it its last value.

        Raises:
            DisposedCellError: it has its last value.
        """
        self.graph.write(self, value)
        self.stale = False
        self._unlink()

    def dispose(self) -> None:
        """Take the cell out of propagation, at any time: it keeps its value and depends on nothing any more."""
        super().dispose()
        self._unlink()

    def compute(self) -> T | Failure:
        """The formula applied to the current values, or the failure of doing so."""
        dependencies = self.dependencies
        if len(dependencies) == 1:  # most cells have one
            value = dependencies[0]._value
            if type(value) is Failure:
                return value
            try:
                return self.formula(value)
            except Exception as error:
                return self._failure(error)
        values = [cell._value for cell in dependencies]
        for value in values:
            if type(value) is Failure:
                return value
        try:
            return self.formula(*values)
        except Exception as error:
            return self._failure(error)

    def _failure(self, error: Exception) -> Failure:
        logger.error("the formula of '%s' raised", self.name, exc_info=error)
        return Failure(self.name, f"{type(error).__name__}: {error}", error.with_traceback(None))

    def _relink(self, dependencies: tuple[Cell[Any], ...]) -> None:
        self.graph.touch(self)
        self._unlink()
        self._link(dependencies)

    def _link(self, dependencies: tuple[Cell[Any], ...]) -> None:
        self.dependencies: tuple[Cell[Any], ...] = dependencies
        rank = -1
        for cell in dependencies:
            cell.dependents[self] = None
            if cell.rank > rank:
                rank = cell.rank
        if rank >= self.rank:
            _raise_rank(self, rank + 1)

    def _unlink(self) -> None:
        for cell in self.dependencies:
            cell.dependents.pop(self, None)
        self.dependencies = ()


class Scan(Derived[T]):
    """A cell computed from its own last value and from others, such as one that integrates over time.

    Its formula is ``formula(last, *values)``. Without a change of the values, it must return ``last``: a cell may be
    computed several times in a transaction.
    """

    __slots__ = ("_last",)

    def __init__(
        self, graph: Graph, name: str, initial: T, dependencies: tuple[Cell[Any], ...], formula: Callable[..., T]
    ) -> None:
        self._last = initial
        super().__init__(graph, name, dependencies, formula)

    def compute(self) -> T | Failure:
        """The formula applied to the last value that could be computed and to the current values of the others."""
        values = [cell._value for cell in self.dependencies]
        for value in values:
            if type(value) is Failure:
                return value
        try:
            self._last = self.formula(self._last, *values)
        except Exception as error:
            return self._failure(error)
        return self._last


def replace_cell(old: Cell[T], new: Cell[T]) -> None:
    """Within a transaction, make all dependents of a cell depend on another one. Observers stay.

    Raises:
        PropagationCycleError: the other depends on one of those; nothing changes.
    """
    dependents = [cell for cell in old.dependents if isinstance(cell, Derived)]
    _refuse_cycle(dependents, (new,))
    for dependent in dependents:
        dependent._relink(tuple(new if cell is old else cell for cell in dependent.dependencies))


def _raise_rank(cell: Cell[Any], rank: int) -> None:
    """Raise the rank of a cell, and of all cells that depend on it, to at least a rank.

    Ranks only grow: a rank higher than needed costs nothing, lowering one would cost a walk.
    """
    waiting = [(cell, rank)]
    while waiting:
        cell, rank = waiting.pop()
        if rank > cell.rank:
            cell.graph.rerank(cell, rank)
            waiting.extend((dependent, rank + 1) for dependent in cell.dependents)


def _refuse_cycle(cells: Collection[Cell[Any]], dependencies: Iterable[Cell[Any]]) -> None:
    """Check that no cell would come to depend on itself, if some cells depended on others.

    Raises:
        PropagationCycleError: with the path from the cell back to itself.
    """
    lowest = min((cell.rank for cell in cells), default=0)
    below: dict[Cell[Any], Cell[Any] | None] = dict.fromkeys(dependencies)
    waiting = list(below)
    while waiting:
        cell = waiting.pop()
        if cell in cells:
            raise PropagationCycleError(_path(cell, below))
        # A cell that is ranked no higher than all of them depends on none of them.
        for source in cell.dependencies if cell.rank > lowest else ():
            if source not in below:
                below[source] = cell
                waiting.append(source)


def _path(cell: Cell[Any], below: dict[Cell[Any], Cell[Any] | None]) -> tuple[str, ...]:
    names = [cell.name]
    step = below[cell]
    while step is not None:
        names.append(step.name)
        step = below[step]
    return (*names, cell.name)
