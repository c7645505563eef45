"""The text messages of the socket: read, checked against protocol.json, written."""

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final

from reactive_realizer.errors import Fault, RealizerError, error
from reactive_realizer.server.schema import Schema

VERSION: Final = 1
"""Rises only when an old client would break."""

DOCUMENT: Final = Path(__file__).with_name("protocol.json").read_text(encoding="utf-8")
"""The JSON Schema of every message."""

Message = Mapping[str, Any]

_SCHEMA = Schema(json.loads(DOCUMENT))
_MOST_SHOWN = 60


def _by_type(direction: str) -> dict[str, Message]:
    names = [alternative["$ref"].rpartition("/")[2] for alternative in _SCHEMA.definitions[direction]["oneOf"]]
    nodes = [_SCHEMA.definitions[name] for name in names]
    return {node["properties"]["type"]["const"]: node for node in nodes}


_FROM_CLIENT = _by_type("ClientMessage")


class NoNumber(RealizerError):
    """A text would be JSON, but for a NaN or an infinity in it.

    Attributes:
        message: what it says otherwise.
    """

    def __init__(self, number: str, message: Any) -> None:
        super().__init__(Fault("bad-json", {"reason": f"{number} is no number"}))
        self.message = message


def decode(text: str | bytes) -> Any:
    """What a JSON text says.

    Raises:
        RealizerError: "bad-json".
        NoNumber: "bad-json" for NaN and infinities.
    """
    strange: list[str] = []
    try:
        message = json.loads(text, parse_constant=strange.append)
    except (ValueError, RecursionError) as problem:
        raise error("bad-json", reason=problem) from problem
    if strange:
        raise NoNumber(strange[0], message)
    return message


def encode(message: Message) -> str:
    """A message as ASCII text."""
    return json.dumps(message, separators=(",", ":"), allow_nan=False)


def check(message: Any) -> None:
    """Whether a client may say that.

    Raises:
        RealizerError: "unknown-message" or "bad-message", with the place in the message.
    """
    kind = message.get("type") if isinstance(message, dict) else None
    if not isinstance(kind, str) or kind not in _FROM_CLIENT:
        raise error("unknown-message", type=_shown(kind), known=", ".join(_FROM_CLIENT))
    wrong = _SCHEMA.mismatch(message, _FROM_CLIENT[kind])
    if wrong is not None:
        raise error("bad-message", place=wrong.place or kind, value=_shown(wrong.value), rule=wrong.rule)


def ref_of(message: Any) -> str | int | None:
    """What an answer to a message must bear, even where the rest of the message is wrong."""
    ref = message.get("ref") if isinstance(message, dict) else None
    return None if ref is None or _SCHEMA.mismatch(ref, _SCHEMA.definitions["Ref"]) else ref


def accepted(ref: str | int, blocks: Sequence[str] | None = None) -> Message:
    """The answer to a message that has entered; of BML, with the ids of its blocks."""
    answer = {"type": "accepted", "ref": ref}
    return answer if blocks is None else answer | {"blocks": blocks}


def refused(refusal: RealizerError, ref: str | int | None = None, blocks: Sequence[str] | None = None) -> Message:
    """The answer to a message that was refused; of BML, with the ids of the blocks that entered nevertheless."""
    answer = {"type": "error", "code": refusal.fault.code, "message": str(refusal.fault)}
    more = {"ref": ref, "blocks": blocks}
    return answer | {name: value for name, value in more.items() if value is not None}


def _shown(value: object) -> str:
    text = json.dumps(value)
    return text if len(text) <= _MOST_SHOWN else text[:_MOST_SHOWN] + "..."
