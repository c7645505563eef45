"""Checks plans while they play (``--verify``)."""

import logging
from dataclasses import replace
from weakref import WeakKeyDictionary, WeakSet

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.errors import WarningType
from reactive_realizer.feedback.feedback_manager import FeedbackManager
from reactive_realizer.feedback.messages import WarningFeedback
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.scheduler.block_state import BlockState
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.bml_scheduler import BMLScheduler
from reactive_realizer.scheduler.plan_view import PlanView
from reactive_realizer.scheduler.problem import SchedulingProblem
from reactive_realizer.scheduler.solution import Solution
from reactive_realizer.scheduler.verify import Violation, verify

logger = logging.getLogger(__name__)


class Verifier:
    """Checks plans when they are committed and when they move, and reports each violated equation once.

    A committed plan is checked as a solution of its own problem, because its points may fire, and external times may
    change, before the tick is over. On the board, constraints are checked only if no external time has moved and no
    behavior has begun, because it takes the time that the body needs from its present posture; otherwise,
    `ConstraintMonitor` reports the constraints that can no longer be satisfied. It reports ties to times from outside
    that were broken before the block played in the tick in which the block starts, after this check.
    """

    def __init__(self, scheduler: BMLScheduler, feedback: FeedbackManager) -> None:
        self._moves = scheduler.blocks.watch.moves()
        self._feedback = feedback
        self._reported: WeakKeyDictionary[BMLBlock, set[tuple[str, tuple[str, ...]]]] = WeakKeyDictionary()
        self._given: WeakKeyDictionary[BMLBlock, tuple[object, ...]] = WeakKeyDictionary()
        self._played: WeakSet[BMLBlock] = WeakSet()
        scheduler.listen_to_plans(self._hold)

    def check(self, now: GlobalTime) -> None:
        """Check the blocks that have moved in the tick at ``now``, before missed constraints count as settled."""
        for block in self._moves.take()[0]:
            if block.state is not BlockState.IN_PREP:
                self._judge(block, now)

    def _hold(self, block: BMLBlock, problem: SchedulingProblem, solution: Solution) -> None:
        self._verify(block, PlanView.of_solution(problem, solution))

    def _judge(self, block: BMLBlock, now: GlobalTime) -> None:
        plan = PlanView.of_block(block, now, played=block in self._played)
        if block.state.plays:
            self._played.add(block)
        before = self._given.get(block)
        given = self._given[block] = (plan.start, plan.lurking, *plan.outer.values())
        self._verify(block, plan if given == before else replace(plan, settled=frozenset(plan.kept)))

    def _verify(self, block: BMLBlock, plan: PlanView) -> None:
        reported = self._reported.setdefault(block, set())
        for violation in verify(plan):
            key = violation.equation, violation.points
            if key not in reported:
                reported.add(key)
                self._report(block.key, violation)

    def _report(self, block: BlockKey, violation: Violation) -> None:
        text = str(violation.fault)
        logger.error("%s/%s: %s", *block, text)
        self._feedback.add(WarningFeedback(*block, WarningType.IMPOSSIBLE_TO_SCHEDULE, text))
