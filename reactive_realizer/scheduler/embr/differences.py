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
        self._after: dict[N, list[tuple[N, float]]] = {node: [] for node in floors}

    def __getitem__(self, node: N) -> float:
        """The least time (s) of a node."""
        return self._least[node]

    def add(self, *rows: Row[N]) -> float | None:
        """Add rows, all or none.

        Returns:
            None, or by how much (s) they miss being met together with the others.
        """
        raised: dict[N, float] = {}
        for number, row in enumerate(rows):
            self._after[row.earlier].append((row.later, row.distance))
            gap = self._raise(row, raised)
            if gap is not None:
                self._undo(rows[: number + 1], raised)
                return gap
        return None

    def _raise(self, row: Row[N], raised: dict[N, float]) -> float | None:
        numbers = count()
        waiting = [(self._least[row.later] - self._least[row.earlier] - row.distance, next(numbers), row.later)]
        done: set[N] = set()
        while waiting:
            room, _, node = heappop(waiting)
            if room >= -TOLERANCE:
                return None
            if node in self._fixed or node == row.earlier:
                return -room
            if node not in done:
                done.add(node)
                raised.setdefault(node, self._least[node])
                self._least[node] -= room
                for later, distance in self._after[node]:
                    heappush(waiting, (self._least[later] - self._least[node] - distance, next(numbers), later))
        return None

    def _undo(self, rows: Iterable[Row[N]], raised: Mapping[N, float]) -> None:
        for row in rows:
            self._after[row.earlier].remove((row.later, row.distance))
        self._least.update(raised)
