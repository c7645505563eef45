"""How behaviors end: cut short, dropped, of their own accord."""

import logging
from collections.abc import Iterable, Sequence

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.effects import Dropped, Reached
from reactive_realizer.errors import Fault
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import OpenPeg
from reactive_realizer.planunit.plan_unit import PlanUnit, SyncPoint, UnitState
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.cast import Cast
from reactive_realizer.scheduler.reporter import Reporter

logger = logging.getLogger(__name__)


class UnitEndings:
    """Ends single behaviors and tells it; what becomes of their blocks is not judged here."""

    def __init__(self, board: PegBoard, cast: Cast, blocks: Blocks, reporter: Reporter) -> None:
        self._board = board
        self._cast = cast
        self._blocks = blocks
        self._reporter = reporter

    def tell(self, reached: Sequence[Reached]) -> None:
        """Sync points were reached: they keep their times, and are told."""
        with self._board.graph.transaction("sync points reached"):
            for each in reached:
                each.point.peg.pin(each.time)
        for each in reached:
            self._reporter.reached(each)

    def cut(self, unit: PlanUnit, now: GlobalTime, *, at_end: bool = False) -> bool:
        """End a behavior now, what is due first; whether anything of it was cut.

        Args:
            unit: planned.
            now: when.
            at_end: whether its end was moved to now only to cut it here.
        """
        if unit.due(now):
            unit.begin()
        if unit.state is not UnitState.IN_EXEC:
            self.leave([unit], now)
            return True
        try:
            return self._cut_short(unit, now, at_end)
        except Exception as failure:
            logger.exception("%s/%s:%s failed when it was interrupted", *unit.block, unit.behavior.id)
            self.drop_unit(unit, Fault("unit-failed", {"reason": failure}), now)
            return True

    def finish(self, unit: PlanUnit, time: GlobalTime) -> None:
        """A playing behavior ends of its own accord, before what was planned: its end moves to a time."""
        block = self._blocks.get(unit.block)
        if block is None or unit.state is not UnitState.IN_EXEC:
            return
        try:
            reached = [Reached(unit, point, time) for point in unit.interrupt(time)]
        except Exception as failure:
            logger.exception("%s/%s:%s failed when it ended", *unit.block, unit.behavior.id)
            self.drop_unit(unit, Fault("unit-failed", {"reason": failure}), time)
            return
        others = {point.peg for other in block.units if other is not unit for point in other.points}
        for each in reached:
            if each.point.peg in others:
                self.split(unit, each.point, time)
        self._cast.take(unit)
        self.tell(reached)
        with self._board.graph.transaction(f"end {unit.behavior.id}"):
            block.end_again(block.end.floor)

    def drop_unit(self, unit: PlanUnit, fault: Fault, now: GlobalTime) -> None:
        """A behavior cannot be played on."""
        unit.drop(now)
        self.drop(Dropped(unit, fault), now)

    def drop(self, dropped: Dropped, now: GlobalTime) -> None:
        """Warn of a unit that left the plan; one that had begun ends now, one that is required fails its block."""
        unit = dropped.unit
        block = self._blocks.get(unit.block)
        self._reporter.warn_of(unit, dropped.fault)
        if block is not None and unit in block.units:
            block.units.remove(unit)
            block.dropped.add(unit.behavior.id)
            block.failing |= unit.behavior.required
            with self._board.graph.transaction(f"drop {unit.behavior.id}"):
                block.end_again(now)
        self._cast.take(unit)
        if unit.begun and unit.points[-1].fired is None:
            self._reporter.reached(Reached(unit, self.split(unit, unit.points[-1], now), now))

    def leave(self, units: Iterable[PlanUnit], now: GlobalTime) -> None:
        """Behaviors vanish without a word."""
        for unit in list(units):
            unit.drop(now)
            self._cast.take(unit)

    def split(self, unit: PlanUnit, point: SyncPoint, now: GlobalTime) -> SyncPoint:
        """Give a cut point a peg of its own: others that share the old one keep what was predicted last.

        The end of what persists is known by being cut, and whoever hangs on it learns it.
        """
        with self._board.graph.transaction(f"cut {unit.key(point.id)}"):
            if isinstance(point.peg, OpenPeg):
                point.peg.pin(now)
            else:
                point.peg = point.peg.apart(str(unit.key(point.id)), now)
        return point

    def _cut_short(self, unit: PlanUnit, now: GlobalTime, at_end: bool) -> bool:
        details = unit.end_details(now)
        fired = unit.fire(now, end=not at_end)
        reached = [Reached(unit, point, point.fired or now) for point in fired]
        cut = unit.live
        if cut:
            kept = [self.split(unit, point, now) for point in unit.interrupt(now)]
            reached += [Reached(unit, p, now, details if p.id == "end" else {}) for p in kept]
        self._cast.take(unit)
        self.tell(reached)
        return cut
