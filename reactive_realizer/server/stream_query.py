"""What the query of an address asks of a stream."""

from collections.abc import Mapping
from enum import StrEnum
from math import isfinite

from reactive_realizer.errors import RealizerError
from reactive_realizer.server.faults import BadQuery


class Stream(StrEnum):
    """The streams of a socket."""

    FEEDBACK = "feedback"
    AUDIO = "audio"
    SOUND = "sound"
    FRAMES = "frames"
    BOARD = "board"
    STEPS = "steps"
    WORLD = "world"
    PICTURES = "pictures"


_DEFAULT = frozenset({Stream.FEEDBACK, Stream.AUDIO, Stream.FRAMES})


def streams_of(query: Mapping[str, str]) -> frozenset[Stream]:
    """The streams in a query such as ``streams=feedback,frames``; by default feedback, audio and frames.

    Raises:
        RealizerError: "bad-query".
    """
    if "streams" not in query:
        return _DEFAULT
    names = [name for name in query["streams"].split(",") if name]
    if any(name not in list(Stream) for name in names):
        raise RealizerError(BadQuery(name="streams", value=query["streams"], wanted="some of " + ", ".join(Stream)))
    return frozenset(map(Stream, names))


def after_of(query: Mapping[str, str], last_event: str | None = None) -> int | None:
    """The number in ``after=SEQ``, the last feedback that the client has; None for new feedback only.

    Args:
        query: of the address.
        last_event: the Last-Event-ID of a reconnecting client, which overrides the query.

    Raises:
        RealizerError: "bad-query".
    """
    text = query.get("after") if last_event is None else last_event
    if text is None:
        return None
    if not (text.isascii() and text.isdigit() and len(text) < 16):
        raise RealizerError(BadQuery(name="after", value=text, wanted="the number of a feedback message"))
    return int(text)


def predictions_of(query: Mapping[str, str]) -> float | None:
    """The greatest number of predictions per second and block in ``predictions=RATE``; None for all, 0 for none.

    Raises:
        RealizerError: "bad-query".
    """
    if "predictions" not in query:
        return None
    try:
        rate = float(query["predictions"])
    except ValueError:
        rate = -1.0
    if not (isfinite(rate) and rate >= 0.0):
        raise RealizerError(BadQuery(name="predictions", value=query["predictions"], wanted="a number per second"))
    return rate
