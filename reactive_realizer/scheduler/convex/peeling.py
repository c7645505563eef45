"""A group of roots: what hangs loose takes the duration it likes, the rest is a convex problem."""

from collections import defaultdict
from collections.abc import Mapping, Sequence

from reactive_realizer.scheduler.convex.circles import solve_circles
from reactive_realizer.scheduler.convex.longest_path import TOLERANCE, Arc, longest_path
from reactive_realizer.scheduler.convex.model import START
from reactive_realizer.scheduler.convex.newton import least_cost
from reactive_realizer.scheduler.convex.span import Bound, Span

_CLOSES = 1e-12
"""Ways of this difference (s) lead to the same time."""

_SHARES = (0.3, 0.03, 0.003, 0.0)
"""Of the preferred durations: where the search begins."""


def solve_group(spans: Sequence[Span], bounds: Sequence[Bound]) -> dict[int, float]:
    """Times of the variables of a group; the spans get their durations."""
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


def _peel(spans: Sequence[Span], bounds: Sequence[Bound]) -> tuple[list[Span], list[tuple[int, Span]]]:
    """Spans that something pulls at, and the loose ones, each with its loose end, in the order of taking them off."""
    held = {variable for bound in bounds for variable in (bound.later, bound.earlier)} | {START}
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
            continue  # one that takes over its stretch is not yet taken off
        loose[span] = end
        other = span.tail if end == span.head else span.head
        del at[end][span], at[other][span]
        waiting.append(other)
        if span.guide is not None:
            followers[span.guide] -= 1
            waiting += (span.guide.tail, span.guide.head)
    return [span for span in spans if span not in loose], [(end, span) for span, end in loose.items()]


def _solve_core(spans: Sequence[Span], bounds: Sequence[Bound]) -> dict[int, float]:
    times = _as_preferred(spans, bounds) or solve_circles(spans, bounds)
    if times is None:
        variables = _variables(spans, bounds)
        numbers = {variable: number for number, variable in enumerate(variables)}
        floors, inside = _inside(spans, bounds, numbers)
        found = least_cost(spans, bounds, numbers, floors, inside)
        times = dict(zip(variables, found, strict=True))
    return times


def _inside(
    spans: Sequence[Span], bounds: Sequence[Bound], numbers: Mapping[int, int]
) -> tuple[list[float], list[float]]:
    """Shortest durations, as far from 0 as is possible together, and times that have them."""
    rows = [Arc(numbers[b.earlier], numbers[b.later], b.distance, None) for b in bounds]
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


def _variables(spans: Sequence[Span], bounds: Sequence[Bound]) -> list[int]:
    ends = {variable for span in spans for variable in (span.tail, span.head)}
    return sorted(ends | {variable for bound in bounds for variable in (bound.later, bound.earlier)})


def _as_preferred(spans: Sequence[Span], bounds: Sequence[Bound]) -> dict[int, float] | None:
    """Every span as long as it likes to be, if that can be: what is by far the most common case."""
    at: defaultdict[int, list[Span]] = defaultdict(list)
    for span in spans:
        at[span.tail].append(span)
        at[span.head].append(span)
    times: dict[int, float] = {}
    for variable in _variables(spans, bounds):
        if variable not in times and not _spread(variable, at, times):
            return None
    met = all(times[b.later] - times[b.earlier] >= b.distance - TOLERANCE for b in bounds)
    return times if met else None


def _spread(first: int, at: Mapping[int, Sequence[Span]], times: dict[int, float]) -> bool:
    """From one variable on, in preferred steps; whether different ways lead to the same times."""
    times[first] = 0.0
    waiting = [first]
    while waiting:
        variable = waiting.pop()
        for span in at.get(variable, ()):
            step = span.goal - span.shift
            other, time = (
                (span.head, times[variable] + step) if variable == span.tail else (span.tail, times[variable] - step)
            )
            if other not in times:
                times[other] = time
                waiting.append(other)
            elif abs(times[other] - time) > _CLOSES:
                return False
    return True
