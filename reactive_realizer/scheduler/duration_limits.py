"""The limits that authors set for the durations of phases, and the phases that do not keep them."""

from collections.abc import Iterator, Sequence

from reactive_realizer.errors import SchedulingFault
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.sync_point import SyncPoint
from reactive_realizer.planunit.timing import Timing
from reactive_realizer.scheduler.problem import Item, SchedulingProblem
from reactive_realizer.scheduler.solution import Loss, Solution

_NOTICEABLE = 0.01
"""A planned phase that exceeds its limit by less (s), which is one tick, keeps it."""

_ACCEPTABLE = 0.1
"""A phase that has been played may exceed its limit by as much (s), as a tie may be missed (`ConstraintMonitor`)."""


class BeyondLimits(SchedulingFault):
    """A behavior, or a phase of it, that is shorter or longer than its author allows; times in s."""

    code = "beyond-limits"
    template = "{behavior} from {start} to {end} is to last at {bound} {limit} s, lasts {duration} s"
    compared = ("limit", "duration")
    behavior: str
    start: str
    end: str
    bound: str
    limit: float
    duration: float


def limits_not_kept(problem: SchedulingProblem, solution: Solution) -> Iterator[Loss]:
    """The limits that a plan does not keep, one loss for each behavior; they are given up before any constraint is."""
    for item in problem.items:
        if not item.timing.limited or item.behavior.id not in solution.behaviors:
            continue
        if (fault := _first(item, [solution.times[point] for point in item.points])) is not None:
            located = fault.located(item.behavior.location.line, item.behavior.location.column)
            yield Loss(item.behavior.id, located, dropped=False, required=item.behavior.required)


def limit_not_kept(unit: PlanUnit, point: SyncPoint) -> BeyondLimits | None:
    """The limit that was not kept until a point that a unit has reached, of the phase before it or of the whole."""
    timing, end = unit.timing, point.peg.value
    phase = timing.points.index(point.id) - 1
    if phase < 0 or point.cut or end is None:
        return None
    start, begin = unit.time(timing.points[0]), unit.time(timing.points[phase])
    if start is None or begin is None:
        return None
    id_ = unit.behavior.id
    whole = _whole(id_, timing, end - start, _ACCEPTABLE) if point is unit.points[-1] else None
    return whole or (_phase(id_, timing, phase, end - begin, _ACCEPTABLE) if phase in timing.limited else None)


def _first(item: Item, times: Sequence[float]) -> BeyondLimits | None:
    """The fault of a behavior with points at some times (s), or else of its first phase that has one."""
    id_, timing = item.behavior.id, item.timing
    phases = (_phase(id_, timing, k, times[k + 1] - times[k]) for k in sorted(timing.limited))
    return _whole(id_, timing, times[-1] - times[0]) or next(filter(None, phases), None)


def _whole(behavior: str, timing: Timing, duration: float, tolerance: float = _NOTICEABLE) -> BeyondLimits | None:
    """The fault of a behavior that lasts (s) less or more than its limits, of which each phase has its share."""
    return _beyond(behavior, timing.points[0], timing.points[-1], timing.limits, duration, tolerance)


def _phase(
    behavior: str, timing: Timing, index: int, duration: float, tolerance: float = _NOTICEABLE
) -> BeyondLimits | None:
    """The fault of a phase that lasts (s) less or more than its limits."""
    phase = timing.phases[index]
    limits = phase.minimum, phase.maximum
    return _beyond(behavior, timing.points[index], timing.points[index + 1], limits, duration, tolerance)


def _beyond(
    behavior: str, start: str, end: str, limits: tuple[float, float], duration: float, tolerance: float
) -> BeyondLimits | None:
    least, most = limits
    if least - tolerance <= duration <= most + tolerance:
        return None
    bound, limit = ("least", least) if duration < least else ("most", most)
    return BeyondLimits(behavior=behavior, start=start, end=end, bound=bound, limit=limit, duration=duration)
