"""Solves the problems of blocks by the strategy, and by what a strategy leaves open: stretched speech and takeovers."""

import logging
from collections.abc import Generator, Sequence
from collections.abc import Set as AbstractSet
from typing import TypeVar

from reactive_realizer.scheduler.block_problem import BlockProblem
from reactive_realizer.scheduler.faults import WorkFailed
from reactive_realizer.scheduler.offset_union_find import OffsetUnionFind
from reactive_realizer.scheduler.plan import Plan
from reactive_realizer.scheduler.problem import Node, Origin, Point, Precedence, SchedulingProblem, Tie
from reactive_realizer.scheduler.solution import Loss, Solution
from reactive_realizer.scheduler.strategy import SchedulingStrategy, solve
from reactive_realizer.scheduler.takeovers import takeovers

logger = logging.getLogger(__name__)

_SOLVED = 3
"""Work of a solution for each point that it has a time for."""

T = TypeVar("T")


class BlockSolver:
    """Solves problems of blocks; thread-safe, because it reads only these."""

    def __init__(self, strategy: SchedulingStrategy) -> None:
        self._strategy = strategy

    def solve(self, posed: BlockProblem) -> Plan:
        """A plan by the strategy.

        A speech that can be stretched is first planned as rigid, and stretched only if more constraints are kept that
        way. One that is tied to times from outside can be stretched later.
        """
        return _at_once(self.solve_in_steps(posed))

    def solve_in_steps(self, posed: BlockProblem) -> Generator[int, None, Plan]:
        """As `solve`, in steps, each of which asks the strategy once and gives the work that it took."""
        plan = yield from self._solve(posed)
        posed, problem = plan.posed, plan.posed.problem
        if not plan.solution.losses:
            loosened = posed.loosened(_following_outside(problem), problem.constraints)
            return plan if loosened is None else Plan(loosened, plan.solution)
        stretched = yield from self._stretched(posed, problem.constraints, len(plan.losses) - 1)
        if stretched is not None and stretched.solution.losses:
            # A constraint that is lost anyway must not stretch anything.
            kept = stretched.layout.kept.constraints
            stretched = (yield from self._stretched(posed, kept, len(stretched.losses))) or stretched
        return stretched or plan

    def _stretched(
        self, posed: BlockProblem, constraints: Sequence[Tie | Precedence], most: int
    ) -> Generator[int, None, Plan | None]:
        """A plan in which speeches are stretched for some constraints, if no more than a number of things are lost."""
        loosened = posed.loosened({item.behavior.id for item in posed.problem.items}, constraints)
        plan = None if loosened is None else (yield from self._solve(loosened))
        return None if plan is None or len(plan.losses) > most else plan

    def _solve(self, posed: BlockProblem) -> Generator[int, None, Plan]:
        """A plan of a problem; if the strategy raises, only this block fails."""
        try:
            plan = yield from self._solve_as_posed(posed)
            return (yield from self._with_takeovers(plan))
        except Exception as failure:
            logger.exception("the strategy %s failed", self._strategy.name)
            fault = WorkFailed(reason=str(failure))
            return Plan(posed, Solution({}, (Loss(None, fault, dropped=False, required=True),)))

    def _solve_as_posed(self, posed: BlockProblem) -> Generator[int, None, Plan]:
        plan = Plan(posed, solve(self._strategy, posed.problem))
        yield _SOLVED * plan.size
        return plan

    def _with_takeovers(self, plan: Plan) -> Generator[int, None, Plan]:
        """A plan in which gestures take over the arms of others, where nothing is lost for that."""
        refused: set[Precedence] = set()
        while True:
            found = takeovers(plan.posed.problem, plan.posed.units, plan.solution.times, refused)
            tried = refused.union(plan.posed.problem.orders)
            wanted = {order: each for order, each in found.items() if order not in tried}
            if not wanted:
                return plan
            taking = yield from self._solve_as_posed(plan.posed.with_takeovers(wanted))
            if len(taking.solution.losses) <= len(plan.solution.losses):
                plan = taking
                continue
            lost = {loss.constraint for loss in taking.solution.losses}
            refused.update(wanted.keys() & lost or wanted)


def _following_outside(problem: SchedulingProblem) -> AbstractSet[str]:
    """The behaviors of which a point after the first is tied, directly or through others, to a time from outside."""
    cells = [node for each in problem.ties for node in each.nodes if not isinstance(node, Point | Origin)]
    if not cells:
        return frozenset()
    groups = OffsetUnionFind[Node](cells)
    for tie in problem.ties:
        for node in tie.nodes:
            groups.add(node)
        groups.union(*tie.nodes)
    outside = {groups.find(cell)[0] for cell in cells}
    later = {point for item in problem.items for point in item.points[1:]}
    named = {node for tie in problem.ties for node in tie.nodes if node in later and groups.find(node)[0] in outside}
    return {node.behavior for node in named if isinstance(node, Point)}


def _at_once(steps: Generator[int, None, T]) -> T:
    """Do all steps at once; the result of the last one."""
    while True:
        try:
            next(steps)
        except StopIteration as end:
            result: T = end.value
            return result
