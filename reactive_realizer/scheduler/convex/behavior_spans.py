"""From the phases of one behavior to spans between its knots: the points that constraints name, and its first."""

from collections.abc import Callable, Mapping
from collections.abc import Set as AbstractSet
from itertools import pairwise
from math import inf

from reactive_realizer.planunit.timing import PhaseKind, Timing
from reactive_realizer.scheduler.convex.conflict import Rank, Requirement
from reactive_realizer.scheduler.convex.span import Span


class BehaviorSpans:
    """The spans of one behavior.

    Elastic phases between two knots are one span, so that they stretch alike; points that coincide stay merged, unless
    constraints name both. Outside of the first and the last point tied by an `at`, elastic spans take over the stretch
    of the nearest one inside.

    Args:
        index: of the behavior.
        knots: node of each knot, by index of the point.
        named: indices of the points that constraints name.
        tied: those of them that `at` constraints name.
        lifted: lengths and limits that were given up.
        node: makes a node.

    Attributes:
        spans: in order.
        rigid: pairs of knots with nothing but rigid phases between them: earlier, later, distance (s).
        tempo: the span whose stretch the phases behind the last knot take over, if one does.
    """

    def __init__(
        self,
        index: int,
        timing: Timing,
        knots: Mapping[int, int],
        named: AbstractSet[int],
        tied: AbstractSet[int],
        lifted: AbstractSet[Requirement],
        node: Callable[[], int],
    ) -> None:
        self._index = index
        self._phases = timing.phases
        self._knots = knots
        self._named = named
        self._lifted = lifted
        self._limited = {k for k in timing.limited if Requirement(Rank.LIMIT, index, k) not in lifted}
        self._node = node
        self.spans: list[Span] = []
        self.rigid: list[tuple[int, int, float]] = []
        self.tempo: Span | None = None
        for before, after in pairwise(knots):
            self._connect(before, after)
        if len(tied) > 1:
            self._follow(min(tied), max(tied))

    def limited(self, phase: int) -> bool:
        """Whether authored limits of a phase are to be kept."""
        return phase in self._limited

    def _connect(self, before: int, after: int) -> None:
        """Spans from knot to knot, one behind the other."""
        rigid, groups = self._groups(before, after)
        if not groups:
            self.rigid.append((self._knots[before], self._knots[after], rigid))
        start = self._knots[before]
        for group in groups:
            end = self._knots[after] if group is groups[-1] else self._node()
            self.spans.append(self._span(group, start, end, rigid))
            start, rigid = end, 0.0

    def _groups(self, before: int, after: int) -> tuple[float, list[list[int]]]:
        """How long (s) the phases last that cannot give; and those that can, elastic ones together."""
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
        phase = self._phases[group[0]]
        preferred = sum(self._phases[k].duration for k in group)
        kind = PhaseKind.HOLD if self._may_vanish(group[0], preferred) else phase.kind
        low, high = (phase.minimum, phase.maximum) if self.limited(group[0]) else (0.0, inf)
        return Span(self._index, tuple(group), kind, preferred, start, end, rigid, low, high, goal=preferred)

    def _may_vanish(self, phase: int, preferred: float) -> bool:
        short = preferred == 0 or Requirement(Rank.LENGTH, self._index, phase) in self._lifted
        return self._phases[phase].kind is PhaseKind.ELASTIC and short

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
