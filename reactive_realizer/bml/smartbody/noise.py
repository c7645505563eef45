"""Noise of SmartBody: small random turns of joints."""

from typing import Final

from reactive_realizer.bml.block_source import BlockSource
from reactive_realizer.bml.names import BMLT
from reactive_realizer.bml.smartbody.attributes import left_out, set_parameter, take, take_number
from reactive_realizer.bml.smartbody.joints import joint_named
from reactive_realizer.bml.trees import Tree
from reactive_realizer.errors import Fault

_PARAMETERS: Final = {"baseamplitude": ("scale", 0.02, 3.0), "basefreq": ("frequency", 0.03, 100.0)}
"""Amplitude, rad, and frequency, Hz: names of parameters, to the attribute, its usual value and the greatest one."""


def adapt_noise(tree: Tree, source: BlockSource) -> list[Fault]:
    """Rewrites noise of one joint, in place, and returns the faults of what is left out."""
    values = {name: take_number(tree, written, source, 0.0, most) for name, (written, _, most) in _PARAMETERS.items()}
    if tree.get("enable", "true").lower() != "false":
        take(tree, "enable")
    faults = left_out(tree, source, "enable")
    tree.tag = f"{{{BMLT}}}noise"
    tree.set("type", "perlin")
    if "joint" in tree.attrib:
        tree.set("joint", joint_named(tree.get("joint", "")))
    known = {child.get("name") for child in tree}
    for name, value in values.items():
        _, usual, _ = _PARAMETERS[name]
        for each in (f"{name}{axis}" for axis in "xyz"):
            if each not in known:
                set_parameter(tree, each, f"{usual if value is None else value:g}", source)
    return faults
