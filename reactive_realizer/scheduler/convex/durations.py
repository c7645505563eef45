"""The durations of least cost, for each group of variables that depend on each other."""

from collections import defaultdict
from collections.abc import Iterator, Sequence

from reactive_realizer.scheduler.convex.circles import solve_circles
from reactive_realizer.scheduler.convex.least_cost import least_cost
from reactive_realizer.scheduler.convex.model import START, BoundArc, Model
from reactive_realizer.scheduler.convex.spans import Span
from reactive_realizer.scheduler.offset_union_find import OffsetUnionFind


def least_cost_times(model: Model, clusters: Sequence[int], bounds: Sequence[BoundArc]) -> list[float]:
    """A time (s) for every variable, with durations of least cost under some of the bounds of a model.

    Of each group of clusters that depend on each other, without the block's start, the first variable is at 0; the
    spans get their durations.

    Args:
        model: with the spans.
        clusters: of the variables, which the spans connect.
        bounds: to be met.
    """
    spans = [span for span in model.spans if span.costs and span.tail != span.head]
    groups = OffsetUnionFind[int]()
    for one, other in _dependent(spans, bounds):
        groups.union(clusters[one], clusters[other])
    parts: defaultdict[int, tuple[list[Span], list[BoundArc]]] = defaultdict(lambda: ([], []))
    for span in spans:
        parts[groups.find(clusters[span.head or span.tail])[0]][0].append(span)
    for bound in bounds:
        parts[groups.find(clusters[bound.head or bound.tail])[0]][1].append(bound)
    times = [0.0] * model.size
    for own, active in parts.values():
        for variable, time in _solve(own, active).items():
            times[variable] = time
    return times


def _dependent(spans: Sequence[Span], bounds: Sequence[BoundArc]) -> Iterator[tuple[int, int]]:
    """The variables that depend on each other by bounds, except on the known start of the block, or by stretches."""
    for bound in bounds:
        if bound.tail and bound.head:
            yield bound.tail, bound.head
    for span in spans:
        if span.guide is not None:
            yield span.head or span.tail, span.guide.head or span.guide.tail


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
    return least_cost(spans, bounds) if times is None else times
