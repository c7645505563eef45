"""From an element to a behavior."""

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any, Final

from reactive_realizer.bml.attributes import attributes_of
from reactive_realizer.bml.behavior import Behavior, Description, ForeignBehavior
from reactive_realizer.bml.behaviors import Speech
from reactive_realizer.bml.continuous import ParameterValueChange
from reactive_realizer.bml.elements import ELEMENTS, Element
from reactive_realizer.bml.face import Face, FaceShift
from reactive_realizer.bml.parts import read_change, read_face, read_interpolator, read_parameters, read_posture
from reactive_realizer.bml.posture import Posture, PostureShift
from reactive_realizer.bml.procedure import PROCEDURES
from reactive_realizer.bml.source import Source
from reactive_realizer.bml.speech_reader import read_speech
from reactive_realizer.bml.trees import (
    PARAMETER,
    Tree,
    attributes_in,
    children_of,
    is_continuous,
    is_core,
    listed,
    name_of,
    names_in,
    namespace_of,
)
from reactive_realizer.bml.twente import Keyframe
from reactive_realizer.errors import Fault, RealizerError

_DESCRIPTION: Final = "description"
_FOREIGN_ATTRIBUTES: Final = attributes_of(ForeignBehavior)
_READ_PARTS: Final[Mapping[type[Behavior], Callable[[Tree, Source, list[Fault]], dict[str, Any]]]] = {
    Speech: read_speech,
    Face: read_face,
    FaceShift: read_face,
    Posture: read_posture,
    PostureShift: read_posture,
    ParameterValueChange: read_change,
    Keyframe: read_interpolator,
}


def read_behavior(tree: Tree, source: Source, order: int, required: bool, notes: list[Fault]) -> Behavior:
    """The behavior that an element writes.

    Args:
        tree: the element.
        source: its block.
        order: of the behavior in the block.
        required: whether the block fails without it.
        notes: takes the faults that do not prevent it.

    Raises:
        RealizerError: it is none, or an attribute or child that it needs is missing or bad.
    """
    element = _element_of(tree)
    if element is None and is_core(tree):
        known = [name for name, each in ELEMENTS.items() if not each.continuous]
        raise RealizerError(source.fault(tree, "unknown-behavior", known=listed(known)))
    place = {"order": order, "required": required}
    return _known(tree, element, source, place, notes) if element else _foreign(tree, source, place)


def _element_of(tree: Tree) -> Element | None:
    element = ELEMENTS.get(name_of(tree))
    return element if element and namespace_of(tree) in element.namespaces else None


def _known(tree: Tree, element: Element, source: Source, place: dict[str, Any], notes: list[Fault]) -> Behavior:
    values = place | source.written(tree) | source.values(tree, element.attributes)
    if element.behavior in _READ_PARTS:
        values |= _READ_PARTS[element.behavior](tree, source, notes)
    values["namespace"] = namespace = namespace_of(tree) if element.continuous else element.namespace
    points = [*element.behavior.tied_by(values), *_own_points(tree, element, source)]
    names = [*element.names, *points]
    notes += source.unread_but_foreign(tree, names, [*element.children, _DESCRIPTION, PARAMETER])
    return element.behavior(
        **values,
        syncs=element.behavior.tied(source.syncs(tree, points), namespace),
        parameters=read_parameters(tree, source, notes),
        descriptions=_descriptions(tree, source, notes),
    )


def _own_points(tree: Tree, element: Element, source: Source) -> list[str]:
    """The attributes of one of BMLT's motions that tie points of its own: each holds a reference, nothing else."""
    if not (element.continuous and element.behavior.OPEN_POINTS):
        return []
    known = {*element.names, *element.sync_points}
    return [name for name in names_in(tree) if name not in known and source.holds_ref(tree, name)]


def _descriptions(tree: Tree, source: Source, notes: list[Fault]) -> tuple[Description, ...]:
    """Those that can be read: without the others the behavior is still what it is."""
    descriptions = []
    for child in children_of(tree, _DESCRIPTION):
        try:
            values = source.values(child, attributes_of(Description))
            content = source.content(child)
            descriptions.append(Description(**values, content=content, behavior=_described(tree, child, source, notes)))
        except RealizerError as refused:
            notes.append(refused.fault)
    return tuple(descriptions)


def _described(tree: Tree, description: Tree, source: Source, notes: list[Fault]) -> Behavior | None:
    """The one behavior inside a description, if it is one that can be realized.

    Raises:
        RealizerError: it cannot be read.
    """
    inside = list(description)
    element = _element_of(inside[0]) if len(inside) == 1 else None
    if element is None:
        return None
    inside[0].set("id", tree.get("id", ""))
    return _known(inside[0], element, source, {"order": 0, "required": False}, notes)


def _foreign(tree: Tree, source: Source, place: dict[str, Any]) -> Behavior:
    if is_continuous(tree) and name_of(tree) in PROCEDURES:
        raise RealizerError(source.fault(tree, "procedure-in-block"))
    values = place | source.written(tree) | source.values(tree, _FOREIGN_ATTRIBUTES)
    syncs = source.syncs(tree, ForeignBehavior.SYNC_POINTS)
    read = {*syncs, *(each.name for each in _FOREIGN_ATTRIBUTES)}
    others = {name: value for name, value in attributes_in(tree).items() if name not in read}
    return ForeignBehavior(
        **values,
        namespace=namespace_of(tree),
        syncs=syncs,
        attributes=MappingProxyType(others),
        children=source.content(tree),
    )
