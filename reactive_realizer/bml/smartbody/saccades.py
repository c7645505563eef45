"""Saccades of SmartBody: single ones, and modes of the eyes.

Defaults and directions are those of SmartBody's sources (bml_saccade and me_ct_saccade).
"""

import math
from typing import Final

from reactive_realizer.bml.block_source import BlockSource
from reactive_realizer.bml.glance import FURTHEST
from reactive_realizer.bml.idle_change import IdleParameter
from reactive_realizer.bml.names import OWN
from reactive_realizer.bml.smartbody.attributes import OTHER_POINTS, drop, left_out, take, take_number, tie
from reactive_realizer.bml.trees import Tree
from reactive_realizer.bml.value_faults import UnknownWord
from reactive_realizer.errors import Fault, RealizerError

_LONGEST: Final = 60.0
_GLANCES: Final = {"listen": 7.2, "talk": 14.8, "think": 20.0}
"""Glances per minute: of listeners and speakers after S. P. Lee, J. B. Badler and N. I. Badler, "Eyes Alive" (SIGGRAPH
2002), whose model SmartBody uses too; of people who think, our choice."""
_SINGLE: Final = {
    "magnitude": (-FURTHEST, FURTHEST),
    "direction": (-360.0, 360.0),
    "duration": (0.0, _LONGEST),
}
"""Attributes of single saccades, and their ranges: degrees, degrees, s."""


def adapt_saccade(tree: Tree, source: BlockSource) -> list[Fault]:
    """Rewrites a single saccade as a glance, or a mode of the eyes as a rate of glances; that they end is a rate of 0.

    Returns the faults of what is left out.
    """
    single = {name: take_number(tree, name, source, low, high) for name, (low, high) in _SINGLE.items()}
    if any(value is not None for value in single.values()):
        return _glance(tree, source, **single)
    off = take(tree, "finish").lower() == "true"
    mode = take(tree, "mode").lower()
    if not off and mode not in _GLANCES:
        raise source.bad_attribute(tree, "mode", mode, RealizerError(UnknownWord(word=mode, known=tuple(_GLANCES))))
    faults = left_out(tree, source, "angle-limit")
    drop(tree, *OTHER_POINTS)
    tree.tag = f"{{{OWN}}}idleChange"
    tree.set("parameter", IdleParameter.GLANCE_RATE)
    tree.set("value", "0" if off else f"{_GLANCES[mode]:g}")
    return faults


def _glance(
    tree: Tree, source: BlockSource, magnitude: float | None, direction: float | None, duration: float | None
) -> list[Fault]:
    """Rewrites a saccade of a magnitude, degrees, in a direction, degrees: 0 is to the right, 90 up."""
    drop(tree, "finish", "mode", *OTHER_POINTS)
    faults = left_out(tree, source, "angle-limit")
    way = 3.0 if magnitude is None else magnitude
    angle = math.radians(45.0 if direction is None else direction)
    tree.tag = f"{{{OWN}}}glance"
    tree.set("left", f"{-way * math.cos(angle):.4g}")
    tree.set("up", f"{way * math.sin(angle):.4g}")
    if duration:
        tie(tree, "end", "start", duration)
    return faults
