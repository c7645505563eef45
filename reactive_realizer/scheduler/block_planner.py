"""From a block that was accepted to its plan: engines prepare and plan its behaviors, the strategy times them."""

import logging
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.names import BML, BML_EXT
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.engine import Engine
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.cast import Cast
from reactive_realizer.scheduler.constraints import blocks_named
from reactive_realizer.scheduler.planning import Plan, Planning
from reactive_realizer.scheduler.preparation import Preparation
from reactive_realizer.scheduler.problem import Loss
from reactive_realizer.scheduler.reporter import Reporter
from reactive_realizer.scheduler.workshop import Workshop

logger = logging.getLogger(__name__)


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


class BlockPlanner:
    """Prepares blocks side by side and plans them in order of arrival."""

    def __init__(self, cast: Cast, blocks: Blocks, planning: Planning, workshop: Workshop, reporter: Reporter) -> None:
        self._cast = cast
        self._blocks = blocks
        self._planning = planning
        self._workshop = workshop
        self._reporter = reporter
        self._preparations: dict[BMLBlock, Preparation] = {}

    def prepare(self, block: BMLBlock) -> list[Loss]:
        """Have the engines begin with their slow work; the behaviors that no engine plays are lost."""
        engines: dict[str, tuple[Behavior, Engine]] = {}
        losses: list[Loss] = []
        for behavior in block.description.behaviors:
            engine = self._cast.engine_for(block.key.character, behavior)
            known = engine.extensions if engine else frozenset()
            self._reporter.meaningless(block, [name for name in behavior.extensions if name not in known], behavior)
            if engine is None:
                losses.append(_unsupported(behavior))
            else:
                engines[behavior.id] = (behavior, engine)
        if not any(loss.required for loss in losses):
            self._preparations[block] = Preparation(engines, self._workshop)
            self._preparations[block].begin()
        return losses

    def cancel(self, block: BMLBlock) -> None:
        """Give up what is prepared for a block, if anything is."""
        if block in self._preparations:
            self._preparations.pop(block).cancel()

    def ready(self) -> Iterator[BMLBlock]:
        """Prepared blocks in order of arrival; one that names points of an earlier one waits until that is planned."""
        for block, preparation in tuple(self._preparations.items()):
            if preparation.complete and not self._names_unplanned(block):
                yield block

    def plan(self, block: BMLBlock, now: GlobalTime) -> Draft:
        """Plan a prepared block as if it were to start now."""
        engines, refused = _units(block, self._preparations.pop(block))
        plan = self._planning.solve(block, list(engines), now)
        return Draft(plan, engines, (*refused, *plan.losses))

    def commit(self, block: BMLBlock, draft: Draft, now: GlobalTime) -> None:
        """Put a draft on the board and into the engines' plans."""
        self._planning.commit(block, draft.plan, now)
        for unit in draft.plan.units:
            self._cast.give(unit, draft.engines[unit])

    def _names_unplanned(self, block: BMLBlock) -> bool:
        others = [self._blocks.find(block.key.character, name) for name in blocks_named(block.description)]
        return any(other in self._preparations and other.arrival < block.arrival for other in others if other)


def _units(block: BMLBlock, preparation: Preparation) -> tuple[dict[PlanUnit, Engine], list[Loss]]:
    units: dict[PlanUnit, Engine] = {}
    losses: list[Loss] = []
    for behavior, engine in preparation.engines.values():
        try:
            units[engine.plan(block.key, behavior, preparation.result(behavior.id))] = engine
        except RealizerError as problem:
            losses.append(_loss(behavior, problem.fault))
        except Exception as failure:
            logger.exception("%s/%s:%s could not be made", *block.key, behavior.id)
            losses.append(_loss(behavior, Fault("work-failed", {"reason": failure})))
    return units, losses


def _unsupported(behavior: Behavior) -> Loss:
    core = behavior.namespace in (BML, BML_EXT)
    details = {"element": behavior.name, "namespace": behavior.namespace}
    return _loss(behavior, Fault("not-supported" if core else "foreign-not-supported", details))


def _loss(behavior: Behavior, fault: Fault) -> Loss:
    located = fault.located(behavior.location.line, behavior.location.column)
    return Loss(behavior.id, located, dropped=True, required=behavior.required)
