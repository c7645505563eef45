"""The default strategy: least stretching, all kinds of constraints, the same plan for any order of elements."""

from reactive_realizer.scheduler.convex.model import Model
from reactive_realizer.scheduler.convex.relaxation import Relaxation
from reactive_realizer.scheduler.convex.timetable import find_times
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
        while isinstance(found := find_times(Model(problem, relaxation.dropped)), list):
            relaxation.resolve(found)
        relaxation.report_orphans()
        return Solution(found, tuple(relaxation.losses))
