"""Engines of behaviors that are nothing but something asked for."""

from reactive_realizer.clock.ticker import Tick
from reactive_realizer.engine.effects import Request
from reactive_realizer.engine.engine import DefaultEngine
from reactive_realizer.engine.event_unit import EventUnit


class EventEngine(DefaultEngine):
    """Shows nothing, and asks for what its behaviors want; it is done before the others play."""

    leads = True

    def requests(self, tick: Tick) -> tuple[Request, ...]:
        """What is to be done for the behaviors that are due, in the order of their starts."""
        units = (unit for unit in self.player.units if isinstance(unit, EventUnit) and unit.asks(tick.time))
        return tuple(unit.ask() for unit in sorted(units, key=lambda unit: (unit.start, unit.behavior.id)))
