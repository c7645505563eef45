"""The engine of ``activate`` (thesis 6.6.1, 8.13)."""

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.continuous import Activate
from reactive_realizer.engine.context import EngineContext
from reactive_realizer.engine.effects import ActivateBlock
from reactive_realizer.engine.event_engine import EventEngine
from reactive_realizer.engine.event_unit import EventUnit
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.plan_unit import PlanUnit


class ActivateEngine(EventEngine):
    """Asks for the start of blocks."""

    behaviors = frozenset({Activate})

    def __init__(self, context: EngineContext) -> None:
        super().__init__(f"{context.character}/activate")

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> PlanUnit:
        """A unit that activates its target."""
        if not isinstance(behavior, Activate):
            raise TypeError(behavior)
        target = behavior.target
        return EventUnit(block, behavior, lambda unit, time: ActivateBlock(unit, target, time))
