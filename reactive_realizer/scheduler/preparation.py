"""Preparation of a block: the background work of engines, and the units that they make with its results."""

import logging
from collections.abc import Awaitable, Callable, Mapping
from typing import Protocol

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.engine import Engine
from reactive_realizer.errors import RealizerError
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.scheduler.block_feedback import BlockFeedback
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.faults import WorkFailed
from reactive_realizer.scheduler.losses import lost_behavior
from reactive_realizer.scheduler.problem import Loss

logger = logging.getLogger(__name__)

Result = object | Exception
"""What background work gave: a value, or the exception that it raised."""


class BackgroundWork(Protocol):
    """Does slow work outside of ticks; a result is an input of a later tick."""

    def request(
        self, name: str, work: Awaitable[object], done: Callable[[Result, GlobalTime], None]
    ) -> Callable[[], None]:
        """Start work; ``done`` gets its result and the time, in a later tick.

        Returns:
            A call that cancels the work; ``done`` is not called then.
        """
        ...


class Preparation:
    """Has the engines of a block do their background work, and make units once it is done."""

    def __init__(self, engines: Mapping[str, tuple[Behavior, Engine]], background: BackgroundWork) -> None:
        self.engines = engines
        self._results: dict[str, Result] = {}
        self._background = background
        self._cancels: list[Callable[[], None]] = []

    @property
    def complete(self) -> bool:
        """Whether all results are there."""
        return len(self._results) == len(self.engines)

    def begin(self) -> None:
        """Start the work."""
        for id_, (behavior, engine) in self.engines.items():
            try:
                work = engine.prepare(next(form for form in behavior.forms if engine.supports(form)))
            except Exception as failure:
                self._results[id_] = failure
                continue
            if work is None:
                self._results[id_] = None
            else:
                self._cancels.append(self._background.request(f"{engine.name} {id_}", work, self._receiver(id_)))

    def result(self, id_: str) -> object:
        """The result of the work for a behavior, None if it needed none.

        Raises:
            RealizerError: the work failed.
        """
        result = self._results[id_]
        if isinstance(result, RealizerError):
            raise result
        if isinstance(result, Exception):
            raise RealizerError(WorkFailed(reason=str(result))) from result
        return result

    def units(self, block: BMLBlock, feedback: BlockFeedback) -> tuple[dict[PlanUnit, Engine], list[Loss]]:
        """Make a unit for each behavior from the results; the losses are the behaviors that engines cannot make."""
        units: dict[PlanUnit, Engine] = {}
        losses: list[Loss] = []
        for behavior, engine in self.engines.values():
            if behavior.id in block.cancelled:
                continue
            try:
                unit = self._unit(block, behavior, engine, feedback)
            except RealizerError as problem:
                losses.append(lost_behavior(behavior, problem.fault))
            except Exception as failure:
                logger.exception("%s/%s:%s could not be made", *block.key, behavior.id)
                losses.append(lost_behavior(behavior, WorkFailed(reason=str(failure))))
            else:
                unit.behavior = behavior  # feedback names the behavior, whatever form of it is played
                units[unit] = engine
        return units, losses

    def _unit(self, block: BMLBlock, behavior: Behavior, engine: Engine, feedback: BlockFeedback) -> PlanUnit:
        """A unit for the best form of a behavior that the engine can make; a better form gives a warning.

        Raises:
            RealizerError: the behavior itself cannot be made either.
        """
        prepared = self.result(behavior.id)
        *others, last = [form for form in behavior.forms if engine.supports(form)]
        for form in others:
            try:
                return engine.plan(block.key, form, prepared)
            except RealizerError as problem:
                feedback.description_left_out(block, behavior, problem.fault)
        return engine.plan(block.key, last, prepared)

    def cancel(self) -> None:
        """Cancel the work."""
        for cancel in self._cancels:
            cancel()

    def _receiver(self, id_: str) -> Callable[[Result, GlobalTime], None]:
        def receive(result: Result, now: GlobalTime) -> None:
            self._results[id_] = result

        return receive
