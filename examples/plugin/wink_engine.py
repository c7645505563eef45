"""An engine of one's own: it winks."""

from collections.abc import Mapping

from reactive_realizer.bml.behavior import Behavior, ForeignBehavior
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.engine.context import EngineContext
from reactive_realizer.engine.engine import DefaultEngine
from reactive_realizer.errors import error
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.timing import timing_at

_LIDS = {"left": "eyeBlinkLeft", "right": "eyeBlinkRight"}


class Wink(PlanUnit):
    """One eye, closed from start to end; 0.3 s unless somebody says otherwise."""

    def __init__(self, block: BlockKey, behavior: Behavior, lid: str) -> None:
        super().__init__(block, behavior, timing_at({"start": 0.0, "end": 0.3}), resources=frozenset({lid}))
        self.lid = lid


class WinkEngine(DefaultEngine):
    """Plays `<wink eye="left"/>` of the namespace `urn:example:wink`."""

    behaviors = frozenset({ForeignBehavior})

    def __init__(self, context: EngineContext) -> None:
        super().__init__(f"{context.character}/wink")

    def supports(self, behavior: Behavior) -> bool:
        """Other namespaces are for other engines."""
        return (behavior.namespace, behavior.name) == ("urn:example:wink", "wink")

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> PlanUnit:
        """A wink."""
        assert isinstance(behavior, ForeignBehavior)
        eye = behavior.attributes.get("eye", "left")
        if eye not in _LIDS:
            raise error("work-failed", reason=f"nobody has an eye '{eye}'")
        return Wink(block, behavior, _LIDS[eye])

    def face(self, tick: Tick) -> Mapping[str, float]:
        """The lids that are closed now."""
        return dict.fromkeys(self.player.show(Wink, lambda unit: unit.lid, tick.time), 1.0)
