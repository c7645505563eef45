"""The scheduler: takes blocks in, and has them planned, started, played and ended tick by tick (thesis 7.3.4)."""

from collections.abc import Iterable, Iterator, Mapping, Sequence

from reactive_realizer.bml.block import BehaviorBlock, Parsed
from reactive_realizer.clock.ticker import next_tick
from reactive_realizer.clock.units import GlobalTime, Time, is_due
from reactive_realizer.embodiment.audio import AudioHeard
from reactive_realizer.engine.effects import Play
from reactive_realizer.engine.hearing import HearingEngine
from reactive_realizer.errors import Fault, PlayingFault, RealizerError, SchedulingFault
from reactive_realizer.feedback.feedback_manager import FeedbackManager
from reactive_realizer.limits import Limits
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.scheduler.admission import Admission, TooManyOfOne
from reactive_realizer.scheduler.block_composition import BlockComposition
from reactive_realizer.scheduler.block_feedback import BlockFeedback
from reactive_realizer.scheduler.block_lifecycle import BlockLifecycle, BlockListener, PointListener
from reactive_realizer.scheduler.block_planner import BlockPlanner
from reactive_realizer.scheduler.block_solver import BlockSolver
from reactive_realizer.scheduler.block_state import BlockState
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.constraint_monitor import ConstraintMonitor
from reactive_realizer.scheduler.engine_routing import EngineRouting
from reactive_realizer.scheduler.entry_queue import Entry, EntryQueue
from reactive_realizer.scheduler.lanes import ACCOMPANIST, Lane, LaneTurns
from reactive_realizer.scheduler.planned_events import PlannedEvents
from reactive_realizer.scheduler.planning import PlanListener, Planning
from reactive_realizer.scheduler.predictions import Predictions
from reactive_realizer.scheduler.preparation import BackgroundWork
from reactive_realizer.scheduler.procedures import Procedures
from reactive_realizer.scheduler.requests import EngineRequests
from reactive_realizer.scheduler.strategy import SchedulingStrategy
from reactive_realizer.scheduler.unfinished_units import UnfinishedUnits

_ENTRY = 60
"""Work of an entry without behaviors, and of planning it, as the planner counts work."""

_MOST_WAITING = 5
"""Blocks of a lane that can be planned while further ones enter."""


class NeverMoves(SchedulingFault):
    """A block that would wait forever at the end of a session."""

    code = "never-moves"
    template = "it is still waiting for {waits}, but nothing more can happen"
    waits: str


class TooManyRounds(PlayingFault):
    """A tick in which engines keep requesting changes."""

    code = "too-many-rounds"
    template = "the tick did not settle within {limit} rounds"
    limit: int


class BMLScheduler:
    """Schedules the blocks of all characters (thesis 7.25-7.27).

    Attributes:
        blocks: those that are alive, and records of those that ended.
        refused: how many blocks were not accepted.
        failed: how many blocks ended FAILED.
    """

    def __init__(
        self,
        board: PegBoard,
        routing: EngineRouting,
        feedback: FeedbackManager,
        background: BackgroundWork,
        strategy: SchedulingStrategy,
        limits: Limits,
    ) -> None:
        self.blocks = Blocks(limits.remembered_blocks)
        self.refused = self.failed = 0
        self._board = board
        self._routing = routing
        self._limits = limits
        self._feedback = BlockFeedback(feedback, self.blocks)
        self._predictions = Predictions(feedback, self.blocks.watch, limits)
        self._procedures = Procedures(routing, background)
        solver = BlockSolver(strategy)
        self._planning = Planning(board, self.blocks, solver)
        self._entries = EntryQueue(routing.characters)
        self._planner = BlockPlanner(
            routing,
            self.blocks,
            self._planning,
            solver,
            self._procedures,
            background,
            self._feedback,
            self._entries,
            limits,
        )
        self._turns = LaneTurns()
        self._left = 0
        self._lifecycle = BlockLifecycle(
            board, routing, self.blocks, self._planner, self._planning, self._feedback, self._predictions
        )
        self._unfinished = UnfinishedUnits(self._lifecycle)
        self._events = PlannedEvents(board)
        self._requests = EngineRequests(self.blocks, self._lifecycle, self._feedback)
        self._monitor = ConstraintMonitor(self.blocks.watch, self._lifecycle, self._feedback)
        self._hearing = [engine for engine in routing.engines if isinstance(engine, HearingEngine)]
        self._lifecycle.listen(self._count)

    def listen(self, listener: BlockListener) -> None:
        """Call ``listener(block)`` when a block has ended, while its points are still on the board."""
        self._lifecycle.listen(listener)

    def listen_to_points(self, listener: PointListener) -> None:
        """Call ``listener(reached)`` with the points that are reached together, after they are pinned."""
        self._lifecycle.listen_to_points(listener)

    def listen_to_starts(self, listener: BlockListener) -> None:
        """Call ``listener(block)`` when a block has started."""
        self._lifecycle.listen_to_starts(listener)

    def listen_to_plans(self, listener: PlanListener) -> None:
        """Call ``listener(block, problem, solution)`` of each plan that is committed."""
        self._planning.listen(listener)

    def explain(self, character: str, name: str) -> tuple[BlockKey, Iterator[tuple[str, object]]]:
        """The name of a block that is alive, and its points with their explanations (`PegBoard.explain_block`).

        Raises:
            RealizerError: "block-ended", "no-such-block".
        """
        block = self.blocks.find(character, name)
        if block is None:
            raise RealizerError(self.blocks.missing(character, name))
        return block.key, self._board.explain_block(block.key)

    # --- blocks and procedures that enter

    @property
    def entering(self) -> tuple[Entry, ...]:
        """What has arrived and has not entered yet, in order of arrival."""
        return self._entries.waiting

    @property
    def unplanned(self) -> int:
        """The number of blocks and procedures that wait to enter or to be planned."""
        return len(self.entering) + sum(map(self._planner.waiting, self._planner.lanes))

    def take(self, document: Iterable[Parsed], client: str = "") -> None:
        """Have the blocks and procedures of a client's document enter, in this tick as far as there is time."""
        admission = self.admission()
        for entry in self.entering if client else ():
            admission.refusal(entry.parsed, entry.lane.client)
        for parsed in document:
            # Only at its arrival is it known what others have; the rest is judged when it enters.
            fault = admission.refusal(parsed, client) if client else None
            refusal = fault if isinstance(fault, TooManyOfOne) else None
            self._turns.add(self._entries.add(parsed, client, self._board.time, refusal))

    def accompany(self, block: BehaviorBlock) -> None:
        """Have a block of the realizer itself enter, which gives way to others, behind the blocks of all clients."""
        self._turns.add(self._entries.add(Parsed(block), ACCOMPANIST, self._board.time))

    def is_expected(self, id_: str) -> bool:
        """Whether a block with an id has arrived and not entered yet."""
        return id_ in self._entries

    def withdraw(self, character: str, id_: str, now: GlobalTime) -> bool:
        """Interrupt a block of the realizer itself, if it is alive; whether it has entered."""
        block = self.blocks.get(BlockKey(character, id_))
        if block is not None and block.client == ACCOMPANIST:
            self._lifecycle.interrupt(block, now)
        return id_ not in self._entries

    def begin_planning(self) -> None:
        """Begin a tick: there is time for planning again, less what the ticks before have done too much."""
        self._left = min(self._left, 0) + self._limits.planning_per_tick
        for lane in tuple(self._turns):
            if lane not in self._entries.lanes and lane not in self._planner.lanes:
                self._turns.remove(lane)

    def _work(self, now: GlobalTime) -> None:
        """Have blocks enter and plan them, one step for each lane in turn, until the work of a tick is done.

        Blocks that enter come first, but not too many of them, because each plan moves those that come after.
        """
        while self._left > 0 and (lane := self._next_lane()) is not None:
            self._turns.take(lane)
            entry = self._entries.first(lane)
            if entry is not None and self._has_room(entry):
                self._entries.remove(entry)
                self._accept(entry, now)
                written = entry.parsed.written
                behaviors = 0 if written is None else len(written.behaviors)
                self._left -= _ENTRY + len(entry.parsed.problems) + behaviors
            else:
                self._plan(lane, now)

    def _next_lane(self) -> Lane | None:
        """The next lane that has something to enter or to be planned."""
        if not self._entries and not self._planner:
            return None
        runnable = (lane for lane in self._turns if self._planner.waiting(lane) or self._entries.first(lane))
        lane = next(runnable, None)
        if lane is None or lane.client != ACCOMPANIST:
            return lane
        return next((other for other in runnable if other.client != ACCOMPANIST), lane)

    def _has_room(self, entry: Entry) -> bool:
        """Whether an entry should enter before others are planned; those that end before they play need no plan."""
        return self._planner.waiting(entry.lane) < _MOST_WAITING or self._entries.is_replaced(entry)

    def _plan(self, lane: Lane, now: GlobalTime) -> None:
        work, planned = self._planner.step(lane)
        self._left -= work
        if planned is not None:
            # To start a block takes as long as to put it on the board: a big one does not do both in one tick.
            floor = now if work <= self._limits.planning_per_tick else next_tick(now)
            preparation = self._planner.preparation(planned.block)
            self._lifecycle.plan(*planned, now, floor)
            self._unfinished.add(planned.block, preparation, now)
            self._events.add(planned.block.units)

    def _accept(self, entry: Entry, now: GlobalTime) -> None:
        """Accept a block or a procedure, or refuse it, and report the problems of its document."""
        parsed, character = entry.parsed, entry.character
        for problem in parsed.problems:
            self._feedback.warn(character, problem.id, problem.fault)
        fault = None
        if parsed.procedure is not None:
            fault = self.admission().admit_procedure(parsed.procedure)
            if fault is None:
                self._procedures.define(parsed.procedure)
        elif parsed.block is not None and entry.lane.client == ACCOMPANIST:
            self._admit_own(parsed.block, entry, now)
        elif parsed.block is not None:
            fault = self._admit(parsed.block, entry, now)
        written = parsed.written
        if fault is not None or written is None:
            self.refused += 1
        if fault is not None and written is not None:
            self._feedback.warn(character, written.id, fault, written.location)
        if parsed.block is not None:
            self._planner.entered(parsed.block.id)

    def admission(self, defined: Mapping[str, int] | None = None) -> Admission:
        """Admission control for further blocks and procedures.

        Args:
            defined: the numbers of behaviors of procedures that are defined before, by id.
        """
        sizes = {**self._procedures.sizes, **defined} if defined else self._procedures.sizes
        return Admission(self._routing.characters, self._limits, self.blocks, sizes)

    # --- a tick

    def advance(self, now: GlobalTime) -> bool:
        """Have blocks enter and plan them, then end and start those that are due; whether anything started or ended."""
        self._work(now)
        self._unfinished.play(now)
        ended = self._lifecycle.end_due(now)
        self._events.predict(now)
        return self._lifecycle.start_due(now) or ended

    def check_heard(self, heard: AudioHeard) -> bool:
        """Whether a report of what is heard is about a sound that plays now.

        Raises:
            RealizerError: the report cannot be true.
        """
        return any(engine.check_heard(heard) for engine in self._hearing)

    def follow_heard(self, heard: AudioHeard) -> None:
        """Have the behavior of a sound, and what is tied to it, follow what is heard (thesis 8.17)."""
        for engine in self._hearing:
            if (drift := engine.hear(heard)) is not None:
                self._lifecycle.shift_behavior(drift.unit, drift.seconds)

    @property
    def next_start(self) -> Time:
        """The earliest known time at which a block starts; None if there is none."""
        return self.blocks.starting.next_due

    def next_due(self, after: GlobalTime) -> Time:
        """The earliest known time after ``after`` at which a block has something to do; None if there is none.

        It looks at all blocks.
        """
        times = (time for block in self.blocks.alive for time in block.times_ahead)
        return min((time for time in times if not is_due(time, after)), default=None)

    def apply(self, plays: Sequence[Play], now: GlobalTime) -> bool:
        """Apply the effects of engines, in their order; whether anything changed."""
        if not plays:
            return False
        for play in plays:
            self._lifecycle.drop_behaviors(play.dropped, now)
            if play.reached:
                self._lifecycle.sync_points_reached(play.reached)
        asked = self._requests.carry_out([each for play in plays for each in play.requests], now)
        return asked or any(play.dropped or play.reached for play in plays)

    def fail_restless(self, rounds: int, now: GlobalTime) -> None:
        """Fail the blocks that keep a tick from settling: those that started in it and still play."""
        for block in [block for block in self.blocks.alive if block.state.plays and block.started_at == now]:
            self._feedback.warn(block.key.character, block.key.block, TooManyRounds(limit=rounds))
            self._lifecycle.fail(block, now)

    def publish(self, now: GlobalTime) -> None:
        """Report the predictions that have moved."""
        self._predictions.publish(now)

    def check(self, now: GlobalTime) -> None:
        """Warn of the constraints that have been broken in a tick."""
        self._monitor.check(now)

    # --- the end of a session

    def stuck(self, now: GlobalTime) -> bool:
        """Whether, after the tick at ``now``, no block can progress without further input, and all is reported."""
        return not self._predictions.waiting and not any(block.can_progress(now) for block in self.blocks.asked_for)

    def warn_stuck(self) -> None:
        """Warn of every block that is alive, and of the points that it waits for, unless it only persists."""
        for block in self.blocks.asked_for:
            if block.only_persists:
                continue
            fault = NeverMoves(waits=", ".join(block.awaited))
            self._feedback.warn(block.key.character, block.key.block, fault)

    def _count(self, ended: BMLBlock) -> None:
        self.failed += ended.state is BlockState.FAILED

    def _admit_own(self, written: BehaviorBlock, entry: Entry, now: GlobalTime) -> None:
        """Begin the life of a block of the realizer itself, unless its id is in use or it accompanies nothing alive."""
        composition = BlockComposition(self.blocks, entry.character, written)
        if composition.fault() is None and self.blocks.get(BlockKey(entry.character, written.id)) is None:
            self._lifecycle.accept(composition, entry, now)

    def _admit(self, written: BehaviorBlock, entry: Entry, now: GlobalTime) -> Fault | None:
        """Begin the life of a block; the fault if it is refused."""
        character = entry.character
        fault = entry.fault or self.admission().admit(written)
        if fault is not None:
            return fault
        composition = BlockComposition(self.blocks, character, self._procedures.expand(written))
        fault = composition.fault()
        if fault is None:
            self._lifecycle.accept(composition, entry, now)
        elif self.blocks.get(BlockKey(character, written.id)) is not None:
            return fault
        else:
            self._feedback.warn(character, written.id, fault, written.location)
            self._lifecycle.accept_failed(composition, entry, now)
        return None
