"""Systems of inequalities between two times each, and their earliest solution."""

from collections.abc import Hashable, Iterable, Mapping
from heapq import heappop, heappush
from itertools import count
from typing import Generic, NamedTuple, TypeVar

TOLERANCE = 5e-7
"""s; a row that is missed by less is met, because a solver computes durations."""

N = TypeVar("N", bound=Hashable)


class Row(NamedTuple, Generic[N]):
    """``later >= earlier + distance`` (s)."""

    later: N
    earlier: N
    distance: float


class Unmet(NamedTuple, Generic[N]):
    """Rows that cannot be met together, and by how much (s) they miss that."""

    rows: tuple[Row[N], ...]
    gap: float


class Differences(Generic[N]):
    """Rows that can be met together, and the least times that meet them.

    A row that is added raises the nodes that depend on it, most first, each once; if it would have to raise its own
    earlier side, or a fixed node, it cannot be met together with the others (Cotton and Maler, Fast and flexible
    difference constraint propagation for DPLL(T), 2006).

    Args:
        floors: the earliest time (s) of each node.
        fixed: nodes that stay at that time.
    """

    def __init__(self, floors: Mapping[N, float], fixed: Iterable[N]) -> None:
        self._least = dict(floors)
        self._fixed = frozenset(fixed)
        self._after: dict[N, list[Row[N]]] = {node: [] for node in floors}
        self._raised_by: dict[N, Row[N]] = {}

    def __getitem__(self, node: N) -> float:
        """The least time (s) of a node."""
        return self._least[node]

    def add(self, *rows: Row[N]) -> Unmet[N] | None:
        """Add rows, all or none.

        Returns:
            None, or rows that cannot be met together, if these cannot with the others.
        """
        before: dict[N, tuple[float, Row[N] | None]] = {}
        for number, row in enumerate(rows):
            self._after[row.earlier].append(row)
            unmet = self._raise(row, before)
            if unmet is not None:
                self._undo(rows[: number + 1], before)
                return unmet
        return None

    def _raise(self, row: Row[N], before: dict[N, tuple[float, Row[N] | None]]) -> Unmet[N] | None:
        """Raise nodes until a row is met; ``before`` takes their times and the rows that raised them."""
        numbers = count()
        waiting = [(self._room(row), next(numbers), row)]
        done: set[N] = set()
        while waiting:
            room, _, by = heappop(waiting)
            node = by.later
            if room >= -TOLERANCE:
                return None
            if node in self._fixed or node == row.earlier:
                return Unmet(self._cause(by), -room)
            if node not in done:
                done.add(node)
                before.setdefault(node, (self._least[node], self._raised_by.get(node)))
                self._least[node] -= room
                self._raised_by[node] = by
                for each in self._after[node]:
                    heappush(waiting, (self._room(each), next(numbers), each))
        return None

    def _undo(self, rows: Iterable[Row[N]], before: Mapping[N, tuple[float, Row[N] | None]]) -> None:
        for row in rows:
            self._after[row.earlier].remove(row)
        for node, (time, by) in before.items():
            self._least[node] = time
            if by is None:
                del self._raised_by[node]
            else:
                self._raised_by[node] = by

    def _room(self, row: Row[N]) -> float:
        """The time (s) by which a row is met."""
        return self._least[row.later] - self._least[row.earlier] - row.distance

    def _cause(self, last: Row[N]) -> tuple[Row[N], ...]:
        """The rows that raise the later side of one, back to that side, to a node that none raises, or in a circle."""
        rows, row = dict[Row[N], None](), last
        while row not in rows:
            rows[row] = None
            before = self._raised_by.get(row.earlier)
            if before is None or row.earlier == last.later:
                break
            row = before
        return tuple(rows)
