"""Plans that are held against the equations of the thesis before they are played."""

from dataclasses import replace

from reactive_realizer.scheduler.plan_view import PlanView
from reactive_realizer.scheduler.problem import Loss, Problem, Solution
from reactive_realizer.scheduler.strategy import SchedulingStrategy
from reactive_realizer.scheduler.verify import verify_promises


class VerifiedStrategy:
    """A strategy as it is, with what its plans break among what they lose (``--verify``).

    What is found in what plays too is left to those who look there.
    """

    def __init__(self, strategy: SchedulingStrategy) -> None:
        self.name = strategy.name
        self._strategy = strategy

    def solve(self, problem: Problem) -> Solution:
        """See `SchedulingStrategy`."""
        solution = self._strategy.solve(problem)
        violations = verify_promises(PlanView.of_solution(problem, solution))
        broken = [Loss(None, violation.fault, dropped=False, required=False) for violation in violations]
        return replace(solution, losses=(*solution.losses, *broken))
