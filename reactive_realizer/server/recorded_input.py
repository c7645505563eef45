"""Inputs in a recorded session: as a client would say them to the socket."""

from collections.abc import Mapping, Sequence
from typing import assert_never

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.errors import error
from reactive_realizer.realizer.inputs import BmlText, Event, Input, Prediction, TargetMoved
from reactive_realizer.server.protocol import Message, check


def message_of(entry: Input) -> Message:
    """The message of the protocol that says what an input says.

    A document that came as bytes has its ``encoding`` beside its ``xml``, so that it becomes the same bytes again.
    """
    match entry:
        case BmlText(text):
            return {"type": "bml", **_document(text)}
        case Prediction(anticipator, sync, time):
            return {"type": "predict", "anticipator": anticipator, "sync": sync, "time": time}
        case Event(anticipator, name, value, text):
            said = {key: what for key, what in (("value", value), ("text", text)) if what is not None}
            return {"type": "event", "anticipator": anticipator, "event": name, **said}
        case TargetMoved(target, position):
            return {"type": "world", "set": {target: position}}
        case _:
            assert_never(entry)


def input_of(message: Message) -> Input:
    """The input that a message of a recorded session says.

    Raises:
        RealizerError: "unknown-message" or "bad-message".
    """
    check(message)
    match message:
        case {"type": "bml"}:
            return BmlText(_text(message))
        case {"type": "predict", "anticipator": anticipator, "sync": sync, "time": time}:
            return Prediction(anticipator, sync, None if time is None else GlobalTime(time))
        case {"type": "event", "anticipator": anticipator, "event": name}:
            return Event(anticipator, name, message.get("value"), message.get("text"))
        case {"type": "world", "set": targets} if len(targets) == 1:
            return _moved(targets)
        case _:
            raise error("not-recorded", type=message["type"])


def _document(text: str | bytes) -> Mapping[str, str]:
    if isinstance(text, str):
        return {"xml": text}
    try:
        return {"xml": text.decode(), "encoding": "utf-8"}
    except UnicodeDecodeError:
        return {"xml": text.decode("latin-1"), "encoding": "latin-1"}


def _text(message: Message) -> str | bytes:
    xml, encoding = str(message["xml"]), message.get("encoding")
    if encoding is None:
        return xml
    try:
        return xml.encode(encoding)
    except (TypeError, LookupError, UnicodeEncodeError) as problem:
        raise error("bad-encoding") from problem


def _moved(targets: Mapping[str, Sequence[float] | None]) -> TargetMoved:
    ((target, position),) = targets.items()
    if position is None:
        return TargetMoved(target, None)
    x, y, z = position
    return TargetMoved(target, (x, y, z))
