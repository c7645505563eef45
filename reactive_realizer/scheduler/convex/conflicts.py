"""The requirements of a plan, and how a conflict between them is found and explained."""

from collections import deque
from dataclasses import dataclass, replace
from enum import IntEnum
from math import inf
from typing import NamedTuple

from reactive_realizer.scheduler.offset_union_find import TIE_TOLERANCE, OffsetUnionFind
from reactive_realizer.scheduler.problem import LEAST


class Rank(IntEnum):
    """The order in which requirements are given up (docs/semantics.md, scheduling)."""

    LENGTH = 0
    """A phase with a preferred duration lasts at all: thesis 7.15 does not require it."""
    LIMIT = 1
    ORDER = 2
    TIE = 3
    BEHAVIOR = 4
    GIVEN = 5
    """The start of the block, and times from outside: never given up."""


class Requirement(NamedTuple):
    """Something that a plan has to satisfy.

    Attributes:
        number: index among the constraints or behaviors in canonical order; for a length or limit, of its behavior.
        phase: index of the phase of a length or limit; of the limit of a whole behavior, their number.
    """

    rank: Rank
    number: int = 0
    phase: int = 0


GIVEN = Requirement(Rank.GIVEN)


class Need(NamedTuple):
    """The shortest duration (s) of phases of a behavior, from the first one to the last one of these."""

    behavior: int
    first: int
    last: int
    duration: float


@dataclass(frozen=True, slots=True)
class Conflict:
    """Requirements that cannot be satisfied together.

    Attributes:
        gap: the contradiction, s; infinite where two times from outside are tied.
        needs: the phases whose shortest durations take part.
    """

    requirements: frozenset[Requirement]
    gap: float
    needs: tuple[Need, ...] = ()

    @property
    def outer(self) -> bool:
        """Whether two times from outside are tied."""
        return self.gap == inf

    @property
    def need(self) -> float:
        """The sum of the shortest durations that take part, s."""
        return sum(each.duration for each in self.needs)

    @property
    def out_of_order(self) -> "Conflict":
        """The conflict that remains if phases may be as short as they like; itself if none does."""
        gap = self.gap - self.need
        return replace(self, gap=gap + LEAST * len(self.needs), needs=()) if gap > TIE_TOLERANCE else self


class ExplainedGroups(OffsetUnionFind[int]):
    """Numbered nodes at fixed offsets from each other, with the requirements that hold them there.

    (Thesis 7.8, 7.11 and rigid phases.)
    """

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
        """Make ``left = right + offset``; a conflict if that contradicts earlier requirements."""
        gap = self.union(left, right, offset)
        if gap is None:
            self._links.setdefault(left, []).append((right, requirement))
            self._links.setdefault(right, []).append((left, requirement))
        elif abs(gap) > TIE_TOLERANCE:
            return Conflict(self.between(left, right) | {requirement}, abs(gap))
        return None

    def between(self, one: int, other: int) -> frozenset[Requirement]:
        """The requirements that tie two nodes to each other, or, if none do, each of them to its root."""
        root, another = self.find(one)[0], self.find(other)[0]
        if root == another:
            return self._path(one, other)
        return self._path(one, root) | self._path(other, another)

    def _path(self, one: int, other: int) -> frozenset[Requirement]:
        came: dict[int, tuple[int, Requirement] | None] = {one: None}
        waiting = deque([one])
        while waiting and other not in came:
            node = waiting.popleft()
            for neighbor, requirement in self._links.get(node, ()):
                if neighbor not in came:
                    came[neighbor] = (node, requirement)
                    waiting.append(neighbor)
        requirements = set()
        while (step := came.get(other)) is not None:
            other, requirement = step
            requirements.add(requirement)
        return frozenset(requirements)
