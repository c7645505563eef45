"""Points at fixed offsets from each other, with what holds them there (thesis 7.8, 7.11 and rigid phases)."""

from collections import deque

from reactive_realizer.scheduler.convex.conflict import Conflict, Requirement
from reactive_realizer.scheduler.offset_union_find import TIE_TOLERANCE, OffsetUnionFind


class ExplainedGroups(OffsetUnionFind[int]):
    """Groups of numbered nodes that remember the requirements by which they were joined."""

    def __init__(self, fixed: int) -> None:
        super().__init__(range(fixed))
        self._size = fixed
        self._links: dict[int, list[tuple[int, Requirement]]] = {}

    def __len__(self) -> int:
        return self._size

    def add_node(self) -> int:
        """A new node, in a group of its own."""
        self.add(self._size)
        self._size += 1
        return self._size - 1

    def tie(self, left: int, right: int, offset: float, requirement: Requirement) -> Conflict | None:
        """Make ``left = right + offset``; a conflict if that contradicts what was required before."""
        gap = self.union(left, right, offset)
        if gap is None:
            self._links.setdefault(left, []).append((right, requirement))
            self._links.setdefault(right, []).append((left, requirement))
        elif abs(gap) > TIE_TOLERANCE:
            return Conflict(self.between(left, right) | {requirement}, abs(gap))
        return None

    def between(self, one: int, other: int) -> frozenset[Requirement]:
        """What ties two nodes to each other, or, where nothing does, each to its root."""
        root, another = self.find(one)[0], self.find(other)[0]
        if root == another:
            return self._path(one, other)
        return self._path(one, root) | self._path(other, another)

    def _path(self, one: int, other: int) -> frozenset[Requirement]:
        came: dict[int, tuple[int, Requirement] | None] = {one: None}
        todo = deque([one])
        while todo and other not in came:
            node = todo.popleft()
            for neighbor, requirement in self._links.get(node, ()):
                if neighbor not in came:
                    came[neighbor] = (node, requirement)
                    todo.append(neighbor)
        requirements = set()
        while (step := came.get(other)) is not None:
            other, requirement = step
            requirements.add(requirement)
        return frozenset(requirements)
