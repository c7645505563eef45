"""The engines of ``activate`` (thesis 6.6.1, 8.13) and ``interrupt`` (6.6.3, 8.14).

Their behaviors have no visible output: each sends one request to the scheduler at its start, which is also its end. The
engines identify blocks and behaviors by their ids.
"""

from collections.abc import Callable

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.extensions import Activate, Interrupt
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.context import EngineContext
from reactive_realizer.engine.effects import ActivateBlock, InterruptBlock, Request
from reactive_realizer.engine.engine import DefaultEngine
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.timing import Phase, PhaseKind, Timing


class RequestUnit(PlanUnit):
    """Sends one request when it is due.

    It starts only after it has sent the request: if there is nothing to do, the scheduler drops the unit first, and it
    reports no progress.

    Args:
        request: makes the request from the unit and the time of its start.
    """

    def __init__(self, block: BlockKey, behavior: Behavior, request: Callable[[PlanUnit, GlobalTime], Request]) -> None:
        super().__init__(block, behavior, Timing(("start", "end"), (Phase(0.0, PhaseKind.RIGID),), instant=True))
        self._request = request
        self._sent = False

    def due(self, now: GlobalTime) -> bool:
        """Whether the request is sent and the unit may start."""
        return self._sent and super().due(now)

    def request_due(self, now: GlobalTime) -> bool:
        """Whether it is time to send the request."""
        return not self._sent and super().due(now)

    def send(self) -> Request:
        """The request; from now on it counts as sent."""
        self._sent = True
        return self._request(self, self.start)

    @property
    def start(self) -> GlobalTime:
        """The time of its start.

        Raises:
            ValueError: the time is unknown.
        """
        if (start := self.points[0].peg.value) is None:
            raise ValueError(f"the start of {self.behavior.id} is unknown")
        return start


class RequestEngine(DefaultEngine):
    """Sends the requests of its units before the other engines play."""

    leads = True

    def requests(self, tick: Tick) -> tuple[Request, ...]:
        """The requests that are due, in the order of their starts."""
        units = (unit for unit in self.player.units if isinstance(unit, RequestUnit) and unit.request_due(tick.time))
        return tuple(unit.send() for unit in sorted(units, key=lambda unit: (unit.start, unit.behavior.id)))


class ActivateEngine(RequestEngine):
    """Requests the start of preplanned blocks."""

    behaviors = frozenset({Activate})

    def __init__(self, context: EngineContext) -> None:
        super().__init__(f"{context.character}/activate")

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> PlanUnit:
        """A unit that activates its target."""
        if not isinstance(behavior, Activate):
            raise TypeError(behavior)
        target = behavior.target
        return RequestUnit(block, behavior, lambda unit, time: ActivateBlock(unit, target, time))


class InterruptEngine(RequestEngine):
    """Requests the end of blocks, or of some of their behaviors."""

    behaviors = frozenset({Interrupt})

    def __init__(self, context: EngineContext) -> None:
        super().__init__(f"{context.character}/interrupt")

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> PlanUnit:
        """A unit that interrupts its target."""
        if not isinstance(behavior, Interrupt):
            raise TypeError(behavior)
        target, include, exclude, speech = behavior.target, behavior.include, behavior.exclude, behavior.speech

        def request(unit: PlanUnit, time: GlobalTime) -> InterruptBlock:
            return InterruptBlock(unit, target, include, exclude, speech, time)

        return RequestUnit(block, behavior, request)
