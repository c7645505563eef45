"""What a plan has to keep to, and sets of such requirements that exclude each other."""

from dataclasses import dataclass
from enum import IntEnum
from math import inf
from typing import NamedTuple


class Rank(IntEnum):
    """What of a conflict is given up first (docs/semantics.md, scheduling)."""

    LENGTH = 0
    """That a phase which likes to last lasts at all: thesis 7.15 does not ask for it."""
    LIMIT = 1
    ORDER = 2
    TIE = 3
    BEHAVIOR = 4
    GIVEN = 5
    """The start of the block, and times from outside: never given up."""


class Requirement(NamedTuple):
    """Something that a plan has to keep to.

    Attributes:
        number: its place among the sorted things of its kind; of a length or limit, that of its behavior.
        phase: of a length or limit.
    """

    rank: Rank
    number: int = 0
    phase: int = 0


GIVEN = Requirement(Rank.GIVEN)


@dataclass(frozen=True, slots=True)
class Conflict:
    """Things that cannot be kept together.

    Attributes:
        gap: how much is missing, s; infinite where two times from outside were to be one.
        late: whether what conflicts is a behavior that would have ended before its block starts.
    """

    requirements: frozenset[Requirement]
    gap: float
    late: bool = False

    @property
    def outer(self) -> bool:
        """Whether it ties two times that both come from elsewhere."""
        return self.gap == inf
