"""Plans that are checked while they are played."""

import logging
from collections.abc import Iterable
from dataclasses import replace
from weakref import WeakKeyDictionary

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.errors import WarningType
from reactive_realizer.feedback.feedback_manager import FeedbackManager
from reactive_realizer.feedback.messages import WarningFeedback
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.reactive.commit import Commit
from reactive_realizer.scheduler.bml_block import BlockState, BMLBlock
from reactive_realizer.scheduler.bml_scheduler import BMLScheduler
from reactive_realizer.scheduler.concerned import concerned
from reactive_realizer.scheduler.plan_view import PlanView
from reactive_realizer.scheduler.problem import Problem, Solution
from reactive_realizer.scheduler.verify import Violation, verify

logger = logging.getLogger(__name__)


class Verifier:
    """Checks plans as they are committed, and as they move on the board; says once what does not hold (``--verify``).

    What is committed is judged as a solution of its own problem: its points may come, and times from outside may be
    other ones, before a tick is over. On the board, constraints are judged where nothing from outside moved. Where
    something did, what cannot be kept any more breaks nothing, and is told without being asked (`ConstraintWatch`).
    """

    def __init__(self, board: PegBoard, scheduler: BMLScheduler, feedback: FeedbackManager) -> None:
        self._board = board
        self._blocks = scheduler.blocks
        self._feedback = feedback
        self._said: WeakKeyDictionary[BMLBlock, set[tuple[str, tuple[str, ...]]]] = WeakKeyDictionary()
        self._outside: WeakKeyDictionary[BMLBlock, list[float | None]] = WeakKeyDictionary()
        scheduler.listen_to_plans(self._hold)

    def check(self, commits: Iterable[Commit], now: GlobalTime) -> None:
        """Check what the commits of the tick at ``now`` moved; before what is missed by it counts as settled."""
        moved = {change.cell for commit in commits for change in commit.changes}
        for block in concerned(self._blocks, self._board, moved):
            if block.state is not BlockState.IN_PREP:
                self._judge(block, now)

    def _hold(self, block: BMLBlock, problem: Problem, solution: Solution) -> None:
        self._verify(block, PlanView.of_solution(problem, solution))

    def _judge(self, block: BMLBlock, now: GlobalTime) -> None:
        plan = PlanView.of_block(block, now)
        before, outside = self._outside.get(block), [plan.start, *plan.outer.values()]
        self._outside[block] = outside
        self._verify(block, plan if outside == before else replace(plan, settled=frozenset(plan.kept)))

    def _verify(self, block: BMLBlock, plan: PlanView) -> None:
        said = self._said.setdefault(block, set())
        for violation in verify(plan):
            key = violation.equation, violation.points
            if key not in said:
                said.add(key)
                self._say(block.key, violation)

    def _say(self, block: BlockKey, violation: Violation) -> None:
        text = str(violation.fault)
        logger.error("%s/%s: %s", *block, text)
        self._feedback.say(WarningFeedback(*block, WarningType.IMPOSSIBLE_TO_SCHEDULE, text))
