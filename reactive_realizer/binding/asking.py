"""How a planner asks for what an entry of a binding plays."""

from lxml import etree

from reactive_realizer.binding.unit_spec import UnitSpec
from reactive_realizer.bml.attribute_types import Target
from reactive_realizer.bml.elements import ELEMENTS
from reactive_realizer.bml.names import BML, BMLT

_FROM_BEHAVIOR = frozenset({"file", "name"})
"""Parameters without which a unit that has no file of its own plays nothing."""


def asking(spec: UnitSpec, target: str) -> str | None:
    """The element of a behavior that says what an entry wants and no more.

    Args:
        spec: the entry.
        target: something to look and point at.

    Returns:
        The element as XML, its id is "word"; None where that is not enough: of an entry that plays any file, or noise
        on any joint, a behavior has to say which.
    """
    element = ELEMENTS.get(spec.behavior)
    attributes = element.attributes if element and element.namespace == spec.namespace else ()
    targets = {each.name: target for each in attributes if isinstance(each.type, Target)}
    said = {"id": "word", **targets, **spec.constraints}
    known = {"id", *(each.name for each in attributes)}
    missing = {each.name for each in attributes if each.required} - said.keys()
    mapped = {to for source, to in spec.parameter_map.items() if source not in said}
    if missing or mapped & _FROM_BEHAVIOR:
        return None
    tree = etree.Element(f"{{{spec.namespace}}}{spec.behavior}")
    for name, value in said.items():
        if name in known or name.startswith("{"):
            tree.set(name, value)
        elif name != "stance":
            etree.SubElement(tree, f"{{{BMLT}}}parameter", name=name, value=value)
    if element and "stance" in element.children:
        etree.SubElement(tree, f"{{{BML}}}stance", type=said.get("stance", "STANDING").upper())
    return etree.tostring(tree, encoding="unicode")
