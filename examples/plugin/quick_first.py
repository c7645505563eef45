"""A strategy of one's own: the quick one, unless that loses something."""

from reactive_realizer.scheduler.convex.convex_strategy import ConvexStrategy
from reactive_realizer.scheduler.problem import Problem, Solution
from reactive_realizer.scheduler.smartbody_strategy import SmartBodyStrategy


class QuickFirst:
    """What `smartbody` can plan is planned by it, the rest by `convex`."""

    name = "quick_first"

    def solve(self, problem: Problem) -> Solution:
        """A plan."""
        solution = SmartBodyStrategy().solve(problem)
        return ConvexStrategy().solve(problem) if solution.losses else solution
