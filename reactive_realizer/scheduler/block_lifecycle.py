"""The life of a block from its arrival to its end.

With the plans and transitions that it decides on, it is the only code that changes a block's state, pegs and progress.
"""

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence

from reactive_realizer.bml.block import BLOCK_EXTENSIONS
from reactive_realizer.bml.vocabulary import InterruptSpeech
from reactive_realizer.clock.units import GlobalTime, is_due
from reactive_realizer.engine.effects import Dropped, Reached
from reactive_realizer.errors import Fault
from reactive_realizer.pegboard.block_pegs import LateTiePeg
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.planunit.plan_unit import PlanUnit, UnitState
from reactive_realizer.scheduler.block_composition import BlockComposition
from reactive_realizer.scheduler.block_feedback import BlockFeedback
from reactive_realizer.scheduler.block_planner import BlockPlanner
from reactive_realizer.scheduler.block_plans import BlockPlans
from reactive_realizer.scheduler.block_state import BlockEvent, BlockState
from reactive_realizer.scheduler.block_transitions import BlockTransitions
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BMLBlock, Predecessor
from reactive_realizer.scheduler.engine_routing import EngineRouting
from reactive_realizer.scheduler.entry_queue import Entry
from reactive_realizer.scheduler.faults import ActivatedAlready, NotAwaited, NotPreplanned
from reactive_realizer.scheduler.plan import Plan
from reactive_realizer.scheduler.planning import Planning
from reactive_realizer.scheduler.predictions import Predictions
from reactive_realizer.scheduler.problem import Precedence, Tie
from reactive_realizer.scheduler.solution import Loss
from reactive_realizer.scheduler.tie_release import CutTie, DroppedTie, TieRelease
from reactive_realizer.scheduler.unit_lifecycle import ScheduledCut, UnitLifecycle

PointListener = Callable[[Sequence[Reached]], None]
BlockListener = Callable[[BMLBlock], None]


class BlockLifecycle:
    """Takes blocks from their arrival to their end; nothing but this and what it decides on writes a block."""

    def __init__(
        self,
        board: PegBoard,
        routing: EngineRouting,
        blocks: Blocks,
        planner: BlockPlanner,
        planning: Planning,
        feedback: BlockFeedback,
        predictions: Predictions,
    ) -> None:
        self._board = board
        self._routing = routing
        self._blocks = blocks
        self._planner = planner
        self._feedback = feedback
        self._predictions = predictions
        self._units = UnitLifecycle(board, routing, blocks, feedback, predictions)
        self._ties = TieRelease(board, blocks, self._units, feedback)
        self._transitions = BlockTransitions(board, routing, blocks, self._ties, feedback, predictions)
        self._plans = BlockPlans(
            board, routing, blocks, planner, planning, feedback, self._units, self._ties, self._transitions
        )
        self._arrivals = 0
        self._point_listeners: list[PointListener] = []
        self._start_listeners: list[BlockListener] = []
        self.listen(self._end_accompaniments)

    def listen_to_points(self, listener: PointListener) -> None:
        """Call ``listener(reached)`` with the points of a tick that are reached together, after they are pinned."""
        self._point_listeners.append(listener)

    def listen_to_starts(self, listener: BlockListener) -> None:
        """Call ``listener(block)`` when a block has started."""
        self._start_listeners.append(listener)

    def listen(self, listener: BlockListener) -> None:
        """Call ``listener(block)`` when a block has ended, while its points are still on the board."""
        self._transitions.listeners.append(listener)

    # --- arrival and planning

    def accept(self, composition: BlockComposition, entry: Entry, now: GlobalTime) -> None:
        """Make a block, end the blocks that it replaces or interrupts, and have it prepared.

        Args:
            composition: of the block, without a fault.
            entry: of the block, which ends at once if something required could not be read.
            now: the time of the tick.
        """
        for other in composition.ended:  # before the new block is among those alive
            self.interrupt(other, now)
        if composition.replaces:
            self._routing.reset(composition.character, now)
        block = self._new_block(composition, composition.predecessors, entry)
        with self._board.graph.transaction(f"put {block.key.block} before others"):
            for later, predecessor in composition.delayed_by(block):
                later.set_predecessors((*later.predecessors, predecessor))
        for fault in composition.unknown:
            self._feedback.warn(block.key.character, block.key.block, fault)
        if entry.parsed.failed:
            self._transitions.end(block, BlockEvent.FAIL, now)
        elif not self._plans.fails_by(block, self._planner.prepare(block), now):
            self._predictions.request(block)

    def accept_failed(self, composition: BlockComposition, entry: Entry, now: GlobalTime) -> None:
        """Make a block that cannot be put before the blocks that it names, and fail it.

        It is not refused, because its sender may have been told already that it is accepted.
        """
        self._transitions.end(self._new_block(composition, (), entry), BlockEvent.FAIL, now)

    def plan(self, block: BMLBlock, outcome: Plan | Loss, now: GlobalTime, floor: GlobalTime) -> None:
        """Give a block in preparation its plan (`BlockPlans.take`)."""
        self._plans.take(block, outcome, now, floor)

    # --- start

    def activate(self, character: str, name: str, time: GlobalTime) -> Fault | None:
        """Have a preplanned block start at a time, unless it waits for something else; a fault if it cannot."""
        block = self._blocks.find(character, name)
        if block is None:
            return self._blocks.missing(character, name)
        if block.activation is None:
            return NotPreplanned(block=name)
        if not block.awaits_activation:
            return ActivatedAlready(block=name)
        with self._board.graph.transaction(f"activate {name}"):
            block.activation.set(time)
        self._transitions.take(block, BlockEvent.ACTIVATE, time)
        self._plans.wait_for_next(block, block.renew_predicted(self._board), time)
        return None

    def start_due(self, now: GlobalTime) -> bool:
        """Start the blocks whose start is due, in order of time; whether there were any."""
        due = [block for block in self._blocks.starting.take_due(now) if block.may_start]
        for block in sorted(due, key=lambda b: (b.start.value, b.arrival)):
            # A block that has just started may have put off those that refer to it, or ended them.
            if block.may_start and is_due(block.start.value, now):
                self._keep_from_past(block, now)
                self._start(block, now)
        return bool(due)

    # --- sync points and behaviors

    def sync_points_reached(self, reached: Sequence[Reached]) -> None:
        """Pin and report sync points; a block may subside by them, and reach sync points of its own."""
        self._units.sync_points_reached(reached)
        for each in reached:
            block = self._blocks.get(each.unit.block)
            if block is not None and block.description.points:
                self._report_own(block, each)
        for key in {each.unit.block: None for each in reached}:
            self._transitions.subside(key)
        for listener in self._point_listeners:
            listener(reached)

    def _report_own(self, block: BMLBlock, reached: Reached) -> None:
        """Report the sync points of a block that a sync point of a behavior defines."""
        for sync, ref in block.description.points.items():
            if (ref.behavior, ref.sync) == (reached.unit.behavior.id, reached.point.id):
                self._feedback.block_progress(block, sync, reached.time)

    def begin_behavior(self, unit: PlanUnit, now: GlobalTime) -> None:
        """Begin a behavior, if it is due, before its engine plays."""
        self.sync_points_reached(self._units.begin(unit, now))

    def finish_behavior(self, unit: PlanUnit, time: GlobalTime) -> None:
        """End a playing behavior by itself at a time that was not planned."""
        self._units.finish(unit, time)
        self._transitions.subside(unit.block)

    def shift_behavior(self, unit: PlanUnit, seconds: float) -> None:
        """Move the points ahead of a playing behavior that has drifted, with what is tied to them."""
        self._units.shift(unit, seconds)

    def move_points(self, unit: PlanUnit, times: Mapping[str, GlobalTime]) -> None:
        """Have points ahead of a behavior of a playing block come at some times, with what is tied to them."""
        self._units.move(unit, times)

    def retime_behavior(self, unit: PlanUnit, change: Callable[[], None], now: GlobalTime) -> None:
        """Have a behavior change its timing; its points ahead move, or its block is planned again if it waits.

        Once it has begun, the points of one that is not rigid are moved when it asks for it.
        """
        block, before = self._blocks.get(unit.block), unit.timing
        change()
        if block is None or not unit.live or unit.timing.offsets == before.offsets:
            return
        if block.state.plays:
            if unit.timing.rigid or not unit.begun:
                self._units.retime(unit, before)
        else:
            self._plans.renew(block, f"new timing of {unit.behavior.id}", now)

    def wait_in_behavior(self, unit: PlanUnit, lacks_from: GlobalTime, until: GlobalTime, now: GlobalTime) -> None:
        """Have a behavior wait for what it lacks; one that is about to be cut is cut there."""
        if self._units.cut_scheduled(unit):
            self._units.schedule_cut(unit, ScheduledCut(lacks_from, lacks_from, InterruptSpeech.NOW))
        else:
            self.retime_behavior(unit, lambda: unit.wait(until), now)

    def drop_behaviors(self, dropped: Iterable[Dropped], now: GlobalTime) -> None:
        """Drop behaviors that cannot be played any more, and release the behaviors that depend on them."""
        by_block: dict[BlockKey, list[Dropped]] = {}
        for each in dropped:
            by_block.setdefault(each.unit.block, []).append(each)
        for key, several in by_block.items():
            missed = self._ties.missed_by_drop(unit for unit, _ in several)
            self._units.drop(several, now)
            block = self._blocks.get(key)
            if block is not None and not block.failing:
                self._ties.release(block, missed, DroppedTie, now)
                self._transitions.subside(key)

    def settle(self, block: BMLBlock, constraint: Tie | Precedence) -> None:
        """Have a constraint not be checked any more."""
        block.settled.add(constraint)

    # --- end

    def end_due(self, now: GlobalTime) -> bool:
        """End the blocks and behaviors that are to end by now; whether there were any."""
        failing = [block for block in self._units.touched() if block.failing]
        for block in failing:
            self.fail(block, now)
        cuts = self._units.due_cuts(now)
        for time, unit in cuts:
            cut = self._blocks.get(unit.block)
            if cut is not None and unit in cut.live_units:
                self._cut(cut, [unit], time)
            self._units.forget_cut(unit)
        touched = self._units.touched()
        self._units.forget_touched()
        over = [block for block in touched if block.state.plays and not block.live_units]
        for block in over:
            if not block.state.ended:  # the end of another one may have ended it
                self._finish(block, now)
        for block in touched:  # the end of another block may have dropped what was left before its relax
            self._transitions.subside(block.key)
        return bool(failing or cuts or over)

    def fail(self, block: BMLBlock, now: GlobalTime) -> None:
        """Fail a block: its playing behaviors are cut, and those that have not begun are removed."""
        self._units.remove([unit for unit in block.live_units if not unit.begun], now)
        for unit in block.live_units:
            self._units.cut(unit, now)
        self._transitions.end(block, BlockEvent.FAIL, now)

    def interrupt(
        self,
        block: BMLBlock,
        time: GlobalTime,
        spared: Collection[str] = (),
        speech: InterruptSpeech = InterruptSpeech.NOW,
    ) -> None:
        """Cut a block at a time, after its due points have fired; a block that has not started is revoked.

        Args:
            block: alive.
            time: not after this tick.
            spared: ids of behaviors that continue.
            speech: the point at which a speech ends; unless that is now, other behaviors too may first end what should
                not be cut in the middle.
        """
        if not block.state.plays:
            self._revoke(block, time, spared)
            return
        time = max(time, block.start.value or time)  # it may have started later in this tick
        chosen = [unit for unit in block.live_units if unit.behavior.id not in spared]
        gently = speech is not InterruptSpeech.NOW
        ends = {unit: unit.gentle_end(time, speech) for unit in chosen if gently and unit.begun}
        for unit, last in ends.items():
            if last > time and not is_due(unit.time("end"), last):
                self._units.schedule_cut(unit, ScheduledCut(last, time, speech))
        self._cut(block, [unit for unit in chosen if ends.get(unit, time) <= time], time)

    def _new_block(self, composition: BlockComposition, predecessors: Iterable[Predecessor], entry: Entry) -> BMLBlock:
        description = composition.description
        self._arrivals += 1
        key = BlockKey(composition.character, description.id)
        arrived, client, accompanied = entry.arrived, entry.lane.client, composition.accompanied
        block = BMLBlock(self._board, key, description, self._arrivals, arrived, predecessors, client, accompanied)
        self._blocks.add(block)
        self._feedback.foreign_attributes(key, description, BLOCK_EXTENSIONS)
        return block

    def _keep_from_past(self, block: BMLBlock, now: GlobalTime) -> None:
        """Have a block start now if times from outside have moved its start to before the last tick."""
        if block.start.value is not None and block.start.value < self._board.previous:
            with self._board.graph.transaction(f"put off {block.key.block}"):
                block.release_start((), now)

    def _start(self, block: BMLBlock, now: GlobalTime) -> None:
        time = block.start.value or GlobalTime(0.0)
        plan = self._plans.at_start(block, time, now)
        if block.state.ended:
            return
        with self._board.graph.transaction(f"start {block.key.block}"):
            self._transitions.take(block, BlockEvent.START, time)
            if plan is not None:
                self._plans.replace(block, plan, now)
            for peg in self._board.unnamed(block.key):
                if isinstance(peg, LateTiePeg):
                    peg.start()
        block.started_at = now
        self._units.touch(block.key)
        for unit in block.units:
            unit.release()
        for other in dict.fromkeys(each.block for each in block.predecessors if each.block.only_persists):
            persisting = ", ".join(unit.behavior.id for unit in other.live_units)
            not_awaited = NotAwaited(block=other.key.block, behaviors=persisting)
            self._feedback.warn_element(block.key, block.description, not_awaited)
        for name in block.description.on_start:
            fault = self.activate(block.key.character, name, time)
            if fault is not None:
                self._feedback.warn_element(block.key, block.description, fault)
        for listener in self._start_listeners:
            listener(block)

    def _end_accompaniments(self, ended: BMLBlock) -> None:
        """End the blocks that accompany one that has ended; if it is done, what plays of them may end by itself."""
        time = ended.end.value or self._board.time
        for block in list(ended.accompaniments):
            done = ended.state is BlockState.DONE and block.state.plays
            playing = {unit.behavior.id for unit in block.live_units if done and unit.begun}
            if not done or len(playing) < len(block.live_units):
                self.interrupt(block, time, playing)

    def _finish(self, block: BMLBlock, now: GlobalTime) -> None:
        self._transitions.end(block, BlockEvent.FINISH, now if block.end.value is None else block.end.value)

    def _revoke(self, block: BMLBlock, time: GlobalTime, spared: Collection[str]) -> None:
        """Remove behaviors of a block that has not started, and the block with the last of them."""
        names = {behavior.id for behavior in block.description.behaviors} - block.cancelled
        gone = names.difference(spared)
        block.cancelled |= gone
        units = [unit for unit in block.units if unit.behavior.id in gone]
        self._units.remove(units, time)
        if gone == names:
            self._transitions.end(block, BlockEvent.REVOKE, time)
            self._planner.leave(block)
            return
        with self._board.graph.transaction(f"revoke a part of {block.key.block}"):
            block.units = [unit for unit in block.units if unit not in units]
            if block.state is not BlockState.IN_PREP:
                block.update_end()

    def _cut(self, block: BMLBlock, units: Sequence[PlanUnit], time: GlobalTime) -> None:
        """Cut behaviors of a playing block; the block ends if nothing is left of it."""
        missed = self._ties.missed_by_cut(units, time)
        cut = [self._units.cut(unit, time) for unit in units]
        block.units = [unit for unit in block.units if unit.state is not UnitState.DROPPED]
        if block.live_units:
            with self._board.graph.transaction(f"cut a part of {block.key.block}"):
                block.update_end(time)  # what is left may be past its relax already: the block subsides now
            self._ties.release(block, missed, CutTie, time)
            self._transitions.subside(block.key)
        elif any(cut):
            self._transitions.end(block, BlockEvent.INTERRUPT, time)
        else:
            self._finish(block, time)
