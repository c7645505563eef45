"""The engine of ``wait`` and ``emit``: waiting for time and events, and making events (thesis 6.2.2, 8.12)."""

from math import inf

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import Wait
from reactive_realizer.bml.extensions import Emit
from reactive_realizer.bml.sync_ref import SyncRef
from reactive_realizer.engine.context import EngineContext
from reactive_realizer.engine.engine import DefaultEngine
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.timing import Phase, PhaseKind, Timing
from reactive_realizer.planunit.wait_unit import WaitUnit


class WaitEngine(DefaultEngine):
    """Waits, and emits events; it has no output.

    A duration is rigid. Without one, the sync points determine when a wait ends. A wait for an event, or with
    ``max-wait`` for the point that its end is tied to, is a `WaitUnit`. The scheduler makes the event of an emit when
    it starts.
    """

    behaviors = frozenset({Wait, Emit})

    def __init__(self, context: EngineContext) -> None:
        super().__init__(f"{context.character}/wait")

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> PlanUnit:
        """A unit with sync points and no output."""
        match behavior:
            case Emit():
                timing = Timing(("start", "end"), (Phase(0.0, PhaseKind.RIGID),), instant=True)
            case Wait(until=SyncRef() as until):
                reason = "end" if behavior.event is None else "event"
                return WaitUnit(block, behavior, until, behavior.max_wait, reason)
            case Wait():
                timing = Timing(("start", "end"), (_phase(behavior),))
            case _:
                raise TypeError(behavior)
        return PlanUnit(block, behavior, timing)


def _phase(wait: Wait) -> Phase:
    if wait.duration is not None:
        return Phase(wait.duration, PhaseKind.RIGID)
    if {"start", "end"} <= wait.syncs.keys():
        return Phase(0.0, PhaseKind.FREE, maximum=inf if wait.max_wait is None else wait.max_wait)
    return Phase(0.0) if wait.max_wait is None else Phase(wait.max_wait, maximum=wait.max_wait)
