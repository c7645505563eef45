"""Emitters of AsapRealizer, which repeat a small behavior in random intervals: here, rates of idle animation."""

from typing import Final

from reactive_realizer.bml.attribute_types import Float
from reactive_realizer.bml.block_source import BlockSource
from reactive_realizer.bml.idle_change import MOST, IdleParameter
from reactive_realizer.bml.names import BMLT, OWN
from reactive_realizer.bml.trees import Tree, name_of, namespace_of
from reactive_realizer.errors import RealizerError

_PARAMETERS: Final = {
    "blinkemitter": IdleParameter.BLINK_RATE,
    "breathingemitter": IdleParameter.BREATHING_RATE,
}
_INTERVAL, _SPREAD = "avgwaitingtime", "range"
_MINUTE, _LONGEST = 60.0, 3600.0


def replace_emitter(tree: Tree, source: BlockSource) -> None:
    """Rewrites an emitter of blinks or breaths as the rate that its mean interval (s) says, in place.

    By how much the intervals differ (``range``) is left to idle animation.

    Raises:
        RealizerError: ``bad-attribute``: the interval is no number, or too short for any character.
    """
    parameter = _PARAMETERS.get(name_of(tree)) if namespace_of(tree) == BMLT else None
    if parameter is None or _INTERVAL not in tree.attrib or "end" in tree.attrib:
        return
    text = str(tree.attrib.pop(_INTERVAL))
    try:
        interval = Float(_MINUTE / MOST, _LONGEST).read(text, source.limits)
    except RealizerError as refused:
        raise source.bad_attribute(tree, _INTERVAL, text, refused) from None
    tree.attrib.pop(_SPREAD, "")
    source.rename(tree, f"{{{OWN}}}idleChange", name_of(tree))
    tree.set("parameter", parameter)
    tree.set("value", f"{_MINUTE / interval:g}")
