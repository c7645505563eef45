"""When everything happens: durations first, then the earliest start of what hangs together (thesis 7.24)."""

from collections.abc import Iterator, Mapping, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass

from reactive_realizer.planunit.timing import SHORTEST, PhaseKind
from reactive_realizer.scheduler.convex.conflict import Conflict, Rank, Requirement
from reactive_realizer.scheduler.convex.durations import Durations
from reactive_realizer.scheduler.convex.feasibility import conflicts
from reactive_realizer.scheduler.convex.longest_path import TOLERANCE, Arc, components, longest_path
from reactive_realizer.scheduler.convex.model import START, Model
from reactive_realizer.scheduler.convex.span import Bound


@dataclass(frozen=True, slots=True)
class Timetable:
    """A model and its solution.

    Attributes:
        times: of the variables, s after the block's start.
        points: times of all points of each behavior, s after the block's start.
    """

    model: Model
    times: Sequence[float]
    points: Mapping[int, Sequence[float]]


def find_times(model: Model) -> Timetable | list[Conflict]:
    """Times that meet everything, at least cost and as early as that allows; or what cannot be met together."""
    if model.conflicts:
        return model.conflicts
    connecting = [span for span in model.spans if span.costs and not span.closed]
    clusters = components(model.size, [(s.tail, s.head) for s in connecting if START not in (s.tail, s.head)])
    grounded = {START, *(clusters[s.tail or s.head] for s in connecting if START in (s.tail, s.head))}
    if found := conflicts(model):
        return found
    times = _earliest(model, clusters, grounded)
    for span in model.spans:
        span.duration = times[span.head] - times[span.tail] + span.shift
    points = {index: _points(model, times, index) for index in model.knots}
    unplayable = [conflict for index, each in points.items() for conflict in _unplayable(model, index, each)]
    return unplayable or Timetable(model, times, points)


def _earliest(model: Model, clusters: Sequence[int], grounded: AbstractSet[int]) -> list[float]:
    """Durations under the bounds that turn out to matter, and the least shift of each cluster that is free to move.

    What is unknown is free to move too: a plan for the time that suits it best.
    """
    durations, active = Durations(model), list[Bound]()
    free = sorted(set(clusters) - grounded)
    places = {START: START} | {cluster: place for place, cluster in enumerate(free, 1)}
    numbers = [places.get(cluster, START) for cluster in clusters]
    while True:
        times = durations.times(active)
        arcs = [
            Arc(numbers[b.earlier], numbers[b.later], times[b.earlier] + b.distance - times[b.later], b)
            for b in model.bounds
        ]
        shifts, broken = longest_path(1 + len(free), [arc for arc in arcs if arc.tail != arc.head])
        broken = broken + [arc for arc in arcs if arc.tail == arc.head and arc.length > TOLERANCE]
        found = [arc.label for arc in broken if arc.label not in active]
        if not found:  # all met; or missed, by the little that the numbers are not exact
            return [time + shifts[number] - shifts[START] for time, number in zip(times, numbers, strict=True)]
        active += found


def _time(model: Model, times: Sequence[float], node: int) -> float:
    variable, distance = model.place(node)
    return times[variable] + distance


def _points(model: Model, times: Sequence[float], behavior: int) -> list[float]:
    """Of all points of a behavior, s after the block's start."""
    knots = model.knots[behavior]
    points = [_time(model, times, knots[0])]
    for k, length in enumerate(_lengths(model, behavior), 1):
        points.append(_time(model, times, knots[k]) if k in knots else points[-1] + length)
    return points


def _lengths(model: Model, behavior: int) -> list[float]:
    """Durations of phases, s; those behind the last knot take over the stretch of what is before it."""
    part, last = model.parts[behavior], max(model.knots[behavior])
    tempo = 1.0 if part.tempo is None else part.tempo.ratio
    phases = model.relaxed.items[behavior].timing.phases
    lengths = [phase.duration for phase in phases]
    for k in range(last, len(phases)):
        lengths[k] *= tempo if phases[k].kind is PhaseKind.ELASTIC else 1.0
        if part.limited(k):
            lengths[k] = min(max(lengths[k], phases[k].minimum), phases[k].maximum)
    for span in part.spans:
        for k in span.phases:
            lengths[k] = lengths[k] * span.ratio if span.preferred else span.duration
    return lengths


def _unplayable(model: Model, behavior: int, points: Sequence[float]) -> Iterator[Conflict]:
    """A behavior that has no time at all (thesis 7.14), or none after the start of its block."""
    requirements = frozenset({Requirement(Rank.BEHAVIOR, behavior)})
    if points[-1] - points[0] < SHORTEST and not model.relaxed.items[behavior].timing.instant:
        yield Conflict(requirements, 0.0)
    elif behavior in model.late and points[-1] < -SHORTEST:
        yield Conflict(requirements, -points[-1], late=True)
