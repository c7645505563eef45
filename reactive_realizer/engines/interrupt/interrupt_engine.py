"""The engine of ``interrupt`` (thesis 6.6.3, 8.14)."""

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.continuous import Interrupt
from reactive_realizer.bml.words import InterruptSpeech
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.context import EngineContext
from reactive_realizer.engine.effects import InterruptBlock
from reactive_realizer.engine.event_engine import EventEngine
from reactive_realizer.engine.event_unit import EventUnit
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.plan_unit import PlanUnit


class InterruptEngine(EventEngine):
    """Asks for the end of blocks, or of some of their behaviors."""

    behaviors = frozenset({Interrupt})

    def __init__(self, context: EngineContext) -> None:
        super().__init__(f"{context.character}/interrupt")

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> PlanUnit:
        """A unit that interrupts its target."""
        if not isinstance(behavior, Interrupt):
            raise TypeError(behavior)
        gently = behavior.speech is InterruptSpeech.WORD
        target, include, exclude = behavior.target, behavior.include, behavior.exclude

        def request(unit: PlanUnit, time: GlobalTime) -> InterruptBlock:
            return InterruptBlock(unit, target, include, exclude, gently, time)

        return EventUnit(block, behavior, request)
