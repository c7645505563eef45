"""The strategy that stretches as little as it can, keeps before/after, and does not care for the order of elements."""

from reactive_realizer.scheduler.convex.model import Model
from reactive_realizer.scheduler.convex.relaxation import Relaxation
from reactive_realizer.scheduler.convex.relaxed_problem import RelaxedProblem
from reactive_realizer.scheduler.convex.timetable import Timetable, find_times
from reactive_realizer.scheduler.problem import Point, SchedulingProblem, Solution, canonical


class ConvexStrategy:
    """The plan of least cost that keeps all constraints, and starts what is free as early as these allow.

    Durations minimize a convex cost (`Costs`); then every cluster starts at the earliest time (thesis 7.24). What
    cannot be kept is given up in the order of docs/semantics.md.
    """

    name = "convex"

    def solve(self, problem: SchedulingProblem) -> Solution:
        """See `SchedulingStrategy`."""
        problem = canonical(problem)
        relaxation = Relaxation(problem)
        while True:
            relaxed = RelaxedProblem.of(problem, relaxation.things)
            found = find_times(Model(relaxed, relaxation.things))
            if isinstance(found, Timetable):
                break
            relaxation.resolve(relaxed, found)
        relaxation.report_orphans()
        times = {
            Point(item.behavior.id, sync): time
            for index, item in relaxed.items.items()
            for sync, time in zip(item.timing.points, found.points[index], strict=True)
        }
        return Solution(times, tuple(relaxation.losses))
