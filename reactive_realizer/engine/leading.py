"""Engines that ask others for something: what they ask for is done before the others play."""

from reactive_realizer.clock.ticker import Tick
from reactive_realizer.engine.effects import Request
from reactive_realizer.engine.engine import DefaultEngine


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
