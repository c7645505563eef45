"""An engine that winks."""

from collections.abc import Mapping

from reactive_realizer.bml.behavior import Behavior, ForeignBehavior
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.engine.context import EngineContext
from reactive_realizer.engine.engine import DefaultEngine
from reactive_realizer.errors import CreationFault, RealizerError
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.timing import timing_at

_LIDS = {"left": "eyeBlinkLeft", "right": "eyeBlinkRight"}


class NoSuchEye(CreationFault):
    """There is no such eye."""

    code = "wink-no-such-eye"
    template = "there is no eye '{eye}'; available: {known}"
    unknown = "eye"
    eye: str
    known: tuple[str, ...]


class Wink(PlanUnit):
    """Closes one eye from start to end; takes 0.3 s by default."""

    def __init__(self, block: BlockKey, behavior: Behavior, lid: str) -> None:
        super().__init__(block, behavior, timing_at({"start": 0.0, "end": 0.3}), resources=frozenset({lid}))
        self.lid = lid


class WinkEngine(DefaultEngine):
    """Plays `<wink eye="left"/>` of the namespace `urn:example:wink`."""

    behaviors = frozenset({ForeignBehavior})

    def __init__(self, context: EngineContext) -> None:
        super().__init__(f"{context.character}/wink")

    def supports(self, behavior: Behavior) -> bool:
        """Whether this is a `wink` of our namespace."""
        return (behavior.namespace, behavior.name) == ("urn:example:wink", "wink")

    def check(self, behavior: Behavior) -> tuple[str, ...]:
        """The sync points of a wink."""
        _lid(behavior)
        return ("start", "end")

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> PlanUnit:
        """Make a wink."""
        return Wink(block, behavior, _lid(behavior))

    def face(self, tick: Tick) -> Mapping[str, float]:
        """The weights of the lids that are closed now."""
        return dict.fromkeys(self.player.show(Wink, lambda unit: unit.lid, tick.time), 1.0)


def _lid(behavior: Behavior) -> str:
    assert isinstance(behavior, ForeignBehavior)
    eye = behavior.attributes.get("eye", "left")
    if eye not in _LIDS:
        raise RealizerError(NoSuchEye(eye=eye, known=tuple(_LIDS)))
    return _LIDS[eye]
