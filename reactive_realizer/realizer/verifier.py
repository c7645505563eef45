"""Plans that are checked while they are played."""

import logging
from collections.abc import Iterable

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.errors import WarningType
from reactive_realizer.feedback.feedback_manager import FeedbackManager
from reactive_realizer.feedback.messages import WarningFeedback
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.reactive.commit import Commit
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BlockState, BMLBlock
from reactive_realizer.scheduler.concerned import concerned
from reactive_realizer.scheduler.plan_view import PlanView
from reactive_realizer.scheduler.verify import Violation, verify

logger = logging.getLogger(__name__)


class Verifier:
    """Checks, after a tick, the blocks of which something moved, and says once what does not hold (``--verify``)."""

    def __init__(self, board: PegBoard, blocks: Blocks, feedback: FeedbackManager) -> None:
        self._board = board
        self._blocks = blocks
        self._feedback = feedback
        self._said: dict[BlockKey, set[tuple[str, tuple[str, ...]]]] = {}

    def check(self, commits: Iterable[Commit], now: GlobalTime) -> None:
        """Check what the commits of the tick at ``now`` moved."""
        moved = {change.cell for commit in commits for change in commit.changes}
        self._said = {block.key: self._said.get(block.key, set()) for block in self._blocks.alive}
        for block in concerned(self._blocks, self._board, moved):
            if block.state is not BlockState.IN_PREP:
                self._verify(block, now)

    def _verify(self, block: BMLBlock, now: GlobalTime) -> None:
        said = self._said[block.key]
        for violation in verify(PlanView.of_block(block, now)):
            key = violation.equation, violation.points
            if key not in said:
                said.add(key)
                self._say(block.key, violation)

    def _say(self, block: BlockKey, violation: Violation) -> None:
        text = str(violation.fault)
        logger.error("%s/%s: %s", *block, text)
        self._feedback.say(WarningFeedback(*block, WarningType.IMPOSSIBLE_TO_SCHEDULE, text))
