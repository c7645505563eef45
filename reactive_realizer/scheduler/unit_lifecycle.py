"""The life of single behaviors: they reach their sync points, and finish, are cut or are dropped."""

import logging
from collections.abc import Collection, Iterable, Mapping, Sequence
from functools import partial
from typing import Any, NamedTuple

from reactive_realizer.bml.behaviors import Wait
from reactive_realizer.bml.names import EVENTS
from reactive_realizer.bml.vocabulary import InterruptSpeech
from reactive_realizer.clock.units import GlobalTime, has_passed, is_due
from reactive_realizer.engine.effects import Dropped, Reached
from reactive_realizer.engine.faults import UnitFailed
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import OffsetPeg, TimePeg
from reactive_realizer.planunit.plan_unit import PlanUnit, UnitState
from reactive_realizer.planunit.sync_point import DuePoint, Hurry, SyncPoint
from reactive_realizer.planunit.timing import SHORTEST, Timing
from reactive_realizer.reactive.graph import Cell
from reactive_realizer.scheduler.block_feedback import BlockFeedback
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.duration_limits import limit_not_kept
from reactive_realizer.scheduler.engine_routing import EngineRouting
from reactive_realizer.scheduler.predictions import Predictions
from reactive_realizer.scheduler.rigid_points import fixed_point, shift_ahead

logger = logging.getLogger(__name__)

_MOST_CORRECTIONS = 20
"""Corrections of one transaction; if behaviors that share points still disagree then, their points keep their times."""


class ScheduledCut(NamedTuple):
    """The end of a behavior that was interrupted and may first end what should not be cut in the middle.

    Attributes:
        time: at which it is cut, s.
        asked: when it was interrupted, s.
        speech: the point at which a speech ends.
    """

    time: GlobalTime
    asked: GlobalTime
    speech: InterruptSpeech


class UnitLifecycle:
    """Takes single behaviors to their end and reports it; `BlockLifecycle` decides what that means for the block."""

    def __init__(
        self,
        board: PegBoard,
        routing: EngineRouting,
        blocks: Blocks,
        feedback: BlockFeedback,
        predictions: Predictions,
    ) -> None:
        self._board = board
        self._routing = routing
        self._blocks = blocks
        self._feedback = feedback
        self._predictions = predictions
        self._scheduled_cuts: dict[PlanUnit, ScheduledCut] = {}
        self._touched: set[BlockKey] = set()
        board.graph.before_commit(self._correct_points)

    def touch(self, block: BlockKey) -> None:
        """Note that a block may have ended or failed."""
        self._touched.add(block)

    def touched(self) -> list[BMLBlock]:
        """The blocks that may have ended or failed since `forget_touched`, in order of arrival."""
        blocks = [block for key in self._touched if (block := self._blocks.get(key)) is not None]
        return sorted(blocks, key=lambda block: block.arrival)

    def forget_touched(self) -> None:
        """Forget the touched blocks, because they were looked at."""
        self._touched.clear()

    def sync_points_reached(self, reached: Sequence[Reached]) -> None:
        """Pin each sync point at the time at which it was reached, and report it; no other code reports one."""
        with self._board.graph.transaction("sync points reached"):
            for each in reached:
                each.point.peg.pin(each.time)
                if each.emits is not None:
                    self._board.occur(EVENTS, each.emits.event, each.time)
            hurried = dict.fromkeys(each.unit for each in reached if any(each.unit.shortest) and each.unit.live)
            self._hold_back(hurried)
            self._keep_order(hurried)
        for each in reached:
            self.touch(each.unit.block)
            self._feedback.sync_point_reached(each)
            if each.unit.timing.limited:
                self._check_limits(each)

    def begin(self, unit: PlanUnit, now: GlobalTime) -> list[Reached]:
        """Begin a behavior, if it is due, before its engine plays; the points that it reaches are not reported yet."""
        if not unit.due(now):
            return []
        unit.begin()
        unit.wake()
        return _fire(unit, unit.due_points(now), now)

    def cut(self, unit: PlanUnit, now: GlobalTime) -> bool:
        """End a planned behavior now, after its due points have fired; whether anything of it was cut."""
        if unit.due(now) and unit.refusal() is None:
            unit.begin()
            unit.wake()
        if unit.state is not UnitState.IN_EXEC:
            self.remove([unit], now)
            return True
        try:
            return self._cut_short(unit, now)
        except Exception as failure:
            logger.exception("%s/%s:%s failed when it was interrupted", *unit.block, unit.behavior.id)
            self.drop([Dropped(unit, UnitFailed(reason=str(failure)))], now)
            return True

    def schedule_cut(self, unit: PlanUnit, cut: ScheduledCut) -> None:
        """Have a playing behavior cut at a later time, which is its end from now on."""
        self._scheduled_cuts[unit] = cut
        unit.ends_early = True
        block = self._blocks.get(unit.block)
        with self._board.graph.transaction(f"cut {unit.key('end')}"):
            unit.detach(unit.points[-1], cut.time)
            if block is not None:
                block.update_end()
                self._blocks.watch.follow(block)
                self._predictions.request(block)  # the end may be another peg, which has not moved

    def shift(self, unit: PlanUnit, seconds: float) -> None:
        """Move the points ahead of a playing rigid behavior, with what is tied to them, because it has drifted."""
        block = self._blocks.get(unit.block)
        if block is None or unit.state is not UnitState.IN_EXEC:
            return
        with self._board.graph.transaction(f"drift of {unit.behavior.id}"):
            shift_ahead(block, unit, dict.fromkeys((point.id for point in unit.ahead()), seconds), self._board)
            if (cut := self._scheduled_cuts.get(unit)) is not None:
                time, asked = GlobalTime(cut.time + seconds), GlobalTime(cut.asked + seconds)
                self.schedule_cut(unit, cut._replace(time=time, asked=asked))
        unit.wake()

    def move(self, unit: PlanUnit, times: Mapping[str, GlobalTime]) -> None:
        """Have points ahead of a behavior of a playing block come at some times; what is tied to them follows."""
        block = self._blocks.get(unit.block)
        if block is None or not block.state.plays or not unit.live:
            return
        pegs = {point.id: point.peg for point in unit.ahead() if not point.peg.pinned}
        with self._board.graph.transaction(f"move {unit.behavior.id}"):
            if unit.timing.rigid:
                later = {sync: times[sync] - peg.value for sync, peg in pegs.items() if peg.value is not None}
                self._shift_from(block, unit, later)
            else:
                for sync, peg in sorted(pegs.items(), key=lambda each: each[1].rank):
                    if sync in times:
                        self._board.graph.settle()
                        _put(peg, times[sync])
        unit.wake()

    def retime(self, unit: PlanUnit, before: Timing) -> None:
        """Move the points ahead of a rigid behavior of a playing block, with what is tied to them, to its new timing.

        Args:
            unit: the behavior.
            before: the timing that it had.
        """
        block = self._blocks.get(unit.block)
        if block is None:
            return
        offsets = zip(unit.timing.points, unit.timing.offsets, before.offsets, strict=True)
        with self._board.graph.transaction(f"new timing of {unit.behavior.id}"):
            self._shift_from(block, unit, {sync: after - earlier for sync, after, earlier in offsets})
            if (cut := self._scheduled_cuts.get(unit)) is not None:
                self.schedule_cut(unit, cut._replace(time=unit.gentle_end(cut.asked, cut.speech)))
        unit.wake()

    def _shift_from(self, block: BMLBlock, unit: PlanUnit, later: Mapping[str, float]) -> None:
        """Move the points ahead of a rigid behavior by some seconds; before it begins, its fixed point stays."""
        kept = 0.0 if unit.begun else later[fixed_point(block, unit)]
        ahead = {point.id: later[point.id] - kept for point in unit.ahead() if point.id in later}
        shift_ahead(block, unit, ahead, self._board)

    def cut_scheduled(self, unit: PlanUnit) -> bool:
        """Whether a behavior has a cut scheduled."""
        return unit in self._scheduled_cuts

    def due_cuts(self, now: GlobalTime) -> list[tuple[GlobalTime, PlanUnit]]:
        """The scheduled cuts that are due, in order of time."""
        due = [(cut.time, unit) for unit, cut in self._scheduled_cuts.items() if is_due(cut.time, now)]
        return sorted(due, key=lambda cut: cut[0])

    def forget_cut(self, unit: PlanUnit) -> None:
        """Forget a scheduled cut that is done."""
        self._scheduled_cuts.pop(unit, None)

    def finish(self, unit: PlanUnit, time: GlobalTime) -> None:
        """End a playing behavior by itself at a time that was not planned; dependents of its end move along."""
        block = self._blocks.get(unit.block)
        if block is None or unit.state is not UnitState.IN_EXEC:
            return
        others = {point.peg for other in block.units if other is not unit for point in other.points}
        try:
            with self._board.graph.transaction(f"end {unit.behavior.id}"):
                reached = [Reached(unit, point, time) for point in unit.finish(time, others)]
        except Exception as failure:
            logger.exception("%s/%s:%s failed when it ended", *unit.block, unit.behavior.id)
            self.drop([Dropped(unit, UnitFailed(reason=str(failure)))], time)
            return
        self._routing.unassign(unit)
        self.sync_points_reached(reached)
        with self._board.graph.transaction(f"end {unit.behavior.id}"):
            block.update_end()

    def drop(self, dropped: Sequence[Dropped], now: GlobalTime) -> None:
        """Drop behaviors of a block with warnings; those that had begun end now. The block of a required one fails."""
        units = [each.unit for each in dropped]
        key, begun = units[0].block, [unit for unit in units if unit.begun]
        block = self._blocks.get(key)
        if block is not None and begun:
            fired = (point.peg.value for unit in begun for point in unit.points if point.fired)
            if any(not is_due(time, self._board.previous) for time in fired):
                self._predictions.request(block)  # this tick reports points that no later prediction names
            self._predictions.report_requested(block, now)
        self.touch(key)
        for unit, fault in dropped:
            unit.drop(now)
            self._feedback.warn_behavior(unit, fault)
        if block is not None:
            self._leave(block, units, now)
        for unit in units:
            self._routing.unassign(unit)
            if unit.begun and not unit.points[-1].fired:
                with self._board.graph.transaction(f"cut {unit.key('end')}"):
                    unit.detach(unit.points[-1], now)
                self.sync_points_reached([Reached(unit, unit.points[-1], now)])

    def _leave(self, block: BMLBlock, units: Collection[PlanUnit], now: GlobalTime) -> None:
        """Have behaviors that are dropped leave their block, unless they have left it before."""
        gone = set(units).intersection(block.units)
        if not gone:
            return
        block.units = [unit for unit in block.units if unit not in gone]
        block.dropped.update(unit.behavior.id for unit in gone)
        block.failing |= any(unit.behavior.required for unit in gone)
        names = sorted(unit.behavior.id for unit in gone)
        more = f" and {len(names) - 1} more" if len(names) > 1 else ""
        with self._board.graph.transaction(f"drop {names[0]}{more}"):
            block.update_end(now)

    def remove(self, units: Iterable[PlanUnit], now: GlobalTime) -> None:
        """Take behaviors out of their plans without feedback."""
        for unit in list(units):
            unit.drop(now)
            self.touch(unit.block)
            self._routing.unassign(unit)

    def _check_limits(self, reached: Reached) -> None:
        """Warn once of a behavior of which a phase has moved, and exceeded the limits of its author."""
        unit = reached.unit
        block = self._blocks.get(unit.block)
        fault = limit_not_kept(unit, reached.point)
        if fault is not None and block is not None and unit.behavior.id not in block.beyond_limits:
            block.beyond_limits.add(unit.behavior.id)
            self._feedback.warn_behavior(unit, fault)

    def _correct_points(self, changed: Collection[Cell[Any]]) -> None:
        """Correct points that a transaction has moved, before it commits (docs/semantics.md, pegs).

        In a playing block, a point that its body cannot reach in time comes when it can be reached, and another one
        that has moved before the last tick is pinned at this one. In a playing behavior, a point that is overtaken by
        its successor moves with it from then on, and an end that has moved to the start comes just after it. These are
        added to ``changed``.
        """
        for _ in range(_MOST_CORRECTIONS):
            self._board.graph.settle()  # so that reading times adds nothing to ``changed``
            units = self._moved(changed)
            corrections = (self._hold_back, self._keep_ends, partial(self._pin_past, changed=changed), self._keep_order)
            if not any(correct(units) for correct in corrections):
                return

    def _keep_order(self, units: Iterable[PlanUnit]) -> bool:
        """Have points of units that have begun not come after later ones; whether any of them did."""
        for unit in units:
            fixed = {point.peg for point in unit.ahead() if point.peg.pinned}
            if unit.begun and unit.keep_order(partial(self._part, unit, overtaken=True)):
                for peg in {point.peg for point in unit.ahead() if point.peg.pinned} - fixed:
                    # It moved with a later point, which may have lain in the past.
                    if peg.value is not None and peg.value < self._board.previous:
                        peg.pin(self._board.time)
                return True
        return False

    def _hold_back(self, units: Iterable[PlanUnit]) -> bool:
        """Have points not come before their bodies can reach them; whether any of them did."""
        held = False
        now = self._board.time
        for unit in units:
            for point, earliest in unit.earliest(now):
                time = point.peg.value
                if time is None or not has_passed(time, earliest) or (point.peg.pinned and is_due(time, now)):
                    continue
                if earliest > now:
                    unit.hurries[point.id] = Hurry(need=earliest - now, room=max(0.0, time - now))
                self._part(unit, point)
                point.peg.keep_after(earliest)
                held = True
        return held

    def _keep_ends(self, units: Iterable[PlanUnit]) -> bool:
        """Have behaviors that take time not end when they start (thesis 7.14); whether any of them did."""
        kept = False
        for unit in units:
            start, end = unit.points[0].peg, unit.points[-1].peg
            if not unit.begun or end.pinned or start.value is None or not has_passed(end.value, start.value + SHORTEST):
                continue
            if not (isinstance(unit.behavior, Wait) or unit.timing.closed.instant):
                self._part(unit, unit.points[-1])
                unit.points[-1].peg.keep_after(GlobalTime(start.value + SHORTEST))
                kept = True
        return kept

    def _part(self, unit: PlanUnit, point: SyncPoint, *, overtaken: bool = False) -> None:
        """Give a point a peg of its own if its peg is pinned, or shared by a behavior that cannot follow it.

        A rigid behavior cannot wait for it; and if the point is overtaken, no behavior can come earlier than its body.
        """
        block = self._blocks.get(unit.block)
        if block is None:
            return
        held = overtaken and point.peg.earliest is not None
        timings = ((other, other.timing) for other in block.units if other is not unit)
        others = (other for other, timing in timings if held or (timing.rigid and not timing.instant))
        if point.peg.pinned or any(each.peg is point.peg for other in others for each in other.points):
            point.peg = OffsetPeg(self._board.graph, str(unit.key(point.id)), point.peg, 0.0)
            self._board.add(unit.key(point.id), point.peg)
            block.update_end()
            self._blocks.watch.follow(block)
            unit.wake()

    def _moved(self, changed: Collection[Cell[Any]]) -> list[PlanUnit]:
        """The units of playing blocks of which a point has changed and may have to be corrected.

        Those that are not about to begin are left out if nothing has moved into the past; so are those with a scheduled
        cut.
        """
        blocks = [block for block in self._blocks.watch.following(changed) if block.state.plays]
        if not blocks:
            return []
        now, previous = self._board.time, self._board.previous
        times = [cell.value for cell in changed if isinstance(cell, TimePeg)]
        past = min((time for time in times if time is not None), default=previous) < previous
        return [
            unit
            for block in blocks
            for unit in block.units
            if (past or unit.begun or is_due(unit.points[0].peg.value, now))
            and any(point.peg in changed for point in unit.points)
            and unit.live
            and not self.cut_scheduled(unit)
        ]

    def _pin_past(self, units: Collection[PlanUnit], changed: Collection[Cell[Any]]) -> bool:
        """Pin points that were moved into the past at the present time; whether there were any."""
        pegs = [point.peg for unit in units for point in unit.ahead() if point.peg in changed]
        pinned = False
        for peg in sorted(pegs, key=lambda peg: peg.rank):
            # Lowest rank first: pegs that depend on one that is pinned here may no longer lie in the past.
            if not peg.pinned and peg.value is not None and peg.value < self._board.previous:
                peg.pin(self._board.time)
                pinned = True
        return pinned

    def _cut_short(self, unit: PlanUnit, now: GlobalTime) -> bool:
        # A scheduled cut has moved the end to now only to cut it here.
        reached = _fire(unit, unit.due_at_cut(now, end=not self.cut_scheduled(unit)), now)
        cut = unit.live
        if cut:
            with self._board.graph.transaction(f"cut {unit.behavior.id}"):
                kept = unit.interrupt(now)
            reached += [Reached(unit, point, now) for point in kept]
        self._routing.unassign(unit)
        self.sync_points_reached(reached)
        return cut


def _put(peg: TimePeg, time: GlobalTime) -> None:
    """Within a transaction, have a peg come at a time, and follow from there on what it depends on."""
    if peg.value is None:
        peg.pin(time)
    else:
        peg.shift(time - peg.value)


def _fire(unit: PlanUnit, due: Sequence[DuePoint], now: GlobalTime) -> list[Reached]:
    unit.fire(due, now)
    return [Reached(unit, point, time) for point, time in due]
