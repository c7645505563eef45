"""From a block that was accepted to its plan: engines prepare and plan its behaviors, the strategy times them."""

import asyncio
import logging
from collections.abc import Callable, Container, Iterator, Mapping
from dataclasses import dataclass

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.names import BML, BML_EXT
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.engine import Engine
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BlockState, BMLBlock
from reactive_realizer.scheduler.cast import Cast
from reactive_realizer.scheduler.losses import lost_behavior
from reactive_realizer.scheduler.planning import Plan, Planning, Task
from reactive_realizer.scheduler.preparation import Preparation
from reactive_realizer.scheduler.problem import Loss
from reactive_realizer.scheduler.reporter import Reporter
from reactive_realizer.scheduler.turns import in_turn
from reactive_realizer.scheduler.workshop import Result, Workshop

logger = logging.getLogger(__name__)


_MOST_AT_ONCE = 50
"""Behaviors of a block that are still solved on the loop."""

_MOST_OFTEN = 3
"""Solutions of one block. Where times move all the while it is committed nevertheless: its pegs follow them."""


@dataclass(frozen=True, slots=True)
class Draft:
    """A block as it could be played, nothing of it committed.

    Attributes:
        plan: its behaviors with their pegs.
        engines: who plays each of them.
        losses: what could not be kept, engines' refusals included.
    """

    plan: Plan
    engines: Mapping[PlanUnit, Engine]
    losses: tuple[Loss, ...]


@dataclass(slots=True, eq=False)
class _Solving:
    """A big block while it is solved off the loop.

    Attributes:
        plan: None as long as it is.
        times: how often it has been solved.
    """

    engines: Mapping[PlanUnit, Engine]
    refused: list[Loss]
    task: Task
    plan: Plan | None = None
    times: int = 0
    cancel: Callable[[], None] = lambda: None


class BlockPlanner:
    """Prepares blocks side by side and plans them in order of arrival."""

    def __init__(self, cast: Cast, blocks: Blocks, planning: Planning, workshop: Workshop, reporter: Reporter) -> None:
        self._cast = cast
        self._blocks = blocks
        self._planning = planning
        self._workshop = workshop
        self._reporter = reporter
        self._preparations: dict[BMLBlock, Preparation] = {}
        self._solving: dict[BMLBlock, _Solving] = {}

    def prepare(self, block: BMLBlock, prepared: Preparation | None) -> list[Loss]:
        """Have the engines begin with their slow work; the behaviors that no engine plays are lost.

        Args:
            block: as it came in.
            prepared: what a procedure has ready for it.
        """
        behaviors = block.description.behaviors
        engines = self._cast.engines_for(block.key.character, behaviors)
        losses = [_unsupported(behavior) for behavior in behaviors if behavior.id not in engines]
        for behavior in behaviors:
            _, engine = engines.get(behavior.id, (behavior, None))
            known = engine.extensions if engine is not None else frozenset()
            self._reporter.meaningless(block, [name for name in behavior.extensions if name not in known], behavior)
            if behavior.parameters and engine is not None and not engine.reads_parameters:
                self._reporter.unheard(block, behavior)
        if not any(loss.required for loss in losses):
            self._preparations[block] = prepared or self._begin(engines)
        return losses

    def cancel(self, block: BMLBlock) -> None:
        """Give up what is prepared for a block, if anything is; a procedure keeps what it has."""
        preparation = self._preparations.pop(block, None)
        if preparation is not None and block.description.procedure is None:
            preparation.cancel()
        if block in self._solving:
            self._solving.pop(block).cancel()

    def drafts(self, now: GlobalTime) -> Iterator[tuple[BMLBlock, Draft]]:
        """Blocks that can be committed, as if they were to start now, in order of arrival.

        One that names others waits until these are planned; in a circle of some that name each other, one is first.
        """
        late: set[BMLBlock] = set()
        for block in self._in_turn():
            if block in self._preparations and self._may_plan(block, late):
                engines, refused = _units(block, self._preparations.pop(block), self._reporter)
                timings = {unit: unit.timing for unit in engines}
                self._solving[block] = _Solving(engines, refused, self._planning.pose(block, timings, now))
                self._solve(block, self._solving[block])
            if block in self._solving and (draft := self._draft(block, self._solving[block], now)) is not None:
                yield block, draft
            if block.state is BlockState.IN_PREP:
                late.add(block)

    def commit(self, block: BMLBlock, draft: Draft, now: GlobalTime) -> None:
        """Put a draft on the board and into the engines' plans."""
        self._planning.commit(block, draft.plan, now)
        for unit in draft.plan.units:
            self._cast.give(unit, draft.engines[unit])

    def renew(self, block: BMLBlock, start: GlobalTime, now: GlobalTime) -> None:
        """Within a transaction: plan a block anew that starts, from how its engines prefer it now (thesis 12.1.4).

        The plan that is there stays if the new one would lose anything.

        Args:
            block: alive.
            start: of it; in this tick.
            now: the time of the tick.
        """
        before = {unit: unit.points for unit in block.units}
        task = self._planning.pose(block, {unit: unit.preference(now) for unit in block.units}, start)
        plan = self._planning.solve(task)
        if not plan.losses and len(plan.units) == len(before):
            self._planning.recommit(block, plan)

    def _begin(self, engines: Mapping[str, tuple[Behavior, Engine]]) -> Preparation:
        preparation = Preparation(engines, self._workshop)
        preparation.begin()
        return preparation

    def _solve(self, block: BMLBlock, solving: _Solving) -> None:
        """Solve at once, or off the loop if that would hold it up."""
        solving.times += 1
        if len(solving.task.units) <= _MOST_AT_ONCE:
            solving.plan = self._planning.solve(solving.task)
            return

        def receive(result: Result, now: GlobalTime) -> None:
            solving.cancel = lambda: None  # it leads back here: only the garbage collector would find them
            if isinstance(result, Plan):
                solving.plan = result

        work = asyncio.to_thread(self._planning.solve, solving.task)
        solving.plan = None
        solving.cancel = self._workshop.request(f"solve {block.key.block}", work, receive)

    def _draft(self, block: BMLBlock, solving: _Solving, now: GlobalTime) -> Draft | None:
        """What came out, if it did and times from outside are still what they were."""
        if solving.plan is None:
            return None
        stale = solving.times < _MOST_OFTEN and self._planning.is_stale(solving.task)
        if stale or self._planning.is_cyclic(block, solving.task):
            timings = {unit: unit.timing for unit in solving.engines}
            solving.task = self._planning.pose(block, timings, now)
            self._solve(block, solving)
            return self._draft(block, solving, now) if solving.plan is not None else None
        del self._solving[block]
        return Draft(solving.plan, solving.engines, (*solving.refused, *solving.plan.losses))

    def _in_turn(self) -> list[BMLBlock]:
        """The blocks in preparation, each after those that it waits for; none while none can be planned."""
        if not self._solving and not any(preparation.complete for preparation in self._preparations.values()):
            return []
        preparing = [block for block in self._blocks.alive if block.state is BlockState.IN_PREP]
        return in_turn(preparing, self._awaited)

    def _awaited(self, block: BMLBlock) -> list[BMLBlock]:
        return self._blocks.planned_before(block) if block in self._preparations else []

    def _may_plan(self, block: BMLBlock, late: Container[BMLBlock]) -> bool:
        return self._preparations[block].complete and not any(other in late for other in self._awaited(block))


def _units(block: BMLBlock, preparation: Preparation, reporter: Reporter) -> tuple[dict[PlanUnit, Engine], list[Loss]]:
    units: dict[PlanUnit, Engine] = {}
    losses: list[Loss] = []
    for behavior, engine in preparation.engines.values():
        if behavior.id in block.cancelled:
            continue
        try:
            units[_unit(block, behavior, engine, preparation, reporter)] = engine
        except RealizerError as problem:
            losses.append(lost_behavior(behavior, problem.fault))
        except Exception as failure:
            logger.exception("%s/%s:%s could not be made", *block.key, behavior.id)
            losses.append(lost_behavior(behavior, Fault("work-failed", {"reason": failure})))
    return units, losses


def _unit(
    block: BMLBlock, behavior: Behavior, engine: Engine, preparation: Preparation, reporter: Reporter
) -> PlanUnit:
    """A unit for the best form of a behavior that the engine can make; of better ones it is told why not.

    Raises:
        RealizerError: it can make none; what is wrong with the behavior itself.
    """
    prepared = preparation.result(behavior.id)
    *others, last = [form for form in behavior.forms if engine.supports(form)]
    for form in others:
        try:
            return _named(engine.plan(block.key, form, prepared), behavior)
        except RealizerError as problem:
            reporter.passed_over(block, behavior, problem.fault)
    return _named(engine.plan(block.key, last, prepared), behavior)


def _named(unit: PlanUnit, behavior: Behavior) -> PlanUnit:
    """Whatever form of it is played, feedback is about the behavior."""
    unit.behavior = behavior
    return unit


def _unsupported(behavior: Behavior) -> Loss:
    core = behavior.namespace in (BML, BML_EXT)
    details = {"element": behavior.name, "namespace": behavior.namespace}
    return lost_behavior(behavior, Fault("not-supported" if core else "foreign-not-supported", details))
