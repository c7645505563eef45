"""Parameters of a behavior that may be changed while it plays (thesis 6.6.6)."""

from collections.abc import Collection, Iterator, Mapping
from typing import NamedTuple

from reactive_realizer.reactive.cell import Derived
from reactive_realizer.reactive.graph import Cell, Graph


class Range(NamedTuple):
    """The valid values of a parameter, both ends included, in the unit of the parameter."""

    low: float
    high: float

    def __contains__(self, value: object) -> bool:
        return isinstance(value, int | float) and self.low <= value <= self.high


def spelled(word: str, known: Collection[str]) -> str:
    """A word in the spelling of the known word that differs from it only in case or in ``-`` for ``_``.

    An unknown word is returned as it is, and so is a known one.
    """
    if word in known:
        return word
    return next((each for each in known if _folded(each) == _folded(word)), word)


def _folded(word: str) -> str:
    return word.strip().casefold().replace("_", "-")


class Parameter:
    """A parameter of a playing unit: a cell that is constant or follows another one.

    Attributes:
        cell: the value; disposed of when the unit ends.
        range: of valid values.
        owner: the unit that changes it; if two do, the one that started later.
    """

    __slots__ = ("cell", "owner", "range")

    def __init__(self, graph: Graph, name: str, value: float, range: Range) -> None:  # noqa: A002 - the word for it
        self.cell: Derived[float] = Derived(graph, name, (), lambda: value)
        self.range = range
        self.owner: object = None

    @property
    def value(self) -> float:
        """The present value."""
        return self.cell.value

    def set(self, value: float) -> None:
        """Give it a constant value, in its own transaction or within one; only the scheduler calls this.

        The parameter of a unit that has ended keeps its value.
        """
        if not self.cell.disposed:
            with self.cell.graph.transaction(f"set {self.cell.name}"):
                self.cell.pin(value)

    def follow(self, value: Cell[float]) -> None:
        """Have it follow a cell, in its own transaction or within one; only the scheduler calls this.

        The parameter of a unit that has ended keeps its value.
        """
        if not self.cell.disposed:
            with self.cell.graph.transaction(f"change {self.cell.name}"):
                self.cell.rebind((value,), _same)


class ParameterValues(Mapping[str, float]):
    """The present values of parameters by name: those of cells, or constants.

    Args:
        constants: the values of all parameters.
        cells: of the parameters that may change; they take precedence.
    """

    __slots__ = ("_cells", "_constants")

    def __init__(self, constants: Mapping[str, float], cells: Mapping[str, Cell[float]]) -> None:
        self._constants = constants
        self._cells = cells

    def __getitem__(self, name: str) -> float:
        cell = self._cells.get(name)
        return self._constants[name] if cell is None else cell.value

    def __iter__(self) -> Iterator[str]:
        return iter(self._constants)

    def __len__(self) -> int:
        return len(self._constants)


def _same(value: float) -> float:
    return value
