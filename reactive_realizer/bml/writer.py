"""Writes behaviors as elements, for those that were read from another language than XML."""

from collections.abc import Iterator
from typing import Any

from lxml import etree

from reactive_realizer.bml.attributes import Attribute, attributes_of
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import Face, Posture, Speech
from reactive_realizer.bml.trees import Tree


def written(behavior: Behavior) -> str:
    """The element of a behavior: as it was written, or else in the words of BML 1.0."""
    return behavior.source or etree.tostring(_element(behavior), encoding="unicode")


def _element(behavior: Behavior) -> Tree:
    # lxml takes None for the default namespace; its stubs do not.
    namespaces: Any = {None: behavior.namespace}
    element = etree.Element(f"{{{behavior.namespace}}}{behavior.name}", _attributes(behavior), nsmap=namespaces)
    for sync, ref in behavior.syncs.items():
        element.set(sync, str(ref))
    for (namespace, name), value in behavior.extensions.items():
        element.set(f"{{{namespace}}}{name}", value)
    element.extend(_children(behavior))
    return element


def _attributes(part: Any) -> dict[str, str]:
    values = ((each, getattr(part, each.field)) for each in attributes_of(type(part)))
    return {each.name: _text(value) for each, value in values if _is_said(each, value)}


def _is_said(attribute: Attribute, value: object) -> bool:
    return value is not None and value != "" and (attribute.required or value != attribute.default)


def _text(value: object) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, tuple):
        return ",".join(map(str, value))
    return f"{value:g}" if isinstance(value, float) else str(value)


def _children(behavior: Behavior) -> Iterator[Tree]:
    if isinstance(behavior, Speech):
        yield _text_of(behavior)
    if isinstance(behavior, Face):
        yield from map(_element, behavior.parts)
    if isinstance(behavior, Posture):
        if behavior.stance is not None:
            yield _part(behavior, "stance", {"type": str(behavior.stance)})
        yield from (_part(behavior, "pose", _attributes(pose)) for pose in behavior.poses)


def _text_of(speech: Speech) -> Tree:
    """The ``<text>`` of a speech, with its marks."""
    ends = [*(mark.char_index for mark in speech.marks[1:]), len(speech.text)]
    text = _part(speech, "text", {})
    text.text = speech.text[: speech.marks[0].char_index] if speech.marks else speech.text
    for mark, end in zip(speech.marks, ends, strict=False):
        sync = _part(speech, "sync", {"id": mark.id})
        sync.tail = speech.text[mark.char_index : end]
        text.append(sync)
    return text


def _part(behavior: Behavior, name: str, attributes: dict[str, str]) -> Tree:
    return etree.Element(f"{{{behavior.namespace}}}{name}", attributes)
