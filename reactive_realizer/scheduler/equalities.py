"""Points in time tied by `at` constraints (thesis 7.39): a weighted union-find."""

from collections.abc import Hashable
from typing import Generic, TypeVar

_TOLERANCE = 1e-6
_EVERYWHERE = float("inf")

N = TypeVar("N", bound=Hashable)


class Equalities(Generic[N]):
    """Classes of points at fixed distances from each other.

    Args:
        fixed: points whose time is given from outside; two of them never share a class.
    """

    def __init__(self, fixed: frozenset[N]) -> None:
        self._fixed = fixed
        self._link: dict[N, tuple[N, float]] = {}
        self._sizes: dict[N, int] = {}

    def find(self, node: N) -> tuple[N, float]:
        """The root of a point's class, and how much later (s) than the root the point is."""
        distance = 0.0
        while node in self._link:
            node, step = self._link[node]
            distance += step
        return node, distance

    def tie(self, left: N, right: N, offset: float) -> float | None:
        """Make ``left = right + offset``.

        Returns:
            None, or by how much (s) that contradicts what was tied before; then nothing changes. Infinite where both
            hang on different points of the outside.
        """
        left_root, left_distance = self.find(left)
        right_root, right_distance = self.find(right)
        gap = right_distance + offset - left_distance
        if left_root == right_root:
            return None if abs(gap) <= _TOLERANCE else gap
        if left_root in self._fixed and right_root in self._fixed:
            return _EVERYWHERE
        if left_root in self._fixed:
            self._join(right_root, left_root, -gap)
        else:
            self._join(left_root, right_root, gap)
        return None

    def tied(self, node: N) -> bool:
        """Whether a point shares its class with another."""
        return self._sizes.get(self.find(node)[0], 1) > 1

    def _join(self, child: N, root: N, distance: float) -> None:
        self._link[child] = (root, distance)
        self._sizes[root] = self._sizes.get(root, 1) + self._sizes.pop(child, 1)
