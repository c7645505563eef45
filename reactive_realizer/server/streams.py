"""What a client asks for in the query of its address."""

from collections.abc import Mapping
from enum import StrEnum

from reactive_realizer.errors import error


class Stream(StrEnum):
    """The streams of a socket."""

    FEEDBACK = "feedback"
    AUDIO = "audio"
    FRAMES = "frames"
    BOARD = "board"


_DEFAULT = frozenset({Stream.FEEDBACK, Stream.AUDIO, Stream.FRAMES})


def streams_of(query: Mapping[str, str]) -> frozenset[Stream]:
    """``streams=feedback,frames``; without it all but the board.

    Raises:
        RealizerError: "bad-query".
    """
    if "streams" not in query:
        return _DEFAULT
    names = [name for name in query["streams"].split(",") if name]
    if any(name not in list(Stream) for name in names):
        raise error("bad-query", name="streams", value=query["streams"], wanted="some of " + ", ".join(Stream))
    return frozenset(map(Stream, names))


def after_of(query: Mapping[str, str], last_event: str | None = None) -> int | None:
    """``after=SEQ``: number of the last feedback that the client has; None: it wants only what comes.

    Args:
        query: of the address.
        last_event: what a client of server-sent events says when it comes back; it goes before the address.

    Raises:
        RealizerError: "bad-query".
    """
    text = query.get("after") if last_event is None else last_event
    if text is None:
        return None
    if not (text.isascii() and text.isdigit() and len(text) < 16):
        raise error("bad-query", name="after", value=text, wanted="the number of a feedback message")
    return int(text)
