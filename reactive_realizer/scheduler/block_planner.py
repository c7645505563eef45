"""Plans accepted blocks: engines prepare and make the units of their behaviors, and the strategy times them."""

import asyncio
from collections.abc import Callable, Container, Iterator, Mapping, Sequence
from dataclasses import dataclass

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.names import BML, BML_EXT
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.faults import UnknownParameter
from reactive_realizer.errors import CreationFault, Fault, WarningType
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.timing import Timing
from reactive_realizer.scheduler.block_feedback import BlockFeedback
from reactive_realizer.scheduler.block_state import BlockState
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.engine_routing import EngineRouting, Result, RoutedBehavior
from reactive_realizer.scheduler.planning import BlockProblem, Plan, Planning
from reactive_realizer.scheduler.planning_order import dependency_order
from reactive_realizer.scheduler.preparation import BackgroundWork, Preparation
from reactive_realizer.scheduler.procedures import Procedures
from reactive_realizer.scheduler.solution import Loss, lost_behavior

_MOST_AT_ONCE = 50
"""Behaviors of a block that is solved on the event loop; a bigger block is solved in a thread."""

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
    template = "<{element}> of {namespace} is not supported and is left out"
    warning = WarningType.CUSTOM_BEHAVIOUR_NOT_SUPPORTED
    element: str
    namespace: str


class DescriptionLeftOut(CreationFault):
    """A description of a behavior that cannot be played."""

    code = "description-left-out"
    template = "one of its descriptions is replaced by the next: {reason}"
    reason: str


@dataclass(slots=True, eq=False)
class _Draft:
    """A block while it is solved.

    Attributes:
        timings: its behaviors, with their preferences.
        refused: the behaviors that engines could not make.
        plan: None until it is solved.
        times: how often it has been solved.
        cancel: cancels the work of a thread.
    """

    timings: Mapping[PlanUnit, Timing]
    refused: Sequence[Loss]
    posed: BlockProblem
    plan: Plan | None = None
    times: int = 0
    cancel: Callable[[], None] = lambda: None


class BlockPlanner:
    """Prepares blocks in parallel, and plans them in order of arrival."""

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
        self._drafts: dict[BMLBlock, _Draft] = {}

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
            self._preparations[block] = prepared or Preparation(routed, self._background)
        return losses

    def cancel(self, block: BMLBlock) -> None:
        """Cancel the preparation of a block, if there is one; that of a procedure goes on."""
        preparation = self._preparations.pop(block, None)
        if preparation is not None and block.description.procedure is None:
            preparation.cancel()
        if block in self._drafts:
            self._drafts.pop(block).cancel()

    def plans(self, now: GlobalTime) -> Iterator[tuple[BMLBlock, Plan]]:
        """Plans of the blocks that are ready, as if they were to start now, in order of arrival.

        A block waits until the blocks that it names are planned; in a circle of blocks, one is first.
        """
        late: set[BMLBlock] = set()
        for block in self._in_order():
            if block in self._preparations and self._may_plan(block, late):
                self._begin(block, self._preparations.pop(block), now)
            if block in self._drafts and (plan := self._finished(block, self._drafts[block], now)) is not None:
                yield block, plan
            if block.state is BlockState.IN_PREP:
                late.add(block)

    def _begin(self, block: BMLBlock, preparation: Preparation, now: GlobalTime) -> None:
        """Have the engines make the units of a block, and solve it."""

        def left_out(routed: RoutedBehavior, fault: Fault) -> None:
            self._feedback.warn_element(block.key, routed.behavior, DescriptionLeftOut(reason=fault.sentence))

        units, refused = preparation.units(block.key, block.cancelled, left_out)
        timings = {unit: unit.timing for unit in units}
        posed = self._planning.build_problem(block, timings, now, refused)
        self._drafts[block] = _Draft(timings, refused, posed)
        self._solve(block, self._drafts[block])

    def _solve(self, block: BMLBlock, draft: _Draft) -> None:
        """Solve at once, or in a thread if that would hold up the event loop."""
        draft.times += 1
        if len(draft.posed.units) <= _MOST_AT_ONCE:
            draft.plan = self._planning.solve(draft.posed)
            return

        def receive(result: Result, now: GlobalTime) -> None:
            draft.cancel = lambda: None  # it leads back here: only the garbage collector would find them
            if isinstance(result, Plan):
                draft.plan = result

        work = asyncio.to_thread(self._planning.solve, draft.posed)
        draft.plan = None
        draft.cancel = self._background.request(f"solve {block.key.block}", work, receive)

    def _finished(self, block: BMLBlock, draft: _Draft, now: GlobalTime) -> Plan | None:
        """The plan of a block that is solved; it is solved again if times from outside have moved since."""
        while (plan := draft.plan) is not None:
            stale = draft.times < _MOST_OFTEN and self._planning.is_stale(draft.posed)
            if not stale and not self._planning.is_cyclic(block, draft.posed):
                del self._drafts[block]
                return plan
            draft.posed = self._planning.build_problem(block, draft.timings, now, draft.refused)
            self._solve(block, draft)
        return None

    def _in_order(self) -> list[BMLBlock]:
        """The blocks in preparation, each after those that it names; none while none can be planned."""
        if not self._drafts and not any(preparation.complete for preparation in self._preparations.values()):
            return []
        preparing = [block for block in self._blocks.alive if block.state is BlockState.IN_PREP]
        return dependency_order(preparing, self._awaited)

    def _awaited(self, block: BMLBlock) -> list[BMLBlock]:
        return self._blocks.planned_before(block) if block in self._preparations else []

    def _may_plan(self, block: BMLBlock, late: Container[BMLBlock]) -> bool:
        return self._preparations[block].complete and not any(other in late for other in self._awaited(block))


def unsupported(behavior: Behavior) -> Fault:
    """The fault of a behavior that no engine plays."""
    if behavior.namespace in (BML, BML_EXT):
        return NotSupported(element=behavior.name)
    return ForeignNotSupported(element=behavior.name, namespace=behavior.namespace)
