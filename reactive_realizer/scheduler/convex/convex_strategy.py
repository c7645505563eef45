"""The default strategy: least stretching, all kinds of constraints, the same plan for any order of elements."""

from collections.abc import Iterable, Iterator

from reactive_realizer.scheduler.convex.conflicts import Requirement
from reactive_realizer.scheduler.convex.model import Model
from reactive_realizer.scheduler.convex.relaxation import Relaxation, limits_of
from reactive_realizer.scheduler.convex.timetable import find_times
from reactive_realizer.scheduler.duration_limits import limits_not_kept
from reactive_realizer.scheduler.problem import SchedulingProblem
from reactive_realizer.scheduler.solution import Solution


class ConvexStrategy:
    """The plan of least cost that satisfies all constraints, with clusters as early as these allow.

    Durations minimize a convex cost (`Costs`); then every cluster starts at the earliest time (thesis 7.24). If not all
    constraints can be satisfied, some are given up in the order of docs/semantics.md.

    Authored limits are lazy: most plans keep them without being told to, and are found faster without them.
    """

    name = "convex"

    def solve(self, problem: SchedulingProblem) -> Solution:
        """See `SchedulingStrategy`."""
        problem = problem.canonical
        limits = list(_limits(problem))
        solution = _solved(problem, limits)
        broken = limits and any(limits_not_kept(problem, solution))
        return _solved(problem, ()) if broken else solution


def _solved(problem: SchedulingProblem, left_out: Iterable[Requirement]) -> Solution:
    """The plan without some requirements, and without those that must be given up."""
    relaxation = Relaxation(problem, left_out)
    while isinstance(found := find_times(Model(problem, relaxation.dropped)), list):
        relaxation.resolve(found)
    relaxation.report_orphans()
    return Solution(found, tuple(relaxation.losses))


def _limits(problem: SchedulingProblem) -> Iterator[Requirement]:
    """The authored limits; those of a behavior without preferences also say that it takes time, and stay."""
    for index, item in enumerate(problem.items):
        if item.timing.limited and not item.timing.free:
            yield from limits_of(index, item.timing)
