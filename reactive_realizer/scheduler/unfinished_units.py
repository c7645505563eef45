"""Behaviors of which a part is still being prepared while they wait and play, such as a speech that is synthesized."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from reactive_realizer.clock.units import GlobalTime, is_due
from reactive_realizer.engine.effects import Dropped
from reactive_realizer.engine.engine import Engine
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.scheduler.block_lifecycle import BlockLifecycle
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.engine_routing import Result
from reactive_realizer.scheduler.faults import WorkFailed
from reactive_realizer.scheduler.preparation import Preparation

_WAIT = 0.05
"""Time for which a behavior waits at least when its next part is missing, s."""


@dataclass(slots=True)
class _Unfinished:
    """A behavior that lacks parts.

    Attributes:
        leave: ends the work on them; None once it has ended.
        fault: for which no further part comes; None as long as they come.
    """

    leave: Callable[[], None] | None = None
    fault: Fault | None = None


class UnfinishedUnits:
    """Gives behaviors the parts that are prepared after they were planned, and has them wait for missing ones.

    A behavior whose work fails plays what it has, and is dropped then.
    """

    def __init__(self, lifecycle: BlockLifecycle) -> None:
        self._lifecycle = lifecycle
        self._units: dict[PlanUnit, _Unfinished] = {}

    def add(self, block: BMLBlock, preparation: Preparation, now: GlobalTime) -> None:
        """Give the behaviors of a block that was planned what has been prepared since, and what will be."""
        for unit in [unit for unit in block.units if preparation.has_parts(unit)]:
            self._units[unit] = unfinished = _Unfinished()
            take = partial(self._take, unit, preparation.engine_of(unit))
            unfinished.leave = preparation.follow(unit, take, now)
            if unfinished.leave is None and unfinished.fault is None:
                self._units.pop(unit, None)

    def play(self, now: GlobalTime) -> None:
        """Begin a tick: have the behaviors wait that lack something, and leave those that have ended."""
        for unit, unfinished in tuple(self._units.items()):
            if not unit.live:
                self._forget(unit)
            elif (lacks_from := unit.lacks_from()) is not None and is_due(lacks_from, now):
                if unfinished.fault is None:
                    self._lifecycle.wait_in_behavior(unit, lacks_from, GlobalTime(now + _WAIT), now)
                else:
                    self._lifecycle.drop_behaviors([Dropped(unit, unfinished.fault)], lacks_from)

    def _take(self, unit: PlanUnit, engine: Engine, result: Result, now: GlobalTime) -> None:
        """Have a behavior take a result of its slow work."""
        if not unit.live:
            return
        if isinstance(result, Exception):
            fault = result.fault if isinstance(result, RealizerError) else WorkFailed(reason=str(result))
            self._units[unit].fault = fault
            if not unit.begun:
                self._lifecycle.drop_behaviors([Dropped(unit, fault)], now)
        else:
            self._lifecycle.retime_behavior(unit, lambda: engine.extend(unit, result, now), now)

    def _forget(self, unit: PlanUnit) -> None:
        leave = self._units.pop(unit).leave
        if leave is not None:
            leave()
