"""The realizer's end of the speech worker."""

import asyncio
import logging
import sys
from collections import deque
from contextlib import suppress
from typing import Any, Self, cast

from reactive_realizer.engines.speech.messages import Message, MessageDecoder, failure

_WORKER = "reactive_realizer.engines.speech.espeak_worker"
_log = logging.getLogger(__name__)


class EspeakProcess(asyncio.SubprocessProtocol):
    """One run of the worker: requests go in, replies come back in the same order.

    A reply that nobody waits for any more is dropped when it comes. When the process ends, every request that is not
    answered gets a failure.

    Attributes:
        hello: the first message of the worker: its voices and their variants.
        ended: done when the process has ended.
    """

    _transport: asyncio.SubprocessTransport

    def __init__(self) -> None:
        loop = asyncio.get_running_loop()
        self.hello: asyncio.Future[Message] = loop.create_future()
        self.ended: asyncio.Future[None] = loop.create_future()
        self._unanswered = deque([self.hello])
        self._decoder = MessageDecoder()

    @classmethod
    async def start(cls) -> Self:
        """A new worker process, in a session of its own: an interrupt from the terminal is the realizer's affair."""
        loop = asyncio.get_running_loop()
        command = (sys.executable, "-m", _WORKER)
        _, process = await loop.subprocess_exec(cls, *command, stderr=None, start_new_session=True)
        return process

    @property
    def pid(self) -> int:
        """The process id of the worker."""
        return self._transport.get_pid()

    def request(self, header: dict[str, Any]) -> asyncio.Future[Message]:
        """Sends a request; the future is its reply."""
        reply: asyncio.Future[Message] = asyncio.get_running_loop().create_future()
        self._unanswered.append(reply)
        if self.ended.done():
            self._fail_unanswered()
        else:
            cast("asyncio.WriteTransport", self._transport.get_pipe_transport(0)).write(Message(header).encode())
        return reply

    async def close(self) -> None:
        """Ends the process, whatever it is doing."""
        with suppress(ProcessLookupError):
            self._transport.kill()
        await asyncio.shield(self.ended)

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """The process runs."""
        self._transport = cast("asyncio.SubprocessTransport", transport)

    def pipe_data_received(self, fd: int, data: bytes) -> None:
        """A piece of a reply came."""
        for message in self._decoder.feed(data):
            _answer(self._unanswered.popleft(), message)

    def process_exited(self) -> None:
        """The worker ended; a child of it may still hold its pipes."""
        self._transport.close()

    def connection_lost(self, exc: Exception | None) -> None:
        """Nothing can come any more."""
        _log.info("the speech worker %d ended, exit status %s", self.pid, self._transport.get_returncode())
        self.ended.set_result(None)
        self._fail_unanswered()

    def _fail_unanswered(self) -> None:
        while self._unanswered:
            _answer(self._unanswered.popleft(), failure(self._transport.get_returncode() or 0))


def _answer(reply: asyncio.Future[Message], message: Message) -> None:
    if not reply.done():
        reply.set_result(message)
