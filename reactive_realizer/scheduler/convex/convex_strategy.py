"""The default strategy: least stretching, all kinds of constraints, the same plan for any order of elements."""

from reactive_realizer.scheduler.convex.model import Model, RelaxedProblem
from reactive_realizer.scheduler.convex.relaxation import Relaxation
from reactive_realizer.scheduler.convex.timetable import Timetable, find_times
from reactive_realizer.scheduler.problem import SchedulingProblem
from reactive_realizer.scheduler.solution import Solution


class ConvexStrategy:
    """The plan of least cost that satisfies all constraints, with clusters as early as these allow.

    Durations minimize a convex cost (`Costs`); then every cluster starts at the earliest time (thesis 7.24). If not all
    constraints can be satisfied, some are given up in the order of docs/semantics.md.
    """

    name = "convex"

    def solve(self, problem: SchedulingProblem) -> Solution:
        """See `SchedulingStrategy`."""
        problem = problem.canonical
        relaxation = Relaxation(problem)
        while True:
            relaxed = RelaxedProblem.of(problem, relaxation.dropped)
            found = find_times(Model(relaxed, relaxation.dropped))
            if isinstance(found, Timetable):
                break
            relaxation.resolve(relaxed, found)
        relaxation.report_orphans()
        times = {
            point: time
            for index, item in relaxed.items.items()
            for point, time in zip(item.points, found.points[index], strict=True)
        }
        return Solution(times, tuple(relaxation.losses))
