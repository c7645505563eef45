"""Noise of SmartBody: small random turns of joints."""

from reactive_realizer.bml.block_source import BlockSource
from reactive_realizer.bml.names import BMLT
from reactive_realizer.bml.smartbody.attributes import left_out, set_parameter, take, take_number
from reactive_realizer.bml.smartbody.joints import joint_named
from reactive_realizer.bml.trees import Tree
from reactive_realizer.errors import Fault

_SCALE, _FREQUENCY = 0.02, 0.03
"""Usual amplitude, rad, and frequency, Hz."""
_MOST_SCALE, _MOST_FREQUENCY = 3.0, 100.0


def adapt_noise(tree: Tree, source: BlockSource) -> list[Fault]:
    """Rewrites noise of one joint, in place, and returns the faults of what is left out."""
    scale = take_number(tree, "scale", source, 0.0, _MOST_SCALE)
    frequency = take_number(tree, "frequency", source, 0.0, _MOST_FREQUENCY)
    if tree.get("enable", "true").lower() != "false":
        take(tree, "enable")
    faults = left_out(tree, source, "enable")
    tree.tag = f"{{{BMLT}}}noise"
    tree.set("type", "perlin")
    if "joint" in tree.attrib:
        tree.set("joint", joint_named(tree.get("joint", "")))
    for axis in "xyz":
        set_parameter(tree, f"baseamplitude{axis}", f"{_SCALE if scale is None else scale:g}", source)
        set_parameter(tree, f"basefreq{axis}", f"{_FREQUENCY if frequency is None else frequency:g}", source)
    return faults
