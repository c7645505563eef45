"""Writes behaviors as elements, for those that were read from another language, or in an older spelling."""

from collections.abc import Callable, Iterator, Mapping
from types import MappingProxyType
from typing import Any, Final

from lxml import etree

from reactive_realizer.bml.attributes import Attribute, attributes_of
from reactive_realizer.bml.behavior import Behavior, Description
from reactive_realizer.bml.behaviors import Face, Posture, Wait
from reactive_realizer.bml.extensions import BehaviorParameter, FaceKeyframe, Keyframe, ParameterValueChange
from reactive_realizer.bml.key_poses import KeyPose, KeyPoses
from reactive_realizer.bml.murml.behaviors import MurmlFace, MurmlGesture
from reactive_realizer.bml.names import BMLT
from reactive_realizer.bml.speech import Speech
from reactive_realizer.bml.trees import PARAMETER, Tree

_DIGITS: Final = 15
"""Digits of numbers, which are read as they were."""


def written(behavior: Behavior) -> str:
    """The element of a behavior: as it was written, or else in the words of BML 1.0."""
    return behavior.source or etree.tostring(behavior_element(behavior), encoding="unicode")


def behavior_element(behavior: Behavior) -> Tree:
    """The element of a behavior in the words of BML 1.0 and its extensions; not of a `ForeignBehavior`."""
    # lxml takes None for the default namespace; its stubs do not.
    namespaces: Any = {None: behavior.namespace}
    element = etree.Element(f"{{{behavior.namespace}}}{behavior.name}", attribute_texts(behavior), nsmap=namespaces)
    for sync, ref in behavior.syncs.items():
        if not (sync == "end" and isinstance(behavior, Wait) and behavior.event is not None):
            element.set(sync, str(ref))
    for (namespace, name), value in behavior.extensions.items():
        element.set(f"{{{namespace}}}{name}", value)
    element.extend(_children(behavior))
    return element


def attribute_texts(part: Any) -> dict[str, str]:
    """The attributes of a part of BML that differ from their defaults, by the names that are in no namespace."""
    values = ((each, getattr(part, each.field)) for each in attributes_of(type(part)))
    return {each.name: text_of(value) for each, value in values if _is_said(each, value)}


def _is_said(attribute: Attribute, value: object) -> bool:
    return value is not None and value != "" and (attribute.required or value != attribute.default)


def text_of(value: object) -> str:
    """The text of a value of an attribute."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, tuple):
        # A vector, or ids.
        return (" " if value and isinstance(value[0], float) else ",").join(map(text_of, value))
    return f"{value:.{_DIGITS}g}" if isinstance(value, float) else str(value)


def _children(behavior: Behavior) -> Iterator[Tree]:
    for kind, children in _CHILDREN.items():
        if isinstance(behavior, kind):
            yield from children(behavior)
    for name, value in behavior.parameters.items():
        yield etree.Element(f"{{{BMLT}}}{PARAMETER}", attribute_texts(BehaviorParameter(name=name, value=value)))
    for description in behavior.descriptions:
        yield _description(behavior, description)


def _posture(posture: Posture) -> Iterator[Tree]:
    if posture.stance is not None:
        yield _part(posture, "stance", {"type": str(posture.stance)})
    yield from (_part(posture, "pose", attribute_texts(pose)) for pose in posture.poses)


def _key_poses(poses: KeyPoses) -> Iterator[Tree]:
    for pose in poses.poses:
        element = _part(poses, KeyPose.ELEMENT, attribute_texts(pose))
        element.extend(_part(poses, goal.ELEMENT, attribute_texts(goal)) for goal in pose.goals)
        yield element


def _interpolator(behavior: Keyframe | FaceKeyframe) -> Iterator[Tree]:
    if behavior.interpolator is not None:
        yield etree.fromstring(behavior.interpolator)


def _murml(behavior: MurmlGesture | MurmlFace) -> Iterator[Tree]:
    yield etree.fromstring(behavior.content)


def _text(speech: Speech) -> Iterator[Tree]:
    """The ``<text>`` of a speech, with its marks."""
    ends = [*(mark.char_index for mark in speech.marks[1:]), len(speech.text)]
    text = _part(speech, "text", {})
    text.text = speech.text[: speech.marks[0].char_index] if speech.marks else speech.text
    for mark, end in zip(speech.marks, ends, strict=False):
        sync = _part(speech, "sync", attribute_texts(mark))
        sync.tail = speech.text[mark.char_index : end]
        text.append(sync)
    yield text


_CHILDREN: Final[Mapping[type[Behavior], Callable[[Any], Iterator[Tree]]]] = MappingProxyType(
    {
        Speech: _text,
        Face: lambda face: map(behavior_element, face.parts),
        Posture: _posture,
        ParameterValueChange: lambda change: iter([_part(change, "trajectory", attribute_texts(change.trajectory))]),
        Keyframe: _interpolator,
        FaceKeyframe: _interpolator,
        KeyPoses: _key_poses,
        MurmlGesture: _murml,
        MurmlFace: _murml,
    }
)
"""The content of elements."""


def _description(behavior: Behavior, description: Description) -> Tree:
    element = etree.fromstring(f'<description xmlns="{behavior.namespace}">{description.content}</description>')
    for name, value in attribute_texts(description).items():
        element.set(name, value)
    return element


def _part(behavior: Behavior, name: str, attributes: dict[str, str]) -> Tree:
    return etree.Element(f"{{{behavior.namespace}}}{name}", attributes)
