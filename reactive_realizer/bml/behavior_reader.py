"""Reads a behavior from its element."""

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any, Final

from reactive_realizer.bml.attributes import attributes_of
from reactive_realizer.bml.behavior import Behavior, Description, ForeignBehavior
from reactive_realizer.bml.behavior_parts import (
    read_event,
    read_face,
    read_interpolator,
    read_parameters,
    read_posture,
    read_speech,
    read_trajectory,
)
from reactive_realizer.bml.behaviors import Face, FaceShift, Posture, PostureShift
from reactive_realizer.bml.block import PROCEDURES
from reactive_realizer.bml.block_source import BlockSource
from reactive_realizer.bml.elements import ELEMENTS, Element
from reactive_realizer.bml.extensions import Emit, FaceKeyframe, Keyframe, ParameterValueChange
from reactive_realizer.bml.faults import ProcedureInBlock, UnknownBehavior
from reactive_realizer.bml.key_pose_reader import read_key_poses
from reactive_realizer.bml.key_poses import KeyPoses
from reactive_realizer.bml.murml.behavior_part import read_murml, wrapped
from reactive_realizer.bml.murml.behaviors import MurmlFace, MurmlGesture
from reactive_realizer.bml.speech import Speech
from reactive_realizer.bml.speech_descriptions import read_speech_description, unspoken, unused_times
from reactive_realizer.bml.trees import (
    PARAMETER,
    Tree,
    attributes_in,
    children_of,
    is_continuous,
    is_core,
    name_of,
    names_in,
    namespace_of,
)
from reactive_realizer.errors import Fault, RealizerError

_DESCRIPTION: Final = "description"
_FOREIGN_ATTRIBUTES: Final = attributes_of(ForeignBehavior)
_READ_PARTS: Final[Mapping[type[Behavior], Callable[[Tree, BlockSource, list[Fault]], dict[str, Any]]]] = {
    Speech: read_speech,
    Face: read_face,
    FaceShift: read_face,
    Posture: read_posture,
    PostureShift: read_posture,
    ParameterValueChange: read_trajectory,
    Keyframe: read_interpolator,
    FaceKeyframe: read_interpolator,
    Emit: read_event,
    KeyPoses: read_key_poses,
    MurmlGesture: read_murml,
    MurmlFace: read_murml,
}


def read_behavior(tree: Tree, source: BlockSource, order: int, required: bool, notes: list[Fault]) -> Behavior:
    """The behavior in an element.

    Args:
        tree: the element.
        source: its block.
        order: of the behavior in the block.
        required: whether the block fails without it.
        notes: receives the faults that do not prevent reading it.

    Raises:
        RealizerError: the element is no behavior, or an attribute or child that it needs is missing or bad.
    """
    element = _element_of(tree)
    if element is None and is_core(tree):
        known = tuple(name for name, each in ELEMENTS.items() if each.core)
        raise RealizerError(source.located(tree, UnknownBehavior(element=name_of(tree), known=known)))
    place = {"order": order, "required": required}
    return _known(tree, element, source, place, notes) if element else _foreign(tree, source, place)


def _element_of(tree: Tree) -> Element | None:
    element = ELEMENTS.get(name_of(tree))
    return element if element and namespace_of(tree) in element.namespaces else None


def _known(tree: Tree, element: Element, source: BlockSource, place: dict[str, Any], notes: list[Fault]) -> Behavior:
    values = place | source.element_fields(tree) | source.values(tree, element.attributes)
    if element.behavior in _READ_PARTS:
        values |= _READ_PARTS[element.behavior](tree, source, notes)
    values["namespace"] = namespace = namespace_of(tree) if element.continuous else element.namespace
    points = [*element.sync_points, *_own_points(tree, element, source)]
    names = [*element.names, *points]
    if element.behavior.ANY_CONTENT:
        notes += source.unknown_attributes(tree, names)
    else:
        notes += source.unknown_core_content(tree, names, [*element.children, _DESCRIPTION, PARAMETER])
        values["parameters"] = read_parameters(tree, source, notes)
        values["descriptions"] = _descriptions(tree, element, values, source, notes)
    try:
        syncs = element.behavior.complete_syncs(source.syncs(tree, points), values, namespace)
    except RealizerError as refused:
        raise RealizerError(source.located(tree, refused.fault)) from None
    return element.behavior(**values, syncs=syncs)


def _own_points(tree: Tree, element: Element, source: BlockSource) -> list[str]:
    """The attributes of a motion in an extension that tie sync points of its own: those that hold a reference."""
    if element.core or not element.behavior.OPEN_POINTS:
        return []
    known = {*element.names, *element.sync_points}
    return [name for name in names_in(tree) if name not in known and source.holds_ref(tree, name)]


def _descriptions(
    tree: Tree, element: Element, core: Mapping[str, Any], source: BlockSource, notes: list[Fault]
) -> tuple[Description, ...]:
    """The descriptions that can be read; the behavior plays without the others.

    Args:
        tree: the behavior that they describe.
        element: of the behavior.
        core: values of the behavior, by field.
        source: its block.
        notes: receives the faults that do not prevent reading it.
    """
    descriptions: dict[Tree, Description] = {}
    for child in children_of(tree, _DESCRIPTION):
        try:
            values = source.values(child, attributes_of(Description))
            content = source.content(child)
            behavior: Behavior | None = None
            if element.behavior is Speech:
                behavior = read_speech_description(child, values["type"], core, source, notes)
            behavior = behavior or _described(tree, child, source, notes)
            descriptions[child] = Description(**values, content=content, behavior=behavior)
        except RealizerError as refused:
            notes.append(refused.fault)
    if element.behavior is Speech:
        notes += unspoken(descriptions, source)
        notes += unused_times(tree, core["marks"], descriptions.values(), source)
    return tuple(descriptions.values())


def _described(tree: Tree, description: Tree, source: BlockSource, notes: list[Fault]) -> Behavior | None:
    """The one behavior inside a description, None if it is not one of `ELEMENTS`.

    Raises:
        RealizerError: it cannot be read.
    """
    inside = [wrapped(child, tree, description, source) for child in list(description)]
    element = _element_of(inside[0]) if len(inside) == 1 else None
    if element is None:
        return None
    inside[0].set("id", tree.get("id", ""))
    return _known(inside[0], element, source, {"order": 0, "required": False}, notes)


def _foreign(tree: Tree, source: BlockSource, place: dict[str, Any]) -> Behavior:
    if is_continuous(tree) and name_of(tree) in PROCEDURES:
        raise RealizerError(source.located(tree, ProcedureInBlock(element=name_of(tree))))
    values = place | source.element_fields(tree) | source.values(tree, _FOREIGN_ATTRIBUTES)
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
