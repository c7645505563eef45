"""Reads, checks and writes the text messages of the socket (protocol.json)."""

import json
import math
from base64 import b64decode
from collections.abc import Mapping, Sequence
from json.scanner import py_make_scanner  # type: ignore[attr-defined]
from pathlib import Path
from types import MappingProxyType
from typing import Any, Final, NamedTuple

from reactive_realizer.bml.block import Problem
from reactive_realizer.embodiment.audio import StreamedAudio
from reactive_realizer.embodiment.quaternion import Quat, normalize
from reactive_realizer.errors import RealizerError
from reactive_realizer.realizer.inputs import Push, TargetMoved
from reactive_realizer.server.faults import BadJson, BadMessage, TooManyValues, UnknownMessage
from reactive_realizer.server.schema import Schema, shown

VERSION: Final = 2
"""Increases only with changes that break clients."""

DOCUMENT: Final = Path(__file__).with_name("protocol.json").read_text(encoding="utf-8")
"""The JSON Schema of every message."""

_UNIT: Final = 1e-12
"""Difference of the length of a unit quaternion from 1."""

Message = Mapping[str, Any]

_NOTHING: Final[Message] = MappingProxyType({})

_SCHEMA = Schema(json.loads(DOCUMENT))


def _by_type(direction: str) -> Mapping[str, str]:
    names = [alternative["$ref"].rpartition("/")[2] for alternative in _SCHEMA.definitions[direction]["oneOf"]]
    return {_SCHEMA.definitions[name]["properties"]["type"]["const"]: name for name in names}


_FROM_CLIENT = _by_type("ClientMessage")
"""Names of definitions, by the type of the message."""


class Received(NamedTuple):
    """A message of a client as it was read.

    Attributes:
        message: checked; empty if it is refused.
        ref: that the answer must carry, also if it is refused.
        refusal: why it is refused, or None.
    """

    message: Message
    ref: str | int | None
    refusal: RealizerError | None


class NoNumber(RealizerError):
    """A JSON text that contains a NaN or an infinity.

    Attributes:
        message: the decoded message, with None for these numbers.
    """

    def __init__(self, number: str, message: Any) -> None:
        super().__init__(BadJson(reason=f"{number} is not a valid number"))
        self.message = message


class _Interruptible(json.JSONDecoder):
    """Decodes in Python, except for strings, so that a thread that decodes lets others run."""

    def __init__(self, **options: Any) -> None:
        super().__init__(**options)
        self.scan_once = py_make_scanner(self)


def decode(text: str | bytes, *, aside: bool = False) -> Any:
    """Decodes a JSON text.

    Args:
        text: the text.
        aside: whether a thread does so that must not hold up others, which takes longer.

    Raises:
        RealizerError: "bad-json".
        NoNumber: "bad-json" for NaN and infinities.
    """
    strange: list[str] = []
    try:
        message = json.loads(text, cls=_Interruptible if aside else None, parse_constant=strange.append)
    except (ValueError, RecursionError) as problem:
        raise RealizerError(BadJson(reason=str(problem))) from problem
    if strange:
        raise NoNumber(strange[0], message)
    return message


def encode(message: Message) -> str:
    """A message as ASCII text."""
    return json.dumps(message, separators=(",", ":"), allow_nan=False)


def check(message: Any) -> None:
    """Checks a message of a client.

    Raises:
        RealizerError: "unknown-message" or "bad-message", with the place in the message.
    """
    kind = message.get("type") if isinstance(message, dict) else None
    if not isinstance(kind, str) or kind not in _FROM_CLIENT:
        raise RealizerError(UnknownMessage(type=shown(kind), known=tuple(_FROM_CLIENT)))
    _SCHEMA.check(message, _FROM_CLIENT[kind], kind)


def push_of(message: Message) -> Push:
    """The push that a checked message requests."""
    x, y, z = message["force"]
    return Push(message["character"], message["joint"], (float(x), float(y), float(z)), message["duration"])


def moved_of(target: str, place: Any) -> TargetMoved:
    """The new place of a target in a checked message.

    Args:
        target: its name.
        place: a position, a position with an orientation, or None if the target is removed.

    Raises:
        RealizerError: "bad-message": the orientation is a quaternion of length 0.
    """
    match place:
        case {"position": [x, y, z], "orientation": [*quaternion]}:
            return TargetMoved(target, (float(x), float(y), float(z)), _orientation(target, quaternion))
        case [x, y, z]:
            return TargetMoved(target, (float(x), float(y), float(z)))
        case _:
            return TargetMoved(target, None)


def _orientation(target: str, quaternion: Sequence[float]) -> Quat:
    """The unit quaternion of an orientation; one that is recorded stays as it is, so that a replay is the same."""
    w, x, y, z = map(float, quaternion)
    try:
        unit = normalize((w, x, y, z))
    except ArithmeticError:
        reason = "a quaternion of length 0 is no orientation"
        raise RealizerError(BadMessage(place=f"set.{target}.orientation", reason=reason)) from None
    return (w, x, y, z) if math.isclose(math.hypot(w, x, y, z), 1.0, abs_tol=_UNIT) else unit


def streamed_of(message: Message) -> StreamedAudio:
    """The sound in a checked message.

    Raises:
        RealizerError: "bad-message": it is not in base64.
    """
    try:
        audio = b64decode(message.get("audio", ""), validate=True)
    except ValueError as problem:
        raise RealizerError(BadMessage(place="audio", reason="it is not in base64")) from problem
    words = tuple((str(word), float(begin)) for word, begin in message.get("words", ()))
    return StreamedAudio(message["stream"], audio, words, message.get("end", False))


def read(text: str | bytes, most: int, kind: str | None = None, *, aside: bool = False) -> Received:
    """Decodes and checks a message of a client.

    Args:
        text: the message.
        most: how many values it may have.
        kind: its type, if it does not contain it.
        aside: as for `decode`.
    """
    message = None
    try:
        message = decode(text, aside=aside)
        if kind is not None and isinstance(message, dict):
            message["type"] = kind
        if aside and _exceeds(message, most):  # only a long one can
            raise RealizerError(TooManyValues(limit=most))
        check(message)
    except NoNumber as refusal:
        return Received({}, ref_of(refusal.message), refusal)
    except RealizerError as refusal:
        return Received({}, ref_of(message), refusal)
    return Received(message, ref_of(message), None)


def _exceeds(value: Any, most: int) -> bool:
    """Whether a decoded text has more values than some number; it is not nested deeply, as it was decoded."""
    waiting, found = [value], 1
    while waiting and found <= most:
        value = waiting.pop()
        inner = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
        found += len(inner)
        waiting += (each for each in inner if isinstance(each, dict | list))
    return found > most


def ref_of(message: Any) -> str | int | None:
    """The ref that the answer to a message must carry, even if the message is otherwise invalid."""
    ref = message.get("ref") if isinstance(message, dict) else None
    return ref if ref is not None and _SCHEMA.accepts(ref, "Ref") else None


def bml_answer(blocks: Sequence[str], warnings: Sequence[Problem], most: int) -> Message:
    """The part of an answer that BML gets.

    Args:
        blocks: ids of the accepted blocks.
        warnings: what is known of the document to be wrong.
        most: how many warnings are listed; the others are counted.
    """
    listed = [_warning(each) for each in warnings[:most]]
    more = {"more_warnings": len(warnings) - most} if len(warnings) > most else {}
    return {"blocks": blocks, "warnings": listed, **more}


def _warning(problem: Problem) -> Message:
    fault = problem.fault
    place = {name: value for name, value in (("line", fault.line), ("column", fault.column)) if value is not None}
    return {"id": problem.id, "type": fault.warning, "code": fault.code, **place, "message": fault.sentence}


def accepted(ref: str | int, more: Message) -> Message:
    """The answer to an accepted message.

    Args:
        ref: of the message.
        more: for BML, its `bml_answer`; otherwise empty.
    """
    return {"type": "accepted", "ref": ref, **more}


def refused(refusal: RealizerError, ref: str | int | None = None, more: Message = _NOTHING) -> Message:
    """The answer to a refused message.

    Args:
        refusal: of the message, or of the first block that was refused.
        ref: of the message, if it has one.
        more: for BML, its `bml_answer`; otherwise empty.
    """
    answer = {"type": "error", "code": refusal.fault.code, "message": str(refusal.fault)}
    return answer | ({} if ref is None else {"ref": ref}) | dict(more)
