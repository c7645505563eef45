"""Feedback as XML, in the forms of BML 1.0 (blockProgress, syncPointProgress, predictionFeedback, warningFeedback)."""

import re
from functools import singledispatch

from lxml import etree

from reactive_realizer.bml.attributes import attributes_of
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.names import BML, BMLA, OWN, is_sync_id
from reactive_realizer.feedback.messages import (
    BehaviorPrediction,
    BlockProgress,
    EmittedEvent,
    Feedback,
    PredictionFeedback,
    SyncPointProgress,
    WarningFeedback,
)

_DECIMALS = 6
_STATUS = f"{{{BMLA}}}status"
_OWN_TIME = f"{{{OWN}}}time"
_NOT_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
"""Characters that XML does not allow; the reason of a failure or the name of a plug-in may contain any."""


def to_xml(message: Feedback) -> str:
    """The message as one line of XML."""
    return etree.tostring(_element(message), encoding="unicode").replace("\n", " ")


def as_reported(time: float) -> float:
    """A time as feedback writes it."""
    return round(time, _DECIMALS)


def seconds(time: float) -> str:
    """A time with at most six decimals."""
    text = f"{time:.{_DECIMALS}f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


@singledispatch
def _element(message: object) -> etree._Element:
    raise TypeError(f"no feedback: {message!r}")


@_element.register
def _(message: BlockProgress) -> etree._Element:
    element = _root("blockProgress", message.character, {None: BML, "bmla": BMLA})
    element.set("id", _legal(f"{message.block}:{message.sync}"))
    element.set("globalTime", seconds(message.time))
    element.set(_STATUS, message.status)
    return element


@_element.register
def _(message: SyncPointProgress) -> etree._Element:
    own = bool(message.details or message.event)
    element = _root("syncPointProgress", message.character, {None: BML, **({"rr": OWN} if own else {})})
    element.set("id", _legal(f"{message.block}:{message.behavior}:{message.sync}"))
    element.set("time", seconds(message.block_time))
    element.set("globalTime", seconds(message.time))
    for name, value in message.details.items():
        element.set(f"{{{OWN}}}{name}", _legal(value))
    if message.event is not None:
        element.append(_event(message.event))
    return element


@_element.register
def _(message: PredictionFeedback) -> etree._Element:
    element = _root("predictionFeedback", message.character, {None: BML, "bmla": BMLA, "rr": OWN})
    block = etree.SubElement(element, f"{{{BML}}}bml", id=_legal(message.block))
    block.set("globalStart", seconds(message.start))
    block.set("globalEnd", seconds(message.end))
    block.set(_STATUS, message.status)
    element.extend(_predicted(message.block, behavior) for behavior in message.behaviors)
    return element


@_element.register
def _(message: WarningFeedback) -> etree._Element:
    element = _root("warningFeedback", message.character, {None: BML})
    element.set("id", _legal(message.id))
    element.set("type", message.type)
    element.text = _legal(message.text)
    return element


def _event(event: EmittedEvent) -> etree._Element:
    element = etree.fromstring(f'<rr:event xmlns:rr="{OWN}">{event.content}</rr:event>')
    element.set("name", event.name)
    return element


def _legal(text: str) -> str:
    return _NOT_XML.sub("\N{REPLACEMENT CHARACTER}", text)


def _root(name: str, character: str | None, namespaces: dict[str | None, str]) -> etree._Element:
    # lxml takes None for the default namespace; its stubs do not.
    element = etree.Element(f"{{{BML}}}{name}", nsmap=namespaces)  # type: ignore[arg-type]
    if character is not None:
        element.set("characterId", _legal(character))
    return element


def _predicted(block: str, prediction: BehaviorPrediction) -> etree._Element:
    """The behavior's own element, with times for its sync points; an inline sync of a speech carries its time itself.

    A sync point is left out if its name cannot be an attribute, or is that of another attribute.
    """
    behavior = prediction.behavior
    element = etree.fromstring(behavior.source)
    element.set("id", _legal(f"{block}:{behavior.id}"))
    for sync in behavior.syncs:
        if sync in element.attrib:  # points that were not written get their times too
            del element.attrib[sync]
    inline = {sync.get("id"): sync for sync in element.iter(f"{{{BML}}}sync", "sync")} if len(element) else {}
    for sync, time in prediction.times.items():
        if sync in inline:
            inline[sync].set(_OWN_TIME, seconds(time))
        elif is_sync_id(sync) and (sync in behavior.sync_points or sync not in _attributes(behavior)):
            element.set(sync, seconds(time))
    return element


def _attributes(behavior: Behavior) -> set[str]:
    return {each.name for each in attributes_of(type(behavior))}
