"""Plans accepted blocks: engines prepare and make the units of their behaviors, and the strategy times them."""

import asyncio
import logging
from collections.abc import Callable, Collection, Container, Generator, Iterable, Mapping, Sequence
from functools import partial
from itertools import count
from typing import NamedTuple

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.names import BML, BML_EXT
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.answer_checks import expected
from reactive_realizer.engine.asking_client import asked_by
from reactive_realizer.engine.faults import UnknownParameter
from reactive_realizer.errors import CreationFault, Fault, RealizerError, SchedulingFault, WarningType
from reactive_realizer.limits import Limits
from reactive_realizer.pegboard.time_peg import TimeCell
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.scheduler.block_feedback import BlockFeedback
from reactive_realizer.scheduler.block_problem import BlockProblem, item_of
from reactive_realizer.scheduler.block_solver import BlockSolver
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BMLBlock, Meant
from reactive_realizer.scheduler.engine_routing import EngineRouting, Result, RoutedBehavior
from reactive_realizer.scheduler.faults import WorkFailed
from reactive_realizer.scheduler.lanes import Lane
from reactive_realizer.scheduler.plan import Plan
from reactive_realizer.scheduler.planning import Planning
from reactive_realizer.scheduler.planning_queue import PlanningQueue
from reactive_realizer.scheduler.preparation import BackgroundWork, Preparation
from reactive_realizer.scheduler.problem import Item
from reactive_realizer.scheduler.procedures import Procedures
from reactive_realizer.scheduler.solution import Loss, lost_behavior

logger = logging.getLogger(__name__)

_MOST_AT_ONCE, _MOST_POINTS_AT_ONCE = 50, 500
"""Behaviors and sync points of a block that is solved on the event loop; a bigger block is solved in a thread."""

_LOSS = 6
"""Work of reporting what was lost in a plan."""

_REFUSAL = 8
"""Work of a behavior of which no unit can be made."""

_MOST_OFTEN = 3
"""Solutions of one block. If times still move then, the last one is committed: its pegs follow them."""


class NotSupported(Fault):
    """A behavior of BML that no engine plays."""

    code = "not-supported"
    template = "<{element}> is not supported and is left out"
    warning = WarningType.BEHAVIOR_TYPE_NOT_SUPPORTED
    element: str


class ForeignNotSupported(Fault):
    """A behavior of another namespace that no engine plays."""

    code = "foreign-not-supported"
    template = "<{element}> of {namespace} is left out: no engine and no entry of a binding plays it"
    warning = WarningType.CUSTOM_BEHAVIOUR_NOT_SUPPORTED
    element: str
    namespace: str


class DescriptionLeftOut(CreationFault):
    """A description of a behavior that cannot be played."""

    code = "description-left-out"
    template = "one of its descriptions is replaced by the next: {reason}"
    reason: str


class TooManyPoints(SchedulingFault):
    """A block with more sync points than the limit allows."""

    code = "too-many-points"
    template = "it has more than {limit} sync points, so it fails"
    limit: int


class Planned(NamedTuple):
    """A block that is planned, with its plan, or the loss for which it fails."""

    block: BMLBlock
    outcome: Plan | Loss


class _Draft:
    """A block while it is planned.

    Attributes:
        steps: what is left to do; each step gives the work that it took.
        posed: its problem; None until it is posed.
        meant: when it was meant before it was posed.
        outcome: its plan, or the loss for which it fails; None until it is planned.
        renamed: whether pegs that the problem names were replaced.
        cancel: cancels the work of a thread; None while there is none.
    """

    def __init__(self, steps: Generator[int]) -> None:
        self.steps = steps
        self.posed: BlockProblem | None = None
        self.outcome: Plan | Loss | None = None
        self.meant: Meant | None = None
        self.renamed = False
        self.cancel: Callable[[], None] | None = None


class BlockPlanner:
    """Prepares blocks in parallel, and plans them in order of arrival, in steps.

    The work of a step is counted in sync points that are made, placed or put on pegs: it takes about 7 us each on the
    machine of docs/benchmarks.md.

    Args:
        expected: ids of blocks that have arrived and not entered yet.
        limits: on the work of a tick, and on sync points.
    """

    def __init__(
        self,
        routing: EngineRouting,
        blocks: Blocks,
        planning: Planning,
        solver: BlockSolver,
        procedures: Procedures,
        background: BackgroundWork,
        feedback: BlockFeedback,
        expected: Container[str],
        limits: Limits,
    ) -> None:
        self._routing = routing
        self._procedures = procedures
        self._planning = planning
        self._solver = solver
        self._background = background
        self._feedback = feedback
        self._limits = limits
        self._queue = PlanningQueue(blocks, expected)
        self._preparations: dict[BMLBlock, Preparation] = {}
        self._drafts: dict[BMLBlock, _Draft] = {}

    def __bool__(self) -> bool:
        """Return whether blocks are waiting to be planned."""
        return bool(self._preparations)

    def prepare(self, block: BMLBlock) -> list[Loss]:
        """Start the engines' background work for a block; the losses are the behaviors that no engine plays."""
        description = block.description
        prepared = self._procedures.preparation(block.key.character, description)
        routed = self._routing.route(block.key.character, description.behaviors)
        losses = [lost_behavior(each, unsupported(each)) for each in description.behaviors if each.id not in routed]
        for behavior in description.behaviors:
            engine = routed[behavior.id].engine if behavior.id in routed else None
            self._feedback.foreign_attributes(block.key, behavior, engine.extensions if engine else frozenset())
            if behavior.parameters and engine is not None and not engine.reads_parameters:
                fault = UnknownParameter(names=tuple(sorted(behavior.parameters)), element=behavior.name, known=())
                self._feedback.warn_element(block.key, behavior, fault)
        if not any(loss.required for loss in losses):
            with asked_by(block.client):
                self._preparations[block] = prepared or Preparation(routed, self._background)
            self._queue.add(block, self._preparations[block])
        return losses

    def entered(self, name: str) -> None:
        """Note that an expected block has entered, or was refused."""
        self._queue.entered(name)

    def leave(self, block: BMLBlock) -> None:
        """Forget a block that is planned or has ended; the slow work of one that has ended is canceled."""
        preparation = self._preparations.pop(block, None)
        if preparation is not None and block.state.ended:
            preparation.cancel()
        draft = self._drafts.pop(block, None)
        if draft is not None:
            if draft.cancel is not None:
                draft.cancel()
            draft.steps.close()
        self._queue.leave(block)

    def preparation(self, block: BMLBlock) -> Preparation:
        """The preparation of a block that is being planned."""
        return self._preparations[block]

    @property
    def lanes(self) -> Collection[Lane]:
        """The lanes that have blocks to be planned, now or later."""
        return self._queue.lanes

    def waiting(self, lane: Lane) -> int:
        """How many blocks of a lane can be planned."""
        return self._queue.length(lane)

    def step(self, lane: Lane) -> tuple[int, Planned | None]:
        """Do one step for a lane: the work that it took, and the block that is planned by it.

        A block is planned as if it were to start now. The caller puts its plan on the board, and has it `leave`.
        """
        block = self._queue.first(lane)
        if block is None:
            return 0, None
        draft = self._drafts.get(block)
        if draft is None:
            draft = self._drafts[block] = _Draft(self._steps(block))
        work = next(draft.steps)
        return work, None if draft.outcome is None else Planned(block, draft.outcome)

    def rename_pegs(self, replaced: Container[TimeCell]) -> None:
        """Pose the problems again that name pegs which were replaced."""
        for draft in self._drafts.values():
            draft.renamed |= draft.posed is None or any(cell in replaced for cell in draft.posed.problem.times)

    def _steps(self, block: BMLBlock) -> Generator[int]:
        """Have the engines make the units of a block, solve it, and make its pegs."""
        items: dict[PlanUnit, Item] = {}
        refused: list[Loss] = []
        size = 0
        for made in self._preparations[block].units(block.key, block.cancelled, partial(self._left_out, block)):
            if isinstance(made, Loss):
                refused.append(made)
                yield _REFUSAL
                continue
            made.accompanies = block.gives_way
            size += len(made.timing.points) - len(made.unreported)
            if size > self._limits.sync_points_per_block:
                too_many = TooManyPoints(limit=self._limits.sync_points_per_block)
                place = block.description.location
                loss = Loss(None, too_many.located(place.line, place.column), dropped=False, required=True)
                self._drafts[block].outcome = loss
            yield made.planning_work + len(made.timing.points)
            fault = yield from _finish(made)
            if fault is None:
                items[made] = item_of(made)
            else:
                refused.append(lost_behavior(made.behavior, fault))
        yield from self._solve_until_settled(block, items, refused)

    def _solve_until_settled(
        self, block: BMLBlock, items: Mapping[PlanUnit, Item], refused: Sequence[Loss]
    ) -> Generator[int]:
        """Solve a block, again if times from outside have moved since, and make its pegs."""
        draft = self._drafts[block]
        for times in count(1):
            left = {unit: item for unit, item in items.items() if unit.behavior.id not in block.cancelled}
            draft.posed, draft.renamed, draft.meant = None, False, block.meant
            draft.posed = yield from self._planning.build_problem(block, left, refused)
            yield sum(len(item.points) - 2 for item in left.values())
            plan = yield from self._solve(block, draft, draft.posed)
            stale = times < _MOST_OFTEN and draft.posed.stale
            if stale or not self._holds(block, draft, left):
                continue
            if any(loss.required for loss in plan.losses):
                draft.outcome = plan  # the block fails, and needs no pegs
                yield 1
            yield from self._planning.make_pegs(block, plan)
            work = 3 * plan.size // 2 + _LOSS * len(plan.losses)  # to put it on the board
            if work > self._limits.planning_per_tick:
                yield from self._expected(block, plan)
            if self._holds(block, draft, left):
                draft.outcome = plan
                yield work
            plan.discard()

    def _expected(self, block: BMLBlock, plan: Plan) -> Generator[int]:
        """Have the pegs of a big block move in a tick of their own, before the one in which it is put on the board."""
        try:
            yield self._limits.planning_per_tick
            self._planning.expect(block)
            yield self._limits.planning_per_tick
        except GeneratorExit:
            plan.discard()
            raise

    def _holds(self, block: BMLBlock, draft: _Draft, units: Iterable[PlanUnit]) -> bool:
        """Whether the problem that was posed can still be put on the board."""
        cancelled = any(unit.behavior.id in block.cancelled for unit in units)
        cyclic = draft.posed is None or draft.posed.depends_on(block.start)
        return not (cancelled or cyclic or draft.renamed or draft.meant != block.meant)

    def _solve(self, block: BMLBlock, draft: _Draft, posed: BlockProblem) -> Generator[int, None, Plan]:
        """Solve in steps, or in a thread if these would hold up the event loop."""
        points = sum(len(unit.timing.points) for unit in posed.units)
        if len(posed.units) <= _MOST_AT_ONCE and points <= _MOST_POINTS_AT_ONCE:
            return (yield from self._solver.solve_in_steps(posed))
        received: list[Result] = []

        def receive(result: Result, now: GlobalTime) -> None:
            draft.cancel = None  # it leads back here: only the garbage collector would find them
            received.append(result)
            self._queue.put_back(block)

        work = asyncio.to_thread(self._solver.solve, posed)
        draft.cancel = self._background.request(f"solve {block.key.block}", work, receive)
        self._queue.put_off(block)
        yield 1
        (solved,) = received
        if isinstance(solved, Plan):
            return solved
        raise TypeError(solved)

    def _left_out(self, block: BMLBlock, routed: RoutedBehavior, fault: Fault) -> None:
        self._feedback.warn_element(block.key, routed.behavior, DescriptionLeftOut(reason=fault.sentence))


def _finish(unit: PlanUnit) -> Generator[int, None, Fault | None]:
    """Finish the planning of a unit; the fault if it cannot be played."""
    try:
        for work in unit.finish_planning():
            yield expected(int, work)
    except RealizerError as problem:
        return problem.fault
    except (Exception, SystemExit, asyncio.CancelledError) as failure:  # of a plug-in; nothing here awaits
        logger.exception("the planning of '%s' failed", unit.behavior.id)
        return WorkFailed(reason=str(failure) or type(failure).__name__)
    return None


def unsupported(behavior: Behavior) -> Fault:
    """The fault of a behavior that no engine plays."""
    if behavior.namespace in (BML, BML_EXT):
        return NotSupported(element=behavior.name)
    return ForeignNotSupported(element=behavior.name, namespace=behavior.namespace)
