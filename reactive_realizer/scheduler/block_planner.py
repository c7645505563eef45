"""Drafts the plan of an accepted block: engines prepare and plan its behaviors, the strategy times them."""

import asyncio
import logging
from collections.abc import Callable, Container, Iterator, Mapping
from dataclasses import dataclass

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.names import BML, BML_EXT
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.engine import Engine
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.scheduler.block_feedback import BlockFeedback
from reactive_realizer.scheduler.block_state import BlockState
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.engine_routing import EngineRouting
from reactive_realizer.scheduler.faults import ForeignNotSupported, NotSupported
from reactive_realizer.scheduler.losses import lost_behavior
from reactive_realizer.scheduler.planning import BlockProblem, Plan, Planning
from reactive_realizer.scheduler.planning_order import dependency_order
from reactive_realizer.scheduler.preparation import BackgroundWork, Preparation, Result
from reactive_realizer.scheduler.problem import Loss
from reactive_realizer.scheduler.procedures import Procedures

logger = logging.getLogger(__name__)


_MOST_AT_ONCE = 50
"""Behaviors of a block that is solved on the event loop; a bigger block is solved in a thread."""

_MOST_OFTEN = 3
"""Solutions of one block. If times still move then, the last one is committed: its pegs follow them."""


@dataclass(frozen=True, slots=True)
class Draft:
    """The plan of a block, before anything of it is committed.

    Attributes:
        plan: its behaviors with their pegs.
        engines: the engine of each behavior.
        losses: what could not be kept, and what engines could not make.
    """

    plan: Plan
    engines: Mapping[PlanUnit, Engine]
    losses: tuple[Loss, ...]


@dataclass(slots=True, eq=False)
class _Solving:
    """A block while it is solved.

    Attributes:
        plan: None until it is solved.
        times: how often it has been solved.
    """

    engines: Mapping[PlanUnit, Engine]
    refused: list[Loss]
    posed: BlockProblem
    plan: Plan | None = None
    times: int = 0
    cancel: Callable[[], None] = lambda: None


class BlockPlanner:
    """Prepares blocks in parallel and drafts their plans in order of arrival."""

    def __init__(
        self,
        routing: EngineRouting,
        blocks: Blocks,
        planning: Planning,
        procedures: Procedures,
        background: BackgroundWork,
        feedback: BlockFeedback,
    ) -> None:
        self._routing = routing
        self._procedures = procedures
        self._blocks = blocks
        self._planning = planning
        self._background = background
        self._feedback = feedback
        self._preparations: dict[BMLBlock, Preparation] = {}
        self._solving: dict[BMLBlock, _Solving] = {}

    def prepare(self, block: BMLBlock) -> list[Loss]:
        """Start the engines' background work for a block; the losses are the behaviors that no engine plays."""
        prepared = self._procedures.preparation(block.key.character, block.description)
        behaviors = block.description.behaviors
        engines = self._routing.engines_for(block.key.character, behaviors)
        losses = [_unsupported(behavior) for behavior in behaviors if behavior.id not in engines]
        for behavior in behaviors:
            _, engine = engines.get(behavior.id, (behavior, None))
            known = engine.extensions if engine is not None else frozenset()
            unknown = [name for name in behavior.extensions if name not in known]
            self._feedback.unknown_attributes(block, unknown, behavior)
            if behavior.parameters and engine is not None and not engine.reads_parameters:
                self._feedback.unread_parameters(block, behavior)
        if not any(loss.required for loss in losses):
            self._preparations[block] = prepared or self._begin(engines)
        return losses

    def cancel(self, block: BMLBlock) -> None:
        """Cancel the preparation of a block, if there is one; that of a procedure goes on."""
        preparation = self._preparations.pop(block, None)
        if preparation is not None and block.description.procedure is None:
            preparation.cancel()
        if block in self._solving:
            self._solving.pop(block).cancel()

    def drafts(self, now: GlobalTime) -> Iterator[tuple[BMLBlock, Draft]]:
        """Drafts of the blocks that are ready, as if they were to start now, in order of arrival.

        A block waits until those that it names are planned; of a circle of blocks one is first.
        """
        late: set[BMLBlock] = set()
        for block in self._in_order():
            if block in self._preparations and self._may_plan(block, late):
                engines, refused = self._preparations.pop(block).units(block, self._feedback)
                timings = {unit: unit.timing for unit in engines}
                self._solving[block] = _Solving(engines, refused, self._planning.build_problem(block, timings, now))
                self._solve(block, self._solving[block])
            if block in self._solving and (draft := self._draft(block, self._solving[block], now)) is not None:
                yield block, draft
            if block.state is BlockState.IN_PREP:
                late.add(block)

    def _begin(self, engines: Mapping[str, tuple[Behavior, Engine]]) -> Preparation:
        preparation = Preparation(engines, self._background)
        preparation.begin()
        return preparation

    def _solve(self, block: BMLBlock, solving: _Solving) -> None:
        """Solve at once, or in a thread if that would hold up the event loop."""
        solving.times += 1
        if len(solving.posed.units) <= _MOST_AT_ONCE:
            solving.plan = self._planning.solve(solving.posed)
            return

        def receive(result: Result, now: GlobalTime) -> None:
            solving.cancel = lambda: None  # it leads back here: only the garbage collector would find them
            if isinstance(result, Plan):
                solving.plan = result

        work = asyncio.to_thread(self._planning.solve, solving.posed)
        solving.plan = None
        solving.cancel = self._background.request(f"solve {block.key.block}", work, receive)

    def _draft(self, block: BMLBlock, solving: _Solving, now: GlobalTime) -> Draft | None:
        """The draft of a block that is solved; it is solved again if times from outside have moved since."""
        if solving.plan is None:
            return None
        stale = solving.times < _MOST_OFTEN and self._planning.is_stale(solving.posed)
        if stale or self._planning.is_cyclic(block, solving.posed):
            timings = {unit: unit.timing for unit in solving.engines}
            solving.posed = self._planning.build_problem(block, timings, now)
            self._solve(block, solving)
            return self._draft(block, solving, now) if solving.plan is not None else None
        del self._solving[block]
        return Draft(solving.plan, solving.engines, (*solving.refused, *solving.plan.losses))

    def _in_order(self) -> list[BMLBlock]:
        """The blocks in preparation, each after those that it names; none while none can be planned."""
        if not self._solving and not any(preparation.complete for preparation in self._preparations.values()):
            return []
        preparing = [block for block in self._blocks.alive if block.state is BlockState.IN_PREP]
        return dependency_order(preparing, self._awaited)

    def _awaited(self, block: BMLBlock) -> list[BMLBlock]:
        return self._blocks.planned_before(block) if block in self._preparations else []

    def _may_plan(self, block: BMLBlock, late: Container[BMLBlock]) -> bool:
        return self._preparations[block].complete and not any(other in late for other in self._awaited(block))


def _unsupported(behavior: Behavior) -> Loss:
    core = behavior.namespace in (BML, BML_EXT)
    foreign = ForeignNotSupported(element=behavior.name, namespace=behavior.namespace)
    return lost_behavior(behavior, NotSupported(element=behavior.name) if core else foreign)
