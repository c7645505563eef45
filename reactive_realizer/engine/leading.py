"""Engines that ask others for something: what they ask for is done before the others play."""

from collections.abc import Callable

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.effects import Request
from reactive_realizer.engine.engine import DefaultEngine
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.timing import Phase, PhaseKind, Timing


class LeadingEngine(DefaultEngine):
    """Shows nothing, and gives on what its units ask for."""

    leads = True

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self._asked: list[Request] = []

    def ask(self, request: Request) -> None:
        """Have something done after this round."""
        self._asked.append(request)

    def requests(self, tick: Tick) -> tuple[Request, ...]:
        """What was asked for since the last round."""
        asked, self._asked = tuple(self._asked), []
        return asked


class EventUnit(PlanUnit):
    """Asks for something once, at its start, which is its end too (thesis 8.13, 8.14)."""

    def __init__(self, block: BlockKey, behavior: Behavior, ask: Callable[[PlanUnit, GlobalTime], None]) -> None:
        super().__init__(block, behavior, Timing(("start", "end"), (Phase(0.0, PhaseKind.RIGID),), instant=True))
        self._ask = ask

    def on_start(self, time: GlobalTime) -> None:
        """Now."""
        self._ask(self, time)
