"""The scheduler: takes blocks in, and has them planned, started, played and ended tick by tick (thesis 7.3.4)."""

from collections.abc import Callable, Iterable, Sequence

from reactive_realizer.bml.block import BehaviorBlock, DefineProc, Parsed
from reactive_realizer.clock.units import GlobalTime, Time, is_due
from reactive_realizer.engine.effects import Play
from reactive_realizer.errors import Fault, PlayingFault, RealizerError, SchedulingFault
from reactive_realizer.feedback.feedback_manager import FeedbackManager
from reactive_realizer.limits import Limits
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.reactive.graph import Commit
from reactive_realizer.scheduler.admission import Admission
from reactive_realizer.scheduler.block_composition import BlockComposition
from reactive_realizer.scheduler.block_feedback import BlockFeedback
from reactive_realizer.scheduler.block_lifecycle import BlockLifecycle
from reactive_realizer.scheduler.block_planner import BlockPlanner
from reactive_realizer.scheduler.block_state import BlockState
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.constraint_monitor import ConstraintMonitor
from reactive_realizer.scheduler.engine_routing import EngineRouting
from reactive_realizer.scheduler.planning import PlanListener, Planning
from reactive_realizer.scheduler.predictions import Predictions
from reactive_realizer.scheduler.preparation import BackgroundWork
from reactive_realizer.scheduler.procedures import Procedures
from reactive_realizer.scheduler.requests import EngineRequests
from reactive_realizer.scheduler.strategy import SchedulingStrategy


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
    """Conducts the blocks of all characters (thesis 7.25-7.27).

    Attributes:
        blocks: those alive, and what is remembered of those that ended.
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
        self._predictions = Predictions(feedback, board)
        self._procedures = Procedures(routing, background)
        self._planning = Planning(board, self.blocks, strategy)
        self._planner = BlockPlanner(routing, self.blocks, self._planning, self._procedures, background, self._feedback)
        self._lifecycle = BlockLifecycle(
            board, routing, self.blocks, self._planner, self._planning, self._feedback, self._predictions
        )
        self._requests = EngineRequests(self.blocks, self._lifecycle, self._feedback)
        self._monitor = ConstraintMonitor(board, self.blocks, self._lifecycle, self._feedback)
        self._lifecycle.listen(self._count)

    def listen(self, listener: Callable[[BMLBlock], None]) -> None:
        """Call ``listener(block)`` when a block has ended, while its points are still on the board."""
        self._lifecycle.listen(listener)

    def listen_to_plans(self, listener: PlanListener) -> None:
        """Call ``listener(block, problem, solution)`` of each plan that is committed."""
        self._planning.listen(listener)

    def explain(self, character: str, name: str) -> dict[str, object]:
        """Why each point of a block alive is when it is, as objects that `json.dumps` takes.

        Raises:
            RealizerError: "block-ended", "no-such-block".
        """
        block = self.blocks.find(character, name)
        if block is None:
            raise RealizerError(self.blocks.missing(character, name))
        return {**block.key._asdict(), "points": self._board.explain_block(block.key)}

    # --- blocks and procedures that enter

    def accept(self, parsed: Parsed, now: GlobalTime) -> None:
        """Take in what was read: a block, a procedure, or nothing but problems."""
        character = (parsed.block and parsed.block.character) or self._routing.characters[0]
        for problem in parsed.problems:
            self._feedback.warn(character, problem.id, problem.fault)
        try:
            if parsed.procedure is not None:
                self._define(parsed.procedure)
            elif parsed.block is not None:
                self._admit(parsed.block, parsed.failed, character, now)
            else:
                self.refused += 1
        except RealizerError as refusal:
            self.refused += 1
            self._warn_refused(character, parsed.block or parsed.procedure, refusal.fault)

    def admission(self, defined: Iterable[str] = ()) -> Admission:
        """Admission control for blocks and procedures that would enter now; nothing changes here.

        Args:
            defined: ids of procedures that enter before.
        """
        alive = (block.key for block in self.blocks.alive)
        return Admission(self._routing.characters, self._limits, alive, (*self._procedures.names, *defined))

    # --- a tick

    def advance(self, now: GlobalTime) -> bool:
        """Plan what is prepared, then end and start what is due; whether anything started or ended."""
        for block, plan in self._planner.plans(now):
            self._lifecycle.plan(block, plan, now)
        ended = self._lifecycle.end_due(now)
        return self._lifecycle.start_due(now) or ended

    def next_due(self, after: GlobalTime) -> Time:
        """The earliest known time after ``after`` at which something is to happen; None where there is none."""
        times = (time for block in self.blocks.alive for time in block.times_ahead)
        return min((time for time in times if not is_due(time, after)), default=None)

    def apply(self, plays: Sequence[Play], now: GlobalTime) -> bool:
        """Apply what the engines played, in their order; whether anything changed."""
        for play in plays:
            for dropped in play.dropped:
                self._lifecycle.drop_behavior(dropped.unit, dropped.fault, now)
            if play.reached:
                self._lifecycle.sync_points_reached(play.reached)
        asked = self._requests.carry_out([each for play in plays for each in play.requests], now)
        return asked or any(play.dropped or play.reached for play in plays)

    def fail_restless(self, rounds: int, now: GlobalTime) -> None:
        """Fail the blocks that keep a tick from coming to rest: those that started in it and still play."""
        for block in [block for block in self.blocks.alive if block.state.plays and block.started_at == now]:
            self._feedback.warn(block.key.character, block.key.block, TooManyRounds(limit=rounds))
            self._lifecycle.fail(block, now)

    def publish(self, now: GlobalTime) -> None:
        """Report the predictions that have moved."""
        self._predictions.publish(self.blocks.alive, now)

    def check(self, commits: Iterable[Commit], now: GlobalTime) -> None:
        """Warn of the constraints that the commits of a tick have broken."""
        self._monitor.check(commits, now)

    # --- the end of a session

    def stuck(self, now: GlobalTime) -> bool:
        """Whether, after the tick at ``now``, no block alive can move unless something new comes in."""
        return not any(block.can_progress(now) for block in self.blocks.alive)

    def warn_stuck(self) -> None:
        """Warn of every block alive, and name what it waits for."""
        for block in self.blocks.alive:
            fault = NeverMoves(waits=", ".join(block.awaited))
            self._feedback.warn(block.key.character, block.key.block, fault)

    def _count(self, ended: BMLBlock) -> None:
        self.failed += ended.state is BlockState.FAILED

    # --- accepting

    def _define(self, definition: DefineProc) -> None:
        """Keep a procedure.

        Raises:
            RealizerError: why it is refused.
        """
        fault = self.admission().admit_procedure(definition)
        if fault is not None:
            raise RealizerError(fault)
        self._procedures.define(definition)

    def _admit(self, written: BehaviorBlock, failed: bool, character: str, now: GlobalTime) -> None:
        """Begin the life of a block.

        Raises:
            RealizerError: why it is refused.
        """
        fault = self.admission().admit(written)
        if fault is not None:
            raise RealizerError(fault)
        composition = BlockComposition(self.blocks, character, self._procedures.expand(written))
        fault = composition.fault()
        if fault is None:
            self._lifecycle.accept(composition, failed, now)
        elif self.blocks.get(BlockKey(character, written.id)) is not None:
            raise RealizerError(fault)
        else:
            self._warn_refused(character, written, fault)
            self._lifecycle.accept_failed(composition, now)

    def _warn_refused(self, character: str, written: BehaviorBlock | DefineProc | None, fault: Fault) -> None:
        if written is not None:
            self._feedback.warn(character, written.id, fault, written.location)
