"""The phases of a behavior as spans between its knots: the points that constraints name, and its first."""

from collections.abc import Callable, Mapping
from collections.abc import Set as AbstractSet
from dataclasses import dataclass
from itertools import pairwise
from math import inf

from reactive_realizer.planunit.timing import PhaseKind, Timing
from reactive_realizer.scheduler.convex.conflicts import Need, Rank, Requirement
from reactive_realizer.scheduler.problem import LEAST


@dataclass(slots=True, eq=False)
class Span:
    """One phase of a behavior, or several elastic ones that stretch alike.

    Attributes:
        behavior: index of its behavior.
        phases: their indices.
        kind: ELASTIC, HOLD or FREE.
        preferred: duration, s.
        start: node at which it begins.
        end: node at which it ends.
        rigid: duration (s) of the rigid phases that also lie between start and end.
        minimum: the shortest duration or, if that is longer, the authored limit, s; a behavior without preferences
            takes time (thesis 7.14).
        maximum: authored limit, s.
        shortest: the sum of the shortest durations of its phases, s.
        guide: the span whose stretch it takes over; None if it has its own.
        tail: variable of the start.
        head: variable of the end.
        shift: ``duration = x[head] - x[tail] + shift``, s.
        goal: the duration of least cost, s: the preferred one, or that at the stretch of a settled guide.
        duration: in the plan, s.
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
    shortest: float = 0.0
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
        """Whether it has a preferred duration; only such spans connect behaviors."""
        return self.kind is not PhaseKind.FREE

    @property
    def least(self) -> float:
        """Its least duration without authored limits, s."""
        return max(self.shortest, LEAST if self.elastic else 0.0)

    @property
    def requirement(self) -> Requirement:
        """Its behavior."""
        return Requirement(Rank.BEHAVIOR, self.behavior)

    @property
    def length_requirement(self) -> Requirement:
        """The requirement that its duration is not 0."""
        return Requirement(Rank.LENGTH, self.behavior, self.phases[0])

    @property
    def need(self) -> Need:
        """Its shortest duration."""
        return Need(self.behavior, self.phases[0], self.phases[-1], self.shortest)

    @property
    def closed(self) -> bool:
        """Whether its duration follows from ties alone."""
        return self.tail == self.head

    @property
    def ratio(self) -> float:
        """Its stretch: its duration relative to the preferred one."""
        return self.duration / self.preferred if self.preferred else 1.0


class BehaviorSpans:
    """The spans of one behavior.

    Elastic phases between two knots are one span, so that they stretch alike; points that coincide stay together,
    unless constraints name both. Outside the first and the last point tied by an `at`, elastic spans take over the
    stretch of the nearest one between these.

    Args:
        index: of the behavior.
        knots: node of each knot, by index of the point.
        named: indices of the points that constraints name.
        tied: those of them that `at` constraints name.
        dropped: requirements that were given up; of these, lengths and limits matter.
        node: makes a node.

    Attributes:
        spans: in order.
        rigid: pairs of knots with nothing but rigid phases between them: earlier, later, distance (s).
        tempo: the span whose stretch the phases behind the last knot take over; None if they have their own.
    """

    def __init__(
        self,
        index: int,
        timing: Timing,
        knots: Mapping[int, int],
        named: AbstractSet[int],
        tied: AbstractSet[int],
        dropped: AbstractSet[Requirement],
        node: Callable[[], int],
    ) -> None:
        self._index = index
        self._phases = timing.phases
        self._knots = knots
        self._named = named
        self._dropped = dropped
        self._takes_time = timing.free and not timing.instant and Requirement(Rank.LIMIT, index, 0) not in dropped
        self._limited = {k for k in timing.limited if Requirement(Rank.LIMIT, index, k) not in dropped}
        self._node = node
        self.spans: list[Span] = []
        self.rigid: list[tuple[int, int, float]] = []
        self.tempo: Span | None = None
        for before, after in pairwise(knots):
            self._connect(before, after)
        if len(tied) > 1:
            self._follow(min(tied), max(tied))

    def limited(self, phase: int) -> bool:
        """Whether the authored limits of a phase apply."""
        return phase in self._limited

    def _connect(self, before: int, after: int) -> None:
        """Add the spans from knot to knot, one behind the other."""
        rigid, groups = self._groups(before, after)
        if not groups:
            self.rigid.append((self._knots[before], self._knots[after], rigid))
        start = self._knots[before]
        for group in groups:
            end = self._knots[after] if group is groups[-1] else self._node()
            self.spans.append(self._span(group, start, end, rigid))
            start, rigid = end, 0.0

    def _groups(self, before: int, after: int) -> tuple[float, list[list[int]]]:
        """The duration (s) of the rigid phases between two knots, and the phases of each span."""
        rigid = 0.0
        lump: list[int] = []
        merged: list[int] = []
        others: list[list[int]] = []
        for k in range(before, after):
            phase = self._phases[k]
            if phase.kind is PhaseKind.RIGID:
                rigid += phase.duration
            elif phase.kind is PhaseKind.ELASTIC and k not in self._limited:
                (lump if phase.duration > 0 else merged).append(k)
            else:
                others.append([k])
        groups = [lump, *others] if lump else others
        if not groups and merged and before in self._named:
            groups = [merged[-1:]]  # may be forced apart
        return rigid, groups

    def _span(self, group: list[int], start: int, end: int, rigid: float) -> Span:
        first = group[0]
        phase = self._phases[first]
        preferred = sum(self._phases[k].duration for k in group)
        kind = phase.kind
        if kind is PhaseKind.ELASTIC and (
            preferred == 0 or (Requirement(Rank.LENGTH, self._index, first) in self._dropped)
        ):
            kind = PhaseKind.HOLD  # its duration may become 0
        low, high = (phase.minimum, phase.maximum) if first in self._limited else (0.0, inf)
        shortest = sum(self._phases[k].shortest for k in group)
        low = max(low, shortest, LEAST if self._takes_time and first == 0 else 0.0)
        return Span(self._index, tuple(group), kind, preferred, start, end, rigid, low, high, shortest, goal=preferred)

    def _follow(self, first: int, last: int) -> None:
        elastic = [span for span in self.spans if span.elastic]
        inside = [span for span in elastic if first <= span.phases[0] < last]
        if not inside:
            return
        self.tempo = inside[-1]
        for span in elastic:
            if span.phases[0] < first:
                span.guide = inside[0]
            elif span.phases[0] >= last:
                span.guide = inside[-1]
