"""The times of all points: durations first, then the earliest start of each cluster (thesis 7.24)."""

from collections.abc import Iterator, Sequence

from reactive_realizer.planunit.timing import SHORTEST, PhaseKind, stretched
from reactive_realizer.scheduler.convex.conflicts import Conflict, Rank, Requirement
from reactive_realizer.scheduler.convex.durations import least_cost_times
from reactive_realizer.scheduler.convex.longest_path import TOLERANCE, Arc, longest_path
from reactive_realizer.scheduler.convex.model import START, BoundArc, Inequality, Model
from reactive_realizer.scheduler.convex.spans import Span
from reactive_realizer.scheduler.offset_union_find import OffsetUnionFind
from reactive_realizer.scheduler.problem import Point


def find_times(model: Model) -> dict[Point, float] | list[Conflict]:
    """The times of all points (s after the block's start) that meet all bounds, or the conflicts if there are none.

    They are of least cost, and as early as that allows.
    """
    if found := model.conflicts or _conflicts(model):
        return found
    times = _earliest(model)
    for span in model.spans:
        span.duration = times[span.head] - times[span.tail] + span.shift
    points = {index: _points(model, times, index) for index in model.knots}
    unplayable = [conflict for index, each in points.items() for conflict in _unplayable(model, index, each)]
    items = model.relaxed.items.items()
    return unplayable or {
        point: time for index, item in items for point, time in zip(item.points, points[index], strict=True)
    }


# --- feasibility


def _conflicts(model: Model) -> list[Conflict]:
    """Circles of bounds and shortest durations that cannot be met, no two with one of these in common.

    There is a plan if and only if there is no such circle: the longest paths are one.
    """
    arcs: list[Arc[Inequality | Span]] = [*model.bounds]
    elastic = (span for span in model.spans if span.elastic and not span.shortest and not span.closed)
    arcs += [Arc(span.tail, span.head, span.least - span.shift, span) for span in elastic]
    found: list[Conflict] = []
    while circle := longest_path(model.size, arcs)[1]:
        found.append(_conflict(model, circle))
        arcs = [arc for arc in arcs if arc not in circle]
    return found


def _conflict(model: Model, circle: Sequence[Arc[Inequality | Span]]) -> Conflict:
    """Between the end of an arc in one node of a group and the start of the next in another, ties take part."""
    rows = [_shortest(arc.label) if isinstance(arc.label, Span) else arc.label for arc in circle]
    requirements = {row.requirement for row in rows}
    for row, following in zip(rows, [*rows[1:], rows[0]], strict=True):
        requirements |= model.groups.between(row.later, following.earlier)
    gap = sum(arc.length for arc in circle)
    spans = [arc.label for arc in circle if isinstance(arc.label, Span)]
    if gap <= sum(span.least for span in spans) + TOLERANCE:
        requirements |= {span.length_requirement for span in spans}
    needs = tuple(row.need for row in rows if row.need is not None)
    return Conflict(frozenset(requirements), gap, needs=needs)


def _shortest(span: Span) -> Inequality:
    return Inequality(span.end, span.start, span.least + span.rigid, span.requirement)


# --- times of variables


def _earliest(model: Model) -> list[float]:
    """Durations under the bounds that turn out to matter, and the least shift of each cluster that is free to move.

    Unknown times from outside are free to move too: the plan is made for the time that suits it best. Bounds are lazy:
    the plan is first made without them, and only those that it breaks are added. A plan of least cost under some bounds
    that meets all of them is the plan, so it does not depend on which were added.
    """
    clusters = _clusters(model)
    free = _free(model, clusters)
    active: list[BoundArc] = []
    while True:
        times = least_cost_times(model, clusters, active)
        arcs = [Arc(free[b.tail], free[b.head], times[b.tail] + b.length - times[b.head], b) for b in model.bounds]
        shifts, broken = longest_path(1 + max(free), [arc for arc in arcs if arc.tail != arc.head])
        broken = broken + [arc for arc in arcs if arc.tail == arc.head and arc.length > TOLERANCE]
        found = [arc.label for arc in broken if arc.label not in active]
        if not found:  # all met; or missed, by the little that the numbers are not exact
            return [time + shifts[number] - shifts[START] for time, number in zip(times, free, strict=True)]
        active += found


def _clusters(model: Model) -> list[int]:
    """For each variable one of those that preferred durations connect it with, without the start of the block."""
    clusters = OffsetUnionFind[int]()
    for span in model.spans:
        if span.costs and span.tail and span.head:
            clusters.union(span.tail, span.head)
    return [clusters.find(variable)[0] for variable in range(model.size)]


def _free(model: Model, clusters: Sequence[int]) -> list[int]:
    """For each variable the number of its cluster; `START` for those that known times hold."""
    ends = [(span.tail, span.head) for span in model.spans if span.costs]
    held = {START, *(clusters[tail or head] for tail, head in ends if START in (tail, head))}
    numbers = {cluster: number for number, cluster in enumerate(sorted(set(clusters) - held), 1)}
    return [numbers.get(cluster, START) for cluster in clusters]


# --- times of points


def _points(model: Model, times: Sequence[float], behavior: int) -> list[float]:
    """The times of all points of a behavior, s after the block's start."""
    knots = model.knots[behavior]
    points: list[float] = []
    for k, length in enumerate((0.0, *_lengths(model, behavior))):
        if k in knots:
            variable, offset = model.places[knots[k]]
            points.append(times[variable] + offset)
        else:
            points.append(points[-1] + length)
    return points


def _lengths(model: Model, behavior: int) -> list[float]:
    """The durations of phases, s; those behind the last knot take over the stretch of those before it."""
    part, last = model.parts[behavior], max(model.knots[behavior])
    tempo = 1.0 if part.tempo is None else part.tempo.ratio
    phases = model.relaxed.items[behavior].timing.phases
    lengths = [phase.duration for phase in phases]
    for k in range(last, len(phases)):
        lengths[k] *= tempo if phases[k].kind is PhaseKind.ELASTIC else 1.0
        if part.limited(k):
            lengths[k] = min(max(lengths[k], phases[k].minimum), phases[k].maximum)
        lengths[k] = max(lengths[k], phases[k].shortest)
    for span in part.spans:
        durations = stretched([phases[k] for k in span.phases], span.duration) if span.preferred else [span.duration]
        for k, duration in zip(span.phases, durations, strict=True):
            lengths[k] = duration
    return lengths


def _unplayable(model: Model, behavior: int, points: Sequence[float]) -> Iterator[Conflict]:
    """Whether a behavior has no duration (thesis 7.14)."""
    requirements = frozenset({Requirement(Rank.BEHAVIOR, behavior)})
    if points[-1] - points[0] < SHORTEST and not model.relaxed.items[behavior].timing.instant:
        yield Conflict(requirements, 0.0)
