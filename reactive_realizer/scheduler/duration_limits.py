"""The phases of a plan whose durations are beyond the limits that the author of the motion has set."""

from collections.abc import Iterator, Sequence
from itertools import pairwise
from math import inf

from reactive_realizer.errors import SchedulingFault
from reactive_realizer.scheduler.offset_union_find import TIE_TOLERANCE
from reactive_realizer.scheduler.problem import Item, SchedulingProblem
from reactive_realizer.scheduler.solution import Loss, Solution


class BeyondLimits(SchedulingFault):
    """A part of a behavior that is shorter or longer than its author allows; times in s."""

    code = "beyond-limits"
    template = "constraints require {duration:.2f} s from {start} to {end}, where its author allows {limit}"
    duration: float
    start: str
    end: str
    limit: str


def beyond_limits(problem: SchedulingProblem, solution: Solution) -> list[Loss]:
    """The limits that a plan does not keep, one for each behavior; they are relaxed before any constraint is."""
    planned = (item for item in problem.items if item.timing.limited and item.behavior.id in solution.behaviors)
    return [loss for item in planned for loss in _beyond(item, [solution.times[point] for point in item.points])]


def _beyond(item: Item, times: Sequence[float]) -> Iterator[Loss]:
    durations = [later - earlier for earlier, later in pairwise(times)]
    phases = [item.timing.phases[k] for k in range(len(durations))]
    short = [k for k in item.timing.limited if durations[k] < phases[k].minimum - TIE_TOLERANCE]
    long = [k for k in item.timing.limited if durations[k] > phases[k].maximum + TIE_TOLERANCE]
    if not short and not long:
        return
    parts = short or long
    first, last = min(parts), max(parts)
    least = sum(phase.minimum for phase in phases[first : last + 1])
    most = sum(phase.maximum if phase.maximum < inf else phase.duration for phase in phases[first : last + 1])
    start, end = item.timing.points[first], item.timing.points[last + 1]
    limit = f"{least:.2f} s or more" if short else f"{most:.2f} s or less"
    fault = BeyondLimits(duration=times[last + 1] - times[first], start=start, end=end, limit=limit)
    located = fault.located(item.behavior.location.line, item.behavior.location.column)
    yield Loss(item.behavior.id, located, dropped=False, required=False)
