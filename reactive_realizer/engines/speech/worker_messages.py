"""Messages between the realizer and a speech worker: two lengths, a JSON header, raw bytes."""

import json
import os
import signal
import struct
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

_LENGTHS = struct.Struct(">II")


@dataclass(frozen=True, slots=True)
class WorkerMessage:
    """One request or reply.

    Attributes:
        header: as JSON.
        body: audio.
    """

    header: dict[str, Any]
    body: bytes = b""

    def encode(self) -> bytes:
        """The message as bytes."""
        header = json.dumps(self.header).encode()
        return _LENGTHS.pack(len(header), len(self.body)) + header + self.body


class MessageDecoder:
    """Assembles messages from the pieces that a pipe delivers."""

    def __init__(self) -> None:
        self._pending = bytearray()

    def feed(self, piece: bytes) -> Iterator[WorkerMessage]:
        """The messages that a piece completes; the rest of it is kept for the next piece."""
        self._pending += piece
        while (message := self._first()) is not None:
            yield message

    def _first(self) -> WorkerMessage | None:
        if len(self._pending) < _LENGTHS.size:
            return None
        header, body = _LENGTHS.unpack_from(self._pending)
        start, end = _LENGTHS.size + header, _LENGTHS.size + header + body
        if len(self._pending) < end:
            return None
        message = WorkerMessage(json.loads(self._pending[_LENGTHS.size : start]), bytes(self._pending[start:end]))
        del self._pending[:end]
        return message


class WorkerPipe:
    """The end of the worker: requests on standard input, replies on standard output."""

    def __init__(self) -> None:
        self._replies = os.fdopen(os.dup(1), "wb")
        os.dup2(2, 1)  # keeps what libraries print out of the replies

    def send(self, encoded: bytes) -> None:
        """Sends an encoded message."""
        self._replies.write(encoded)
        self._replies.flush()

    def requests(self) -> Iterator[WorkerMessage]:
        """The requests until the input ends."""
        decoder = MessageDecoder()
        while piece := os.read(0, 65_536):
            yield from decoder.feed(piece)


def failure(exit_status: int) -> WorkerMessage:
    """The reply to a request whose process ended without a reply.

    Args:
        exit_status: of the process; a negative one is the negated number of the signal that ended it.
    """
    ending = signal.Signals(-exit_status).name if exit_status < 0 else f"exit status {exit_status}"
    return WorkerMessage({"failed": ending})
