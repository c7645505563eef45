"""How behaviors and blocks end: by themselves, cut short, dropped, revoked, failed."""

import logging
from collections.abc import Iterable, Sequence

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.effects import Dropped, Reached
from reactive_realizer.errors import Fault
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import TimePeg, followers_of
from reactive_realizer.planunit.plan_unit import PlanUnit, SyncPoint, UnitState
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BlockState, BMLBlock
from reactive_realizer.scheduler.cast import Cast
from reactive_realizer.scheduler.predictions import Predictions
from reactive_realizer.scheduler.reporter import Reporter

logger = logging.getLogger(__name__)


class Endings:
    """Ends what is to end, tells it, and leaves nothing hanging (thesis 6.6.8; docs/semantics.md, interruption).

    Attributes:
        failed: how many blocks ended FAILED.
    """

    def __init__(
        self, board: PegBoard, cast: Cast, blocks: Blocks, reporter: Reporter, predictions: Predictions
    ) -> None:
        self.failed = 0
        self._board = board
        self._cast = cast
        self._blocks = blocks
        self._reporter = reporter
        self._predictions = predictions

    def end(self, block: BMLBlock, state: BlockState, time: GlobalTime) -> None:
        """A block ends in a state; what others had tied to it is let go."""
        self._predictions.close(block, time)
        block.state = state
        with self._board.graph.transaction(f"end {block.key.block}"):
            block.end.pin(time)
            cut = self._board.pin_block(block.key)
        self._reporter.ended(block, time)
        self._board.remove_block(block.key)
        self._blocks.end(block, time)
        for unit in block.units:
            self._cast.take(unit)
        self._hand_over_targets(block)
        self._release_tied(cut, state, time)
        self.failed += state is BlockState.FAILED
        logger.info("%s/%s %s at %.2f s, %d behaviors", *block.key, state.value, time, len(block.units))

    def fail(self, block: BMLBlock, now: GlobalTime) -> None:
        """A block fails now, and its behaviors vanish."""
        self._leave(block.live_units, now)
        self.end(block, BlockState.FAILED, now)

    def interrupt(self, block: BMLBlock, now: GlobalTime) -> None:
        """A block is cut: what is due happens first; one that has not started is revoked."""
        if not block.state.plays:
            self._leave(block.units, now)
            self.end(block, BlockState.REVOKED, now)
            return
        cut = False
        for unit in block.live_units:
            cut |= self._interrupt_unit(unit, now)
        if cut:
            self.end(block, BlockState.INTERRUPTED, now)
        else:
            self.end(block, BlockState.DONE, block.end.value if block.end.value is not None else now)

    def reach(self, reached: Sequence[Reached]) -> None:
        """Sync points were reached: they keep their times, and are told."""
        with self._board.graph.transaction("sync points reached"):
            for each in reached:
                each.point.peg.pin(each.time)
        for each in reached:
            self._reporter.reached(each)
            self._subside(each)

    def drop_unit(self, unit: PlanUnit, fault: Fault, now: GlobalTime) -> None:
        """A behavior cannot be played on."""
        unit.drop(now)
        self.drop(Dropped(unit, fault), now)

    def drop(self, dropped: Dropped, now: GlobalTime) -> None:
        """Warn of a unit that left the plan; one that had begun ends now."""
        unit = dropped.unit
        block = self._blocks.get(unit.block)
        self._reporter.warn_of(unit, dropped.fault)
        if block is not None and unit in block.units:
            block.units.remove(unit)
            with self._board.graph.transaction(f"drop {unit.behavior.id}"):
                block.end_again(now)
        self._cast.take(unit)
        if unit.begun and unit.points[-1].fired is None:
            self._reporter.reached(Reached(unit, self._split(unit, unit.points[-1], now), now))

    def _interrupt_unit(self, unit: PlanUnit, now: GlobalTime) -> bool:
        """End a behavior now, what is due first; whether anything of it was cut."""
        if unit.due(now):
            unit.begin()
        if unit.state is not UnitState.IN_EXEC:
            self._leave_unit(unit, now)
            return True
        try:
            return self._cut_short(unit, now)
        except Exception as failure:
            logger.exception("%s/%s:%s failed when it was interrupted", *unit.block, unit.behavior.id)
            self.drop_unit(unit, Fault("unit-failed", {"reason": failure}), now)
            return True

    def _cut_short(self, unit: PlanUnit, now: GlobalTime) -> bool:
        details = unit.end_details(now)
        reached = [Reached(unit, point, point.fired or now) for point in unit.fire(now)]
        cut = unit.live
        if cut:
            kept = [self._split(unit, point, now) for point in unit.interrupt(now)]
            reached += [Reached(unit, p, now, details if p.id == "end" else {}) for p in kept]
        self._cast.take(unit)
        self.reach(reached)
        return cut

    def _split(self, unit: PlanUnit, point: SyncPoint, now: GlobalTime) -> SyncPoint:
        """Give a cut point a peg of its own: others that share the old one keep what was predicted last."""
        with self._board.graph.transaction(f"cut {unit.key(point.id)}"):
            point.peg = point.peg.apart(str(unit.key(point.id)), now)
        return point

    def _leave(self, units: Iterable[PlanUnit], now: GlobalTime) -> None:
        for unit in list(units):
            self._leave_unit(unit, now)

    def _leave_unit(self, unit: PlanUnit, now: GlobalTime) -> None:
        unit.drop(now)
        self._cast.take(unit)

    def _hand_over_targets(self, ended: BMLBlock) -> None:
        """Who waited for a block that ended before its turn waits for what that one waited for."""
        with self._board.graph.transaction(f"after {ended.key.block}"):
            for block in self._blocks.alive:
                if ended in block.targets and ended.waits_for:
                    block.wait_instead(ended)
        ended.targets = ()

    def _release_tied(self, cut: Sequence[TimePeg], state: BlockState, now: GlobalTime) -> None:
        """Behaviors of other blocks that hang on points which never come keep the times predicted last, and say so.

        Without such a time they are lost; also when a block never began and they have not begun either.
        """
        followers = {follower: peg for peg in cut for follower in followers_of(peg)}
        for unit in [unit for block in self._blocks.alive for unit in block.live_units]:
            tied = [point.peg for point in unit.ahead() if point.peg in followers]
            if not tied:
                continue
            details = {"point": followers[tied[0]].name}
            if any(peg.value is None for peg in tied) or (state is BlockState.REVOKED and not unit.begun):
                self.drop_unit(unit, Fault("never-comes", details), now)
            else:
                self._reporter.warn_of(unit, Fault("cut-tie", details))

    def _subside(self, reached: Reached) -> None:
        block = self._blocks.get(reached.unit.block)
        if block is not None and block.state is BlockState.IN_EXEC and block.subsides():
            block.state = BlockState.SUBSIDING
