"""Feedback as XML, in the forms of BML 1.0, and falls in the realizer's own namespace."""

import re
from collections.abc import Iterator
from functools import lru_cache, singledispatch
from typing import NamedTuple
from uuid import uuid4
from xml.sax.saxutils import escape

from lxml import etree

from reactive_realizer.bml.attributes import attributes_of
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.names import BML, BMLA, OWN, is_sync_id
from reactive_realizer.bml.writer import written
from reactive_realizer.feedback.messages import (
    BehaviorPrediction,
    BlockProgress,
    EmittedEvent,
    FallFeedback,
    Feedback,
    PredictionFeedback,
    SyncPointProgress,
    WarningFeedback,
)
from reactive_realizer.sized_cache import SizedCache

_DECIMALS = 6
_STATUS = f"{{{BMLA}}}status"
_OWN_TIME = f"{{{OWN}}}time"
_STAMPS = {"globalTime": "posixTime", "globalStart": "posixStartTime", "globalEnd": "posixEndTime"}
"""Attribute with a global time (s) -> the attribute for the same moment as POSIX time (ms)."""
_PREDICTION: dict[str | None, str] = {None: BML, "bmla": BMLA, "rr": OWN}
"""Namespaces of predictionFeedback, by prefix."""
_MARK = f"t{uuid4().hex}"
"""Marks the places of times in a template; no input contains it."""
_ATTRIBUTES: dict[type[Behavior], frozenset[str]] = {}
_TEMPLATE_BYTES = 16 * 1024 * 1024
"""Size of the templates that are kept: those of ten thousand nods, or of ten behaviors of the largest size."""
_TEMPLATE_BASE = 1400
"""Size of a template without its characters, bytes: its strings, lists and sets."""
_BMLA, _RR = f' xmlns:bmla="{BMLA}"', f' xmlns:rr="{OWN}"'
_ESCAPES = {'"': "&quot;", "\t": "&#9;", "\n": "&#10;", "\r": "&#13;"}
_PLAIN = re.compile(r"[\w:.+-]*").fullmatch
"""Matches values of attributes that are written as they are."""
_NOT_IN_NAMES = re.compile(r"[^\w.-]", re.ASCII)
_NOT_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
"""Characters that XML does not allow; the reason of a failure or the name of a plug-in may contain any."""


etree.register_namespace("bmla", BMLA)  # the prefix that lxml makes up if a message declares none


def to_xml(message: Feedback, epoch: float | None = None) -> str:
    """The message as one line of XML.

    Args:
        message: of feedback.
        epoch: POSIX time (s) of global time 0; if it is given, every global time is also written as POSIX time.
    """
    return "".join(xml_parts(message, epoch))


def xml_parts(message: Feedback, epoch: float | None = None) -> Iterator[str]:
    """As `to_xml`, in parts, one for each behavior of a prediction; each takes a short time to make."""
    if isinstance(message, SyncPointProgress):
        yield _sync_point_progress(message, epoch)
        return
    if isinstance(message, BlockProgress):
        yield _block_progress(message, epoch)
        return
    if isinstance(message, FallFeedback):
        yield _fall(message, epoch)
        return
    element = _element(message)
    if epoch is not None:
        add_posix_times(element, epoch)
    text = _line(element)
    if isinstance(message, PredictionFeedback):
        end = text.rindex("</")
        yield text[:end]
        for behavior in message.behaviors:
            yield _predicted(message.block, behavior)
        text = text[end:]
    yield text


def add_posix_times(element: etree._Element, epoch: float) -> None:
    """Add the POSIX time to every global time of a message, where POSIX time ``epoch`` (s) is global time 0."""
    for part in (element, *element.iterchildren(f"{{{BML}}}bml")):
        for name, stamp in _STAMPS.items():
            if (time := part.get(name)) is not None:
                part.set(f"{{{BMLA}}}{stamp}", _posix(time, epoch))


def _posix(time: str, epoch: float) -> str:
    """A written global time as POSIX time, ms."""
    return str(round(1000 * (epoch + float(time))))


def as_reported(time: float) -> float:
    """A time as feedback writes it."""
    return round(time, _DECIMALS)


def seconds(time: float) -> str:
    """A time with at most six decimals."""
    text = f"{time:.{_DECIMALS}f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def _block_progress(message: BlockProgress, epoch: float | None) -> str:
    time = seconds(message.time)
    id_ = _value(f"{message.block}:{message.sync}")
    own = f' globalTime="{time}" bmla:status="{message.status}"{_posix_time(time, epoch)}'
    return f'<blockProgress xmlns="{BML}"{_BMLA}{_character(message.character)} id="{id_}"{own}/>'


def _sync_point_progress(message: SyncPointProgress, epoch: float | None) -> str:
    """The message, written as text: in a fraction of the time, and there are many of these."""
    time, details, event = seconds(message.time), message.details, message.event
    spaces = (_RR if details or event else "") + ("" if epoch is None else _BMLA)
    id_ = _value(f"{message.block}:{message.behavior}:{message.sync}")
    own = f' time="{seconds(message.block_time)}" globalTime="{time}"'
    if details:
        own += "".join([f' rr:{_name(name)}="{_value(value)}"' for name, value in details.items()])
    own += _posix_time(time, epoch)
    text = f'<syncPointProgress xmlns="{BML}"{spaces}{_character(message.character)} id="{id_}"{own}/>'
    return text if event is None else _with_event(text, event)


def _fall(message: FallFeedback, epoch: float | None) -> str:
    time, space = seconds(message.time), "" if epoch is None else _BMLA
    id_ = _value(f"{message.block}:{message.behavior}")
    own = f'{_character(message.character)} id="{id_}" globalTime="{time}"{_posix_time(time, epoch)}'
    return f'<fall xmlns="{OWN}"{space}{own}/>'


def _character(id_: str) -> str:
    return f' characterId="{_value(id_)}"'


def _posix_time(time: str, epoch: float | None) -> str:
    return "" if epoch is None else f' bmla:posixTime="{_posix(time, epoch)}"'


@lru_cache
def _name(text: str) -> str:
    """A name that an engine has given to an attribute, with underscores for characters that no name may have."""
    name = _NOT_IN_NAMES.sub("_", text)
    return name if name[:1].isalpha() else f"_{name}"


def _value(text: str) -> str:
    """A text as the value of an attribute."""
    return text if _PLAIN(text) else escape(_legal(text), _ESCAPES)


def _with_event(text: str, event: EmittedEvent) -> str:
    element = etree.fromstring(text)
    child = etree.fromstring(f'<rr:event xmlns:rr="{OWN}">{event.content}</rr:event>')
    child.set("name", event.name)
    element.append(child)
    return _line(element)


def _line(element: etree._Element) -> str:
    return etree.tostring(element, encoding="unicode").replace("\n", " ")


@singledispatch
def _element(message: object) -> etree._Element:
    raise TypeError(f"no feedback: {message!r}")


@_element.register
def _(message: PredictionFeedback) -> etree._Element:
    element = _root("predictionFeedback", message.character, _PREDICTION)
    block = etree.SubElement(element, f"{{{BML}}}bml", id=_legal(message.block))
    block.set("globalStart", seconds(message.start))
    block.set("globalEnd", seconds(message.end))
    block.set(_STATUS, message.status)
    return element


@_element.register
def _(message: WarningFeedback) -> etree._Element:
    element = _root("warningFeedback", message.character, {None: BML})
    element.set("id", _legal(message.id))
    element.set("type", message.type)
    element.text = _legal(message.text)
    return element


def _legal(text: str) -> str:
    return _NOT_XML.sub("\N{REPLACEMENT CHARACTER}", text)


def _root(name: str, character: str | None, namespaces: dict[str | None, str]) -> etree._Element:
    # lxml takes None for the default namespace; its stubs do not.
    element = etree.Element(f"{{{BML}}}{name}", nsmap=namespaces)  # type: ignore[arg-type]
    if character is not None:
        element.set("characterId", _legal(character))
    return element


class _Template(NamedTuple):
    """An element in which times are left out: the text before, between and after them, and their sync points."""

    texts: list[str]
    syncs: list[str]


class _TemplateKey(NamedTuple):
    """The arguments of `_template`."""

    source: str
    id: str
    written: frozenset[str]
    own: frozenset[str]
    syncs: tuple[str, ...]


_TEMPLATES: SizedCache[_TemplateKey, _Template] = SizedCache(_TEMPLATE_BYTES)
"""The templates that were used last: a behavior is predicted again whenever its times move."""


def _predicted(block: str, prediction: BehaviorPrediction) -> str:
    """The behavior's own element, with times for its sync points; an inline sync of a speech has its own."""
    behavior, times = prediction.behavior, prediction.times
    points, attributes = frozenset(behavior.sync_points), _attributes(type(behavior))
    key = _TemplateKey(
        written(behavior),
        _legal(f"{block}:{behavior.id}"),
        frozenset(behavior.syncs),
        frozenset({sync for sync in times if sync in points or sync not in attributes}),
        tuple(times),
    )
    template = _TEMPLATES.get(key)
    if template is None:
        template = _template(*key)
        _TEMPLATES.add(key, template, _TEMPLATE_BASE + len(key.source) + sum(map(len, template.texts)))
    text = template.texts[0]
    for sync, following in zip(template.syncs, template.texts[1:], strict=True):
        text += seconds(times[sync]) + following
    return text


def _template(source: str, id_: str, written: frozenset[str], own: frozenset[str], syncs: tuple[str, ...]) -> _Template:
    """The element of a behavior with places for its times.

    A sync point is left out if its name cannot be an attribute, or is that of another attribute.

    Args:
        source: the element as it was written.
        id_: its id in feedback.
        written: the sync points that its attributes constrain.
        own: those of ``syncs`` that are not names of other attributes.
        syncs: the sync points that have times.
    """
    element = etree.fromstring(source)
    element.set("id", id_)
    for sync in written:
        if sync in element.attrib:  # points that were not written get their times too
            del element.attrib[sync]
    inline = {sync.get("id"): sync for sync in element.iter(f"{{{BML}}}sync", "sync")} if len(element) else {}
    for number, sync in enumerate(syncs):
        if sync in inline:
            inline[sync].set(_OWN_TIME, f"{_MARK}{number}.")
        elif sync in own and is_sync_id(sync):
            element.set(sync, f"{_MARK}{number}.")
    parent = etree.Element(f"{{{BML}}}predictionFeedback", nsmap=_PREDICTION)  # type: ignore[arg-type]
    parent.append(element)
    text = etree.tostring(parent, encoding="unicode").replace("\n", " ")
    texts = re.split(rf"{_MARK}([0-9]+)\.", text[text.index(">") + 1 : text.rindex("</")])
    return _Template(texts[::2], [syncs[int(number)] for number in texts[1::2]])


def _attributes(kind: type[Behavior]) -> frozenset[str]:
    """The names of the attributes of an element, except for sync points."""
    names = _ATTRIBUTES.get(kind)
    if names is None:
        names = _ATTRIBUTES[kind] = frozenset(each.name for each in attributes_of(kind))
    return names
