"""The life of blocks: accepted, prepared, planned, started, ended, interrupted (thesis 7.3.4)."""

from collections.abc import Callable, Iterable, Sequence

from reactive_realizer.bml.block import BehaviorBlock, Parsed
from reactive_realizer.bml.procedure import DefineProc
from reactive_realizer.bml.words import Composition
from reactive_realizer.clock.units import RESOLUTION, GlobalTime, Time, is_due
from reactive_realizer.engine.effects import Play
from reactive_realizer.errors import Fault, RealizerError, error
from reactive_realizer.feedback.feedback_manager import FeedbackManager
from reactive_realizer.limits import Limits
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.reactive.commit import Commit
from reactive_realizer.scheduler.admission import Admission
from reactive_realizer.scheduler.block_planner import BlockPlanner
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BlockState, BMLBlock, Wait
from reactive_realizer.scheduler.cast import Cast
from reactive_realizer.scheduler.concerned import concerned
from reactive_realizer.scheduler.endings import Endings
from reactive_realizer.scheduler.joining import Joining
from reactive_realizer.scheduler.planning import PlanListener, Planning
from reactive_realizer.scheduler.predictions import Predictions
from reactive_realizer.scheduler.problem import Loss
from reactive_realizer.scheduler.procedures import Procedures
from reactive_realizer.scheduler.reporter import Reporter
from reactive_realizer.scheduler.requests import Requests
from reactive_realizer.scheduler.standstill import awaited_by, can_move, times_ahead
from reactive_realizer.scheduler.strategy import SchedulingStrategy
from reactive_realizer.scheduler.workshop import Workshop


class BMLScheduler:
    """Owns the blocks of all characters and keeps their constraints (thesis 7.25-7.27).

    Attributes:
        refused: how many blocks were not accepted.
    """

    def __init__(
        self,
        board: PegBoard,
        cast: Cast,
        feedback: FeedbackManager,
        workshop: Workshop,
        strategy: SchedulingStrategy,
        limits: Limits,
    ) -> None:
        self.blocks = Blocks(limits.remembered_blocks)
        self.refused = 0
        self._board = board
        self._cast = cast
        self._limits = limits
        self._reporter = Reporter(feedback, self.blocks)
        self._planning = Planning(board, self.blocks, strategy)
        self._planner = BlockPlanner(cast, self.blocks, self._planning, workshop, self._reporter)
        self._procedures = Procedures(cast, workshop)
        self._predictions = Predictions(feedback)
        self._endings = Endings(board, cast, self.blocks, self._reporter, self._predictions)
        self._requests = Requests(board, self.blocks, self._planner, self._endings, self._reporter)
        self._arrivals = 0
        self._moved: set[BlockKey | None] = set()
        board.graph.listen(self._note)

    @property
    def failed(self) -> int:
        """How many blocks ended FAILED."""
        return self._endings.failed

    def listen(self, listener: Callable[[BlockKey], None]) -> None:
        """Call ``listener(block)`` when a block has ended, while its points are still on the board."""
        self._endings.listen(listener)

    def listen_to_plans(self, listener: PlanListener) -> None:
        """Call ``listener(block, problem, solution)`` of each plan that was committed."""
        self._planning.listen(listener)

    def explain(self, character: str, name: str) -> dict[str, object]:
        """Why each point of a block alive is when it is, as objects that `json.dumps` takes.

        Raises:
            RealizerError: "block-ended", "no-such-block".
        """
        block = self.blocks.find(character, name)
        if block is None:
            raise error("block-ended" if self.blocks.has_ended(character, name) else "no-such-block", block=name)
        return {**block.key._asdict(), "points": self._board.explain_block(block.key)}

    # --- what comes in

    def accept(self, parsed: Parsed, now: GlobalTime) -> None:
        """Take a block in: apply its composition, prepare and plan its behaviors."""
        character = self._character(parsed.block)
        for problem in parsed.problems:
            self._reporter.warn(character, problem.id, problem.fault)
        try:
            if parsed.procedure is not None:
                self._define(parsed.procedure)
            elif parsed.block is not None:
                self._admit(parsed.block, parsed.failed, character, now)
            else:
                self.refused += 1
        except RealizerError as refused:
            self.refused += 1
            self._refuse(refused.fault, parsed.block or parsed.procedure, character)

    def admission(self, defined: Iterable[str] = ()) -> Admission:
        """Judges blocks and procedures that would enter now; nothing changes here.

        Args:
            defined: ids of procedures that enter before.
        """
        alive = (block.key for block in self.blocks.alive)
        return Admission(self._cast.characters, self._limits, alive, (*self._procedures.names, *defined))

    # --- what time brings

    def advance(self, now: GlobalTime) -> bool:
        """Plan what is prepared, end and start what is due, in order of time; whether anything started or ended."""
        self._plan_prepared(now)
        failing = [block for block in self.blocks.alive if block.failing]
        for block in failing:
            self._endings.fail(block, now)
        cut = self._endings.cut_due(now)
        ending = [block for block in self.blocks.alive if block.state.plays and not block.live_units]
        for block in ending:
            self._endings.end(block, BlockState.DONE, now if block.end.value is None else block.end.value)
        starting = [block for block in self.blocks.alive if block.may_start and is_due(block.start.value, now)]
        for block in sorted(starting, key=lambda b: (b.start.value, b.arrival)):
            self._start(block, now)
        return bool(failing or cut or ending or starting)

    def next_due(self, after: GlobalTime) -> Time:
        """When, after a time, something is to happen next, as far as that is known now; None where nothing is."""
        times = (time for block in self.blocks.alive for time in times_ahead(block))
        return min((time for time in times if not is_due(time, after)), default=None)

    def apply(self, plays: Sequence[Play], now: GlobalTime) -> bool:
        """Do what the playing of engines asks for, in their order; whether anything changed."""
        for play in plays:
            for dropped in play.dropped:
                self._endings.drop(dropped, now)
            if play.reached:
                self._endings.reach(play.reached)
        asked = self._requests.do([request for play in plays for request in play.requests], now)
        return asked or any(play.dropped or play.reached for play in plays)

    def clamp(self, previous: GlobalTime, now: GlobalTime, commits: Iterable[Commit]) -> None:
        """Points ahead, of blocks that play, that were written into the past happen now."""
        moved = {change.cell for commit in commits for change in commit.changes}
        blocks = [block for block in concerned(self.blocks, self._board, moved) if block.state.plays]
        units = [u for block in blocks for u in block.live_units if any(p.peg in moved for p in u.points)]
        if not units:
            return
        with self._board.graph.transaction("no later than now"):
            for point in sorted((point for unit in units for point in unit.ahead()), key=lambda p: p.peg.rank):
                # Upstream first: one that is brought to now may bring those that hang on it.
                time = point.peg.value
                if point.peg in moved and time is not None and time < previous:
                    point.peg.pin(now)

    def fail_restless(self, rounds: int, now: GlobalTime) -> None:
        """Fail the blocks that keep a tick from coming to rest: those that started in it and still play."""
        for block in [block for block in self.blocks.alive if block.state.plays and block.noticed == now]:
            self._reporter.warn(block.key.character, block.key.block, Fault("too-many-rounds", {"limit": rounds}))
            self._endings.fail(block, now)

    def publish(self, now: GlobalTime) -> None:
        """Say predictions that have moved."""
        moved, self._moved = self._moved, set()
        for block in self.blocks.alive if moved else ():
            if block.key in moved:
                self._predictions.publish(block, now)

    def stuck(self, now: GlobalTime) -> bool:
        """Whether, after the tick at ``now``, no block alive can move unless something new comes in."""
        return not any(can_move(block, now) for block in self.blocks.alive)

    def warn_stuck(self) -> None:
        """Say of every block alive what it waits for."""
        for block in self.blocks.alive:
            fault = Fault("never-moves", {"waits": ", ".join(awaited_by(block))})
            self._reporter.warn(block.key.character, block.key.block, fault)

    # --- accepting

    def _define(self, definition: DefineProc) -> None:
        """Keep a procedure.

        Raises:
            RealizerError: why it is refused.
        """
        fault = self.admission().define(definition)
        if fault is not None:
            raise RealizerError(fault)
        self._procedures.define(definition)

    def _admit(self, written: BehaviorBlock, failed: bool, character: str, now: GlobalTime) -> None:
        """Make a block of it.

        Raises:
            RealizerError: why it is refused.
        """
        fault = self.admission().take(written)
        if fault is not None:
            raise RealizerError(fault)
        description = self._procedures.expand(written)
        joining = Joining(self.blocks, character, description)
        if (fault := joining.refusal()) is not None:
            self._turn_away(fault, description, character, now)
            return
        # Before anything of the new block is known to others.
        for other in joining.ended_by_it():
            self._requests.interrupt(other, now)
        if description.composition is Composition.REPLACE:
            self._cast.reset(character, now)
        block = self._new_block(description, character, joining.waits(), now)
        with self._board.graph.transaction(f"put {description.id} before others"):
            joining.push_back(block)
        for fault in joining.unknown:
            self._reporter.warn(character, description.id, fault)
        if failed:
            self._endings.end(block, BlockState.FAILED, now)
        else:
            self._prepare(block, now)

    def _turn_away(self, fault: Fault, description: BehaviorBlock, character: str, now: GlobalTime) -> None:
        """A block cannot stand where it wants to.

        Whoever brought it may have been told at the door, where nobody could know, that it is accepted: so it ends.

        Raises:
            RealizerError: the fault, if there is a block of that name already.
        """
        if self.blocks.get(BlockKey(character, description.id)) is not None:
            raise RealizerError(fault)
        self._refuse(fault, description, character)
        self._endings.end(self._new_block(description, character, (), now), BlockState.FAILED, now)

    def _refuse(self, fault: Fault, written: BehaviorBlock | DefineProc | None, character: str) -> None:
        if written is not None:
            place = written.location
            self._reporter.warn(character, written.id, fault.located(place.line, place.column))

    def _character(self, block: BehaviorBlock | None) -> str:
        return (block and block.character) or self._cast.characters[0]

    def _new_block(
        self, description: BehaviorBlock, character: str, waits: Iterable[Wait], now: GlobalTime
    ) -> BMLBlock:
        self._arrivals += 1
        key = BlockKey(character, description.id)
        block = BMLBlock(self._board, key, description, self._arrivals, now, waits)
        self.blocks.add(block)
        self._reporter.meaningless(block, description.extensions, description)
        return block

    # --- planning

    def _prepare(self, block: BMLBlock, now: GlobalTime) -> None:
        prepared = self._procedures.preparation(block.key.character, block.description)
        if not self._lost(block, self._planner.prepare(block, prepared), now):
            self._owe_prediction(block)

    def _plan_prepared(self, now: GlobalTime) -> None:
        for block, draft in self._planner.drafts(now):
            if not self._lost(block, draft.losses, now):
                self._planner.commit(block, draft, now)
                self._owe_prediction(block)

    def _lost(self, block: BMLBlock, losses: Sequence[Loss], now: GlobalTime) -> bool:
        """Warn of what was lost; whether the block fails by it."""
        self._reporter.lost(block, losses)
        fails = any(loss.required for loss in losses)
        if fails:
            self._endings.end(block, BlockState.FAILED, now)
        return fails

    # --- starting

    def _start(self, block: BMLBlock, now: GlobalTime) -> None:
        time = block.start.value or GlobalTime(0.0)
        with self._board.graph.transaction(f"start {block.key.block}"):
            block.start.pin(time)
            if _wants_renewal(block, time):
                self._planner.renew(block, time, now)
        block.state = BlockState.IN_EXEC
        block.noticed = now
        for unit in list(block.units):
            unit.release()
            if unit.over_before(time):
                self._endings.drop_past(unit, Fault("all-past", {"late": time - (unit.time("end") or 0.0)}), now)
        self._owe_prediction(block)
        self._reporter.started(block, time)
        if block.failing:
            self._endings.fail(block, now)
            return
        self._reporter.unawaited(block)
        for name in block.description.on_start:
            fault = self._requests.activate(block.key.character, name, time)
            if fault is not None:
                place = block.description.location
                self._reporter.warn(block.key.character, block.key.block, fault.located(place.line, place.column))

    def _owe_prediction(self, block: BMLBlock) -> None:
        self._moved.add(block.key)
        self._predictions.owe(block)

    def _note(self, commit: Commit) -> None:
        self._moved.update(self._board.owner(change.cell) for change in commit.changes)


def _wants_renewal(block: BMLBlock, start: GlobalTime) -> bool:
    """Whether a block had better be planned anew when it starts.

    It is a chunk, whose preparations depend on where the hands are; or something of it has come to lie before its
    start, because times from outside are no more what they were when it was planned.
    """
    times = (point.peg.value for unit in block.units for point in unit.points)
    early = any(time is not None and time < start - RESOLUTION for time in times)
    return early or any(wait.chunk for wait in block.waits)
