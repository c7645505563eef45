"""A behavior that is nothing but something asked for."""

from collections.abc import Callable

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.effects import Request
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.timing import Phase, PhaseKind, Timing


class EventUnit(PlanUnit):
    """Asks for something once, at its start, which is its end too (thesis 8.13, 8.14).

    It does not start before it has asked: whoever finds that there is nothing to do drops it, and it reports nothing.

    Args:
        request: what it asks for, from itself and the time of its start.
    """

    def __init__(self, block: BlockKey, behavior: Behavior, request: Callable[[PlanUnit, GlobalTime], Request]) -> None:
        super().__init__(block, behavior, Timing(("start", "end"), (Phase(0.0, PhaseKind.RIGID),), instant=True))
        self._request = request
        self._asked = False

    def due(self, now: GlobalTime) -> bool:
        """Whether it has asked, and nothing keeps it from starting."""
        return self._asked and super().due(now)

    def asks(self, now: GlobalTime) -> bool:
        """Whether it is time to ask."""
        return not self._asked and super().due(now)

    def ask(self) -> Request:
        """What it asks for, now that its start is known and due."""
        self._asked = True
        return self._request(self, self.start)

    @property
    def start(self) -> GlobalTime:
        """When it starts.

        Raises:
            ValueError: that is unknown.
        """
        if (start := self.points[0].peg.value) is None:
            raise ValueError(f"the start of {self.behavior.id} is unknown")
        return start
