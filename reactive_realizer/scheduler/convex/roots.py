"""Points at fixed distances from each other (thesis 7.8, 7.11 and rigid phases): a weighted union-find with reasons."""

from collections import deque
from math import inf

from reactive_realizer.scheduler.convex.causes import Cause, Clash

TIE_TOLERANCE = 1e-6
"""Ties that differ by less (s) say the same."""


class Roots:
    """Classes of nodes. A node is a number; the lowest one of a class is its root.

    Args:
        fixed: how many nodes there are from the beginning whose times come from outside: no two share a class.
    """

    def __init__(self, fixed: int) -> None:
        self._fixed = fixed
        self._parents = list(range(fixed))
        self._distances = [0.0] * fixed
        self._links: dict[int, list[tuple[int, Cause]]] = {}

    def __len__(self) -> int:
        return len(self._parents)

    def add(self) -> int:
        """A new node, in a class of its own."""
        self._parents.append(len(self._parents))
        self._distances.append(0.0)
        return len(self._parents) - 1

    def find(self, node: int) -> tuple[int, float]:
        """The root of a node, and how much later (s) than that the node is."""
        parent = self._parents[node]
        if self._parents[parent] == parent:  # as almost always
            return parent, self._distances[node]
        path = []
        while self._parents[node] != node:
            path.append(node)
            node = self._parents[node]
        distance = 0.0
        for below in reversed(path):
            distance += self._distances[below]
            self._parents[below], self._distances[below] = node, distance
        return node, distance

    def link(self, left: int, right: int, distance: float, cause: Cause) -> Clash | None:
        """Make ``left = right + distance``; what speaks against it, if something does, and then nothing changes."""
        (one, d_one), (two, d_two) = self.find(left), self.find(right)
        gap = d_two + distance - d_one
        if one == two:
            return None if abs(gap) <= TIE_TOLERANCE else Clash(self.way(left, right) | {cause}, abs(gap))
        if max(one, two) < self._fixed:
            return Clash(self.way(left, right) | {cause}, inf)
        self._links.setdefault(left, []).append((right, cause))
        self._links.setdefault(right, []).append((left, cause))
        child, root, step = (one, two, gap) if two < one else (two, one, -gap)
        self._parents[child], self._distances[child] = root, step
        return None

    @property
    def links(self) -> list[tuple[int, int, Cause]]:
        """The nodes that were linked to each other and why; no more than are needed to hold each class together."""
        return [(node, other, cause) for node, others in self._links.items() for other, cause in others if node < other]

    def neighbors(self, node: int) -> list[int]:
        """Those that it was linked to, in order of linking."""
        return [other for other, _ in self._links.get(node, ())]

    def way(self, one: int, other: int) -> frozenset[Cause]:
        """What ties two nodes to each other, or, where nothing does, each to its root."""
        root, another = self.find(one)[0], self.find(other)[0]
        if root == another:
            return self._path(one, other)
        return self._path(one, root) | self._path(other, another)

    def _path(self, one: int, other: int) -> frozenset[Cause]:
        came: dict[int, tuple[int, Cause] | None] = {one: None}
        todo = deque([one])
        while todo and other not in came:
            node = todo.popleft()
            for neighbor, cause in self._links.get(node, ()):
                if neighbor not in came:
                    came[neighbor] = (node, cause)
                    todo.append(neighbor)
        causes = set()
        while (step := came.get(other)) is not None:
            other, cause = step
            causes.add(cause)
        return frozenset(causes)
