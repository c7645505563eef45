"""Spans, which have a cost, and rows, which have none but hold."""

from dataclasses import dataclass
from math import inf
from typing import NamedTuple

from reactive_realizer.planunit.timing import PhaseKind
from reactive_realizer.scheduler.convex.conflict import Rank, Requirement
from reactive_realizer.scheduler.problem import LEAST


@dataclass(slots=True, eq=False)
class Span:
    """One phase of a behavior, or several elastic ones that stretch alike; rigid ones beside it add only length.

    Attributes:
        behavior: index of its behavior.
        phases: their indices.
        kind: ELASTIC, HOLD or FREE.
        preferred: s.
        start: node; the span begins there.
        end: node.
        rigid: how much (s) of the way from start to end is not the span's own.
        minimum: s.
        maximum: s.
        guide: the span whose stretch it takes over; None for one that has its own.
        tail: variable of the start.
        head: variable of the end.
        shift: ``duration = x[head] - x[tail] + shift``.
        goal: how long it would like to be, s; the preferred duration, or that at the tempo of a settled guide.
        duration: what it gets, s.
    """

    behavior: int
    phases: tuple[int, ...]
    kind: PhaseKind
    preferred: float
    start: int
    end: int
    rigid: float = 0.0
    minimum: float = 0.0
    maximum: float = inf
    guide: "Span | None" = None
    tail: int = 0
    head: int = 0
    shift: float = 0.0
    goal: float = 0.0
    duration: float = 0.0

    @property
    def elastic(self) -> bool:
        """Whether it stretches at a cost, and never to nothing."""
        return self.kind is PhaseKind.ELASTIC

    @property
    def costs(self) -> bool:
        """Whether it has a preference; what has none ties nothing together."""
        return self.kind is not PhaseKind.FREE

    @property
    def least(self) -> float:
        """The shortest it may be without its authored limits, s."""
        return LEAST if self.elastic else 0.0

    @property
    def requirement(self) -> Requirement:
        """Its behavior, as one that wants something."""
        return Requirement(Rank.BEHAVIOR, self.behavior)

    @property
    def length_requirement(self) -> Requirement:
        """That it lasts at all."""
        return Requirement(Rank.LENGTH, self.behavior, self.phases[0])

    @property
    def closed(self) -> bool:
        """Whether its duration follows from ties alone."""
        return self.tail == self.head

    @property
    def ratio(self) -> float:
        """How much longer than preferred it is."""
        return self.duration / self.preferred if self.preferred else 1.0


class Row(NamedTuple):
    """``later >= earlier + distance``, between nodes."""

    later: int
    earlier: int
    distance: float
    requirement: Requirement


class Bound(NamedTuple):
    """A row between variables: ``x[later] >= x[earlier] + distance``."""

    later: int
    earlier: int
    distance: float
    row: Row
