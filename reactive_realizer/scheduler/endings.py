"""How blocks end: by themselves, cut short, revoked, failed."""

import logging
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence

from reactive_realizer.clock.units import GlobalTime, is_due
from reactive_realizer.engine.effects import Dropped, Reached
from reactive_realizer.errors import Fault
from reactive_realizer.pegboard.following import followers_of
from reactive_realizer.pegboard.peg_key import BlockKey, PegKey
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import OpenPeg, TimePeg
from reactive_realizer.planunit.plan_unit import PlanUnit, SyncPoint, UnitState
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BlockState, BMLBlock
from reactive_realizer.scheduler.cast import Cast
from reactive_realizer.scheduler.constraints import hanging_on, naming
from reactive_realizer.scheduler.predictions import Predictions
from reactive_realizer.scheduler.problem import Point
from reactive_realizer.scheduler.reporter import Reporter
from reactive_realizer.scheduler.unit_endings import UnitEndings

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
        self._units = UnitEndings(board, cast, blocks, reporter)
        self._cuts: dict[PlanUnit, GlobalTime] = {}
        self._listeners: list[Callable[[BlockKey], None]] = []

    def listen(self, listener: Callable[[BlockKey], None]) -> None:
        """Call ``listener(block)`` when a block has ended, while its points are still on the board."""
        self._listeners.append(listener)

    def end(self, block: BMLBlock, state: BlockState, time: GlobalTime) -> None:
        """A block ends in a state; what others had tied to it is let go."""
        self._predictions.close(block, time)
        block.state = state
        with self._board.graph.transaction(f"end {block.key.block}"):
            block.end.pin(time)
            if not block.relax.pinned:
                block.relax.pin(time)
            cut = self._board.pin_block(block.key)
        self._reporter.ended(block, time)
        for listener in self._listeners:
            listener(block.key)
        self._blocks.end(block, time)
        for unit in block.units:
            self._cast.take(unit)
        self._hand_over_targets(block)
        self._release_tied(block.key, cut, time, "cut-tie", began=block.noticed is not None)
        self._board.remove_block(block.key)
        self.failed += state is BlockState.FAILED
        logger.info("%s/%s %s at %.2f s, %d behaviors", *block.key, state.value, time, len(block.units))

    def fail(self, block: BMLBlock, now: GlobalTime) -> None:
        """A block fails now: what plays of it is broken off, and what has not begun vanishes."""
        self._units.leave([unit for unit in block.live_units if not unit.begun], now)
        for unit in block.live_units:
            self._units.cut(unit, now)
        self.end(block, BlockState.FAILED, now)

    def interrupt(self, block: BMLBlock, time: GlobalTime, spared: Collection[str] = (), gently: bool = False) -> None:
        """Cut a block at a time: what is due happens first; one that has not started is revoked.

        Args:
            block: alive.
            time: not after this tick.
            spared: ids of behaviors that go on.
            gently: whether each may end what it cannot break off in the middle of: a speech its word.
        """
        if not block.state.plays:
            self._revoke(block, time, spared)
            return
        chosen = [unit for unit in block.live_units if unit.behavior.id not in spared]
        ends = {unit: unit.gentle_end(time) for unit in chosen if gently and unit.begun}
        for unit, last in ends.items():
            self._end_at(unit, last)
        self._cut(block, [unit for unit in chosen if ends.get(unit, time) <= time], time)

    def cut_due(self, now: GlobalTime) -> bool:
        """Cut what was to end its word first; whether anything was due."""
        due = [(time, unit) for unit, time in self._cuts.items() if is_due(time, now)]
        for time, unit in sorted(due, key=lambda cut: cut[0]):
            block = self._blocks.get(unit.block)
            if block is not None and unit in block.live_units:
                self._cut(block, [unit], time)
            self._cuts.pop(unit, None)
        return bool(due)

    def finish(self, unit: PlanUnit, time: GlobalTime) -> None:
        """A playing behavior ends of its own accord, before what was planned."""
        self._units.finish(unit, time)
        self._subside(unit.block)

    def drop_past(self, unit: PlanUnit, fault: Fault, now: GlobalTime) -> None:
        """A behavior was over before its block began: who hangs on its points knows when they were."""
        self._units.drop_unit(unit, fault, now)

    def drop_unit(self, unit: PlanUnit, fault: Fault, now: GlobalTime) -> None:
        """A behavior cannot be played on."""
        unit.drop(now)
        self.drop(Dropped(unit, fault), now)

    def drop(self, dropped: Dropped, now: GlobalTime) -> None:
        """Warn of a unit that left the plan, and tell what hung on it; one that had begun ends now."""
        unit = dropped.unit
        missed = self._pegs_of(unit, unit.ahead())
        self._units.drop(dropped, now)
        block = self._blocks.get(unit.block)
        if block is not None and not block.failing:
            self._let_go(block, missed, "dropped-tie", now)

    def begin(self, unit: PlanUnit, now: GlobalTime) -> None:
        """A behavior plays what is due of it, before its engine has it play; one that is not due is no mistake."""
        if unit.due(now):
            unit.begin()
            self.reach([Reached(unit, point, point.fired or now) for point in unit.fire(now)])

    def reach(self, reached: Sequence[Reached]) -> None:
        """Sync points were reached: they keep their times, and are told; a block may subside by it."""
        self._units.tell(reached)
        for block in {each.unit.block: None for each in reached}:
            self._subside(block)

    def _revoke(self, block: BMLBlock, time: GlobalTime, spared: Collection[str]) -> None:
        """Behaviors of a block that has not started vanish, and the block with the last of them."""
        names = {behavior.id for behavior in block.description.behaviors} - block.cancelled
        gone = names.difference(spared)
        block.cancelled |= gone
        units = [unit for unit in block.units if unit.behavior.id in gone]
        self._units.leave(units, time)
        if gone == names:
            self.end(block, BlockState.REVOKED, time)
            return
        with self._board.graph.transaction(f"revoke a part of {block.key.block}"):
            block.units = [unit for unit in block.units if unit not in units]
            if block.state is not BlockState.IN_PREP:
                block.end_again(block.end.floor)

    def _cut(self, block: BMLBlock, units: Sequence[PlanUnit], time: GlobalTime) -> None:
        """Some behaviors of a playing block end now; the block too if nothing is left of it."""
        missed = self._missed(units, time)
        cut = [self._units.cut(unit, time, at_end=unit in self._cuts) for unit in units]
        block.units = [unit for unit in block.units if unit.state is not UnitState.DROPPED]
        if not block.live_units and any(cut):
            self.end(block, BlockState.INTERRUPTED, time)
        elif not block.live_units:
            self.end(block, BlockState.DONE, block.end.value if block.end.value is not None else time)
        else:
            self._let_go(block, missed, "cut-tie", time)
            self._subside(block.key)

    def _missed(self, units: Sequence[PlanUnit], time: GlobalTime) -> dict[Point, TimePeg]:
        """The points that some behaviors will not reach as planned if they are cut at a time, with their old pegs."""
        missed: dict[Point, TimePeg] = {}
        for unit in units:
            moved = unit.points[-1] if unit in self._cuts else None
            ahead = [point for point in unit.ahead() if point is moved or not is_due(point.peg.value, time)]
            missed |= self._pegs_of(unit, ahead)
        return missed

    def _pegs_of(self, unit: PlanUnit, points: Iterable[SyncPoint]) -> dict[Point, TimePeg]:
        """Some points of a behavior with the pegs that others may hang on."""
        pegs = ((Point(unit.behavior.id, point.id), self._board.get(unit.key(point.id))) for point in points)
        return {point: peg for point, peg in pegs if isinstance(peg, TimePeg) and not isinstance(peg, OpenPeg)}

    def _let_go(self, block: BMLBlock, missed: Mapping[Point, TimePeg], code: str, time: GlobalTime) -> None:
        """What hung on points that a block's behaviors miss keeps the times predicted last, and is told by a code."""
        hanging = hanging_on({point.behavior for point in missed}, block.kept)
        others = [unit for unit in block.live_units if unit.behavior.id not in hanging]
        living = {point.peg for unit in others for point in unit.ahead()}
        old = dict.fromkeys(missed.values())
        pegs = [peg for peg in old if not peg.pinned and living.isdisjoint({peg, *followers_of(peg)})]
        with self._board.graph.transaction(f"cut a part of {block.key.block}"):
            for peg in pegs:
                peg.pin(peg.value)
            block.end_again(block.end.floor)
        told = self._release_tied(block.key, pegs, time, code, began=block.state.plays)
        for unit in [unit for unit in block.live_units if unit.behavior.id in hanging and unit not in told]:
            point = naming(unit.behavior.id, missed, block.kept)
            if isinstance(point, Point):
                self._reporter.warn_of(unit, Fault(code, {"point": PegKey(*block.key, *point)}))

    def _end_at(self, unit: PlanUnit, time: GlobalTime) -> None:
        """It is to be cut at a time, which is its end from now on; one that would end by then anyway goes on."""
        if is_due(unit.time("end"), time):
            return
        self._cuts[unit] = time
        block = self._blocks.get(unit.block)
        with self._board.graph.transaction(f"cut {unit.key('end')}"):
            self._units.split(unit, unit.points[-1], time)
            if block is not None:
                block.end_again(block.end.floor)

    def _hand_over_targets(self, ended: BMLBlock) -> None:
        """Who waited for all, and for this block as the last one, waits for what that one waited for."""
        with self._board.graph.transaction(f"after {ended.key.block}"):
            for block in self._blocks.alive if ended.waits_for else ():
                if any(wait.implied and wait.target is ended for wait in block.waits):
                    block.wait_instead(ended)
        ended.waits = ()

    def _release_tied(
        self, owner: BlockKey, cut: Collection[TimePeg], now: GlobalTime, code: str, *, began: bool
    ) -> set[PlanUnit]:
        """Behaviors that hang on points which never come keep the times predicted last; those that are told of it.

        Without such a time they are lost; also when the block that owns these points never began, nor have they. Those
        of other blocks are told that are tied to such a point: who hangs on them is tied to them as before.
        """
        told = set()
        gone = frozenset(cut)
        followed = {follower: peg for peg in cut for follower in (peg, *followers_of(peg))}
        alive = self._blocks.alive if followed else ()
        for block, unit in [(each, unit) for each in alive for unit in each.live_units]:
            tied = [point.peg for point in unit.ahead() if point.peg in followed]
            if not tied:
                continue
            details = {"point": self._as_written(unit, owner, followed[tied[0]])}
            if any(peg.value is None for peg in tied) or not (began or unit.begun):
                self._units.drop_unit(unit, Fault("never-comes", details), now)
                told.add(unit)
            elif block.key != owner and naming(unit.behavior.id, gone, block.kept) is not None:
                self._reporter.warn_of(unit, Fault(code, details))
                told.add(unit)
        return told

    def _as_written(self, unit: PlanUnit, owner: BlockKey, peg: TimePeg) -> str:
        """How a behavior, or else its block, names a peg of a block, which may be that of several points."""
        block = self._blocks.get(unit.block)
        refs = (*unit.behavior.syncs.values(), *(block.description.refs if block is not None else ()))
        own = (ref for ref in refs if (ref.block or unit.block.block) == owner.block)
        keys = (PegKey(*owner, ref.behavior, ref.sync or "start") for ref in own)
        return next((str(key) for key in keys if self._board.get(key) is peg), peg.name)

    def _subside(self, key: BlockKey) -> None:
        block = self._blocks.get(key)
        time = None if block is None else block.relax.value
        if block is None or time is None or block.state is not BlockState.IN_EXEC or not block.subsides():
            return
        with self._board.graph.transaction(f"subside {key.block}"):
            block.relax.pin(time)
        block.state = BlockState.SUBSIDING
        self._reporter.subsided(block, time)
