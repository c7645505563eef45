"""Reads the murml-description inside a behavior, and those that are descriptions of other behaviors."""

from typing import Any

from lxml import etree

from reactive_realizer.bml.block_source import BlockSource
from reactive_realizer.bml.faults import MissingElement
from reactive_realizer.bml.murml.behaviors import DESCRIPTION
from reactive_realizer.bml.murml.description import Scope
from reactive_realizer.bml.murml.faults import MurmlNotRealized, NothingToPlay
from reactive_realizer.bml.murml.reader import MurmlReader
from reactive_realizer.bml.names import MURML
from reactive_realizer.bml.trees import Tree, children_of, name_of, namespace_of
from reactive_realizer.errors import Fault, RealizerError

_GESTURE, _FACE = "murmlgesture", "murmlface"
_MODE = "mode"
"""Attribute with the arm of the gesture that a description describes."""

_SCOPES = {"LEFT_HAND": Scope.LEFT}


def read_murml(tree: Tree, source: BlockSource, notes: list[Fault]) -> dict[str, Any]:
    """The description of a behavior; what cannot be read of it is left out with notes.

    Raises:
        RealizerError: there is none, or nothing of it can be played.
    """
    inside = children_of(tree, DESCRIPTION)
    if not inside:
        missing = MissingElement(element=name_of(tree), children=f"<{DESCRIPTION}>")
        raise RealizerError(source.located(tree, missing))
    reader = MurmlReader(source.location, _SCOPES.get(_mode_around(tree), Scope.RIGHT), source.limits)
    description = reader.read(inside[0])
    notes += reader.notes
    content = source.xml(inside[0])
    if name_of(tree) != _FACE:
        return {"description": description, "content": content}
    if description.keyframing is None:
        raise RealizerError(source.located(inside[0], NothingToPlay(element=_FACE)))
    if description.keyframing.added:
        kept = MurmlNotRealized(feature="applymode='superpose'", reason="frames of a face replace what plays below")
        notes.append(source.located(inside[0], kept))
    return {"keyframing": description.keyframing, "content": content}


def wrapped(child: Tree, core: Tree, description: Tree, source: BlockSource) -> Tree:
    """The content of a description level: a `murml-description` becomes that of a behavior, others stay.

    Args:
        child: the content.
        core: the behavior that it describes.
        description: the description level.
        source: of their locations.
    """
    if namespace_of(child) != MURML or name_of(child) != DESCRIPTION:
        return child
    is_face = description.get("type") == _FACE or name_of(core).startswith("face")
    namespaces: Any = {None: MURML}  # lxml takes None for the default namespace; its stubs do not
    behavior = etree.Element(f"{{{MURML}}}{_FACE if is_face else _GESTURE}", nsmap=namespaces)
    description.append(behavior)
    source.place(behavior, child)
    behavior.append(child)
    return behavior


def _mode_around(tree: Tree) -> str:
    """The mode of the gesture that the behavior describes; empty if it stands alone."""
    holder = tree.getparent()
    core = holder.getparent() if holder is not None and name_of(holder) == "description" else None
    return core.get(_MODE, "").strip().upper().replace("-", "_") if core is not None else ""
