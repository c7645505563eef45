"""Points in time at fixed offsets from each other (thesis 7.39): a weighted union-find."""

from collections.abc import Hashable, Iterable
from math import inf
from typing import Generic, TypeVar

TIE_TOLERANCE = 1e-6
"""Offsets that differ by less (s) are equal."""

N = TypeVar("N", bound=Hashable)


class OffsetUnionFind(Generic[N]):
    """Groups of nodes at fixed offsets from each other; the root of a group is the node that was added first.

    Args:
        fixed: nodes whose times are given; no two of them share a group.
    """

    def __init__(self, fixed: Iterable[N] = ()) -> None:
        self._ranks: dict[N, int] = {}
        for node in fixed:
            self.add(node)
        self._fixed = len(self._ranks)
        self._parents: dict[N, tuple[N, float]] = {}  # with the offset from it

    def add(self, node: N) -> None:
        """Add a node in a group of its own, unless it is there."""
        self._ranks.setdefault(node, len(self._ranks))

    def find(self, node: N) -> tuple[N, float]:
        """The root of the group of a node, and the offset (s) of the node from the root."""
        parents = self._parents
        found = parents.get(node)
        if found is None:
            return node, 0.0
        if found[0] not in parents:  # as almost always
            return found
        path = []
        while node in parents:
            path.append(node)
            node = parents[node][0]
        offset = 0.0
        for below in reversed(path):
            offset += parents[below][1]
            parents[below] = node, offset
        return node, offset

    def union(self, left: N, right: N, offset: float = 0.0) -> float | None:
        """Make ``left = right + offset``.

        Returns:
            None if that joined two groups. Otherwise nothing changes, and it is the difference (s) between this offset
            and the one that is known; infinite if the two belong to different fixed nodes.
        """
        (one, to_left), (two, to_right) = self.find(left), self.find(right)
        gap = to_right + offset - to_left
        if one == two:
            return gap
        left_rank = self._ranks.setdefault(one, len(self._ranks))
        right_rank = self._ranks.setdefault(two, len(self._ranks))
        if max(left_rank, right_rank) < self._fixed:
            return inf
        child, root, step = (one, two, gap) if right_rank < left_rank else (two, one, -gap)
        self._parents[child] = root, step
        return None
