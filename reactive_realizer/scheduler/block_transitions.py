"""Carries out the transitions of blocks: writes the state, pins and reports as the table says."""

import logging
from collections.abc import Callable

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.pegboard.peg_key import BlockKey, anticipator_key
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import TimePeg
from reactive_realizer.scheduler.block_feedback import BlockFeedback
from reactive_realizer.scheduler.block_state import PREDICTION, REMAINING, BlockEvent, BlockState
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.engine_routing import EngineRouting
from reactive_realizer.scheduler.predictions import Predictions
from reactive_realizer.scheduler.tie_release import CutTie, TieRelease

logger = logging.getLogger(__name__)


class BlockTransitions:
    """Carries out the rows of `TRANSITIONS`; `BlockLifecycle` decides when.

    Attributes:
        listeners: called with each block that has ended, while its points are still on the board.
    """

    def __init__(
        self,
        board: PegBoard,
        routing: EngineRouting,
        blocks: Blocks,
        ties: TieRelease,
        feedback: BlockFeedback,
        predictions: Predictions,
    ) -> None:
        self.listeners: list[Callable[[BMLBlock], None]] = []
        self._board = board
        self._routing = routing
        self._blocks = blocks
        self._ties = ties
        self._feedback = feedback
        self._predictions = predictions

    def take(self, block: BMLBlock, event: BlockEvent, time: GlobalTime) -> list[TimePeg]:
        """Carry out a transition of the table: write the state, pin and report; the pegs that the end of a block cut.

        Raises:
            IllegalTransitionError: the table has no such transition from the present state.
        """
        row = block.take(event)
        self._blocks.starting.note(block)
        cut: list[TimePeg] = []
        with self._board.graph.transaction(f"{'end' if row.target.ended else event.value} {block.key.block}"):
            for point in row.pins:
                if point == REMAINING:
                    cut = self._board.pin_block(block.key)
                elif not block.peg(point).pinned:
                    block.peg(point).pin(time)
        for report in row.reports:
            if report == PREDICTION:
                self._predictions.request(block)
            else:
                self._feedback.block_progress(block, report, time)
        return cut

    def subside(self, key: BlockKey) -> None:
        """Have a block subside if it is alive and only returns to rest are left of it."""
        block = self._blocks.get(key)
        time = None if block is None else block.relax.value
        if block is not None and time is not None and block.state is BlockState.IN_EXEC and block.subsides():
            self.take(block, BlockEvent.SUBSIDE, time)

    def end(self, block: BMLBlock, event: BlockEvent, time: GlobalTime) -> None:
        """End a block, and release the behaviors of others that depend on it."""
        self._predictions.close(block, time)
        cut = self.take(block, event, time)
        for listener in self.listeners:
            listener(block)
        self._blocks.end(block, time)
        for unit in block.units:
            if unit.live and not unit.begun:
                unit.drop(time)  # its sound may have been announced
            self._routing.unassign(unit)
        with self._board.graph.transaction(f"after {block.key.block}"):
            block.leave()
        self._ties.release_from(block.key, cut, time, CutTie, began=block.started_at is not None)
        self._board.remove_block(block.key, [anticipator_key(*point) for point in block.predicted])
        logger.info("%s/%s %s at %.2f s, %d behaviors", *block.key, block.state.value, time, len(block.units))
