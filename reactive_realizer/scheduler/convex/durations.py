"""The durations of phases, for each group of roots that have to agree on them."""

from collections import defaultdict
from collections.abc import Sequence

from reactive_realizer.scheduler.convex.longest_path import components
from reactive_realizer.scheduler.convex.model import START, Model
from reactive_realizer.scheduler.convex.peeling import solve_group
from reactive_realizer.scheduler.convex.span import Bound, Span


class Durations:
    """Durations that cost least, under some of the bounds.

    Bounds are lazy: the plan is first made without them, and only those found broken come in. A plan of the relaxed
    problem that meets all bounds is the plan, so that it does not depend on which came in. A group in which nothing
    changed since the last time is not solved again.
    """

    def __init__(self, model: Model) -> None:
        self._size = model.size
        self._spans = [span for span in model.spans if not span.closed and span.costs]
        self._solved: dict[tuple[int, int, int], dict[int, float]] = {}

    def times(self, bounds: Sequence[Bound]) -> list[float]:
        """A time for every variable; those of different groups have nothing to do with each other."""
        group = components(self._size, self._pairs(bounds))
        spans: defaultdict[int, list[Span]] = defaultdict(list)
        for span in self._spans:
            spans[group[span.head or span.tail]].append(span)
        rows: defaultdict[int, list[Bound]] = defaultdict(list)
        for bound in bounds:
            rows[group[bound.later or bound.earlier]].append(bound)
        times = [0.0] * self._size
        for first in sorted(spans.keys() | rows.keys()):
            for variable, time in self._group(first, spans[first], rows[first]).items():
                times[variable] = time
        return times

    def _pairs(self, bounds: Sequence[Bound]) -> list[tuple[int, int]]:
        """What has to agree: not by way of the block's start, which does not move, but by way of a common stretch."""
        pairs = [(span.tail, span.head) for span in self._spans]
        pairs += [(bound.earlier, bound.later) for bound in bounds]
        pairs = [pair for pair in pairs if START not in pair]
        guided = [(span, span.guide) for span in self._spans if span.guide is not None]
        return pairs + [(span.head or span.tail, guide.head or guide.tail) for span, guide in guided]

    def _group(self, first: int, spans: Sequence[Span], bounds: Sequence[Bound]) -> dict[int, float]:
        key = (first, len(spans), len(bounds))  # groups only grow, and bounds only come in
        if key not in self._solved:
            self._solved[key] = solve_group(spans, bounds)
        return self._solved[key]
