"""The durations of least cost, for each group of variables that depend on each other."""

from collections import defaultdict
from collections.abc import Mapping, Sequence

from reactive_realizer.scheduler.convex.circles import solve_circles
from reactive_realizer.scheduler.convex.least_cost import least_cost
from reactive_realizer.scheduler.convex.longest_path import Arc, components, longest_path
from reactive_realizer.scheduler.convex.model import START, BoundArc, Model
from reactive_realizer.scheduler.convex.spans import Span

_SHARES = (0.3, 0.03, 0.003, 0.0)
"""Shares of the preferred durations, as shortest durations for the first step."""


class Durations:
    """Durations of least cost, under some of the bounds.

    Bounds are lazy: the plan is first made without them, and only those that it breaks are added. A plan of least cost
    under some bounds that meets all of them is the plan, so it does not depend on which were added. A group in which
    nothing has changed is not solved again.
    """

    def __init__(self, model: Model) -> None:
        self._size = model.size
        self._spans = [span for span in model.spans if span.costs and span.tail != span.head]
        self._solved: dict[tuple[int, int, int], dict[int, float]] = {}

    def times(self, bounds: Sequence[BoundArc]) -> list[float]:
        """A time for every variable; the first one of each group without the start is at 0."""
        group = components(self._size, self._pairs(bounds))
        spans: defaultdict[int, list[Span]] = defaultdict(list)
        for span in self._spans:
            spans[group[span.head or span.tail]].append(span)
        active: defaultdict[int, list[BoundArc]] = defaultdict(list)
        for bound in bounds:
            active[group[bound.head or bound.tail]].append(bound)
        times = [0.0] * self._size
        for first in sorted(spans.keys() | active.keys()):
            for variable, time in self._group(first, spans[first], active[first]).items():
                times[variable] = time
        return times

    def _pairs(self, bounds: Sequence[BoundArc]) -> list[tuple[int, int]]:
        """The variables that depend on each other: not by the block's start, which is known; also by a stretch."""
        pairs = [(span.tail, span.head) for span in self._spans if span.tail and span.head]
        pairs += [(bound.tail, bound.head) for bound in bounds if bound.tail and bound.head]
        guided = [(span, span.guide) for span in self._spans if span.guide is not None]
        return pairs + [(span.head or span.tail, guide.head or guide.tail) for span, guide in guided]

    def _group(self, first: int, spans: Sequence[Span], bounds: Sequence[BoundArc]) -> dict[int, float]:
        key = (first, len(spans), len(bounds))  # groups only grow, and bounds are only added
        if key not in self._solved:
            self._solved[key] = _solve(spans, bounds)
        return self._solved[key]


def _solve(spans: Sequence[Span], bounds: Sequence[BoundArc]) -> dict[int, float]:
    """Times of the variables of a group; the spans get their durations.

    Loose spans get the durations that they prefer; the others are a convex problem.
    """
    core, loose = _peel(spans, bounds)
    times = _solve_core(core, bounds) if core or bounds else {}
    for span in core:
        span.duration = times[span.head] - times[span.tail] + span.shift
    for end, span in reversed(loose):
        span.duration = span.goal if span.guide is None else span.preferred * span.guide.ratio
        step = span.duration - span.shift
        if end == span.head:
            times[end] = times.setdefault(span.tail, 0.0) + step
        else:
            times[end] = times.setdefault(span.head, 0.0) - step
    return times


def _peel(spans: Sequence[Span], bounds: Sequence[BoundArc]) -> tuple[list[Span], list[tuple[int, Span]]]:
    """The spans whose durations others determine, and the loose ones with their loose ends, in the order of removal."""
    held = {variable for bound in bounds for variable in (bound.head, bound.tail)} | {START}
    at: defaultdict[int, dict[Span, None]] = defaultdict(dict)
    followers: defaultdict[Span | None, int] = defaultdict(int)
    for span in spans:
        at[span.tail][span] = at[span.head][span] = None
        followers[span.guide] += 1
    loose: dict[Span, int] = {}
    waiting = sorted(at, reverse=True)
    while waiting:
        end = waiting.pop()
        if end in held or len(at[end]) != 1:
            continue
        (span,) = at[end]
        if followers[span]:
            continue  # one that takes over its stretch is not removed yet
        loose[span] = end
        other = span.tail if end == span.head else span.head
        del at[end][span], at[other][span]
        waiting.append(other)
        if span.guide is not None:
            followers[span.guide] -= 1
            waiting += (span.guide.tail, span.guide.head)
    return [span for span in spans if span not in loose], [(end, span) for span, end in loose.items()]


def _solve_core(spans: Sequence[Span], bounds: Sequence[BoundArc]) -> dict[int, float]:
    times = solve_circles(spans, bounds)
    if times is None:
        ends = {variable for span in spans for variable in (span.tail, span.head)}
        variables = sorted(ends | {variable for bound in bounds for variable in (bound.head, bound.tail)})
        numbers = {variable: number for number, variable in enumerate(variables)}
        floors, inside = _inside(spans, bounds, numbers)
        times = dict(zip(variables, least_cost(spans, bounds, numbers, floors, inside), strict=True))
    return times


def _inside(
    spans: Sequence[Span], bounds: Sequence[BoundArc], numbers: Mapping[int, int]
) -> tuple[list[float], list[float]]:
    """Shortest durations, as far from 0 as is possible together, and times that have them."""
    rows = [Arc(numbers[b.tail], numbers[b.head], b.length, None) for b in bounds]
    floors: list[float] = []
    times: list[float] = []
    for share in _SHARES:
        floors = [max(span.least, share * span.goal) if span.elastic else 0.0 for span in spans]
        lengths = [floor - span.shift for span, floor in zip(spans, floors, strict=True)]
        arcs = [Arc(numbers[s.tail], numbers[s.head], n, None) for s, n in zip(spans, lengths, strict=True)]
        times, circle = longest_path(len(numbers), rows + arcs)
        if not circle:
            break
    return floors, times
