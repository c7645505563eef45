"""Runs a speech worker, a process that makes utterances, and exchanges messages with it."""

import asyncio
import logging
import sys
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial
from heapq import heappop, heappush
from itertools import chain
from typing import Any, Final, Self, cast

from reactive_realizer.engine.asking_client import asking_client
from reactive_realizer.engines.speech.worker_messages import MessageDecoder, WorkerMessage, failure

_START_PATIENCE = 60.0
"""Time limit for the first message of a worker, which has to load a library or a model, s: 3 s on a quiet machine."""
UNSENT: Final = WorkerMessage({"failed": "it was not sent"})
"""The reply to a request that waited when the worker ended: another worker can answer it."""

_log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True, order=True)
class _Request:
    """A request to the worker, with the future of its reply; the least one is sent next."""

    rank: int
    number: int
    message: WorkerMessage = field(compare=False)
    reply: asyncio.Future[WorkerMessage] = field(compare=False)


class WorkerProcess(asyncio.SubprocessProtocol):
    """One run of the worker. Requests are sent one by one, each when the previous one is answered.

    The clients for which they are made take turns, so that none waits for all that another one has spoken. Of those of
    one client, the lowest rank comes first.

    A request that is canceled before it is sent costs nothing; after that, its reply is discarded. When the process
    ends, the request that it worked on fails, and the reply to the others is `UNSENT`. A worker that takes longer for a
    reply than the time limit is killed.

    Attributes:
        hello: the first message of the worker, when it is ready.
        ended: is done when the process has ended.
    """

    _transport: asyncio.SubprocessTransport
    _watch: asyncio.TimerHandle

    def __init__(self, patience: float) -> None:
        loop = asyncio.get_running_loop()
        self.hello: asyncio.Future[WorkerMessage] = loop.create_future()
        self.ended: asyncio.Future[None] = loop.create_future()
        self._awaited: asyncio.Future[WorkerMessage] | None = self.hello
        self._waiting: dict[str, list[_Request]] = {}
        """Requests by client, a heap each; the client whose turn was longest ago first."""
        self._requests = 0
        self._decoder = MessageDecoder()
        self._patience = patience
        self._hung = False
        self._closing = False

    @classmethod
    async def start(cls, worker: str, patience: float) -> Self:
        """Starts a worker process in a session of its own, so that Ctrl-C in the terminal reaches only the realizer.

        Args:
            worker: the module that it runs.
            patience: time limit for one reply, s.
        """
        loop = asyncio.get_running_loop()
        command = (sys.executable, "-m", worker)
        _, process = await loop.subprocess_exec(partial(cls, patience), *command, stderr=None, start_new_session=True)
        return process

    @property
    def pid(self) -> int:
        """The process id of the worker."""
        return self._transport.get_pid()

    @property
    def busy(self) -> bool:
        """Whether the worker owes a reply."""
        return self._awaited is not None

    def request(self, header: dict[str, Any], rank: int = 0, body: bytes = b"") -> asyncio.Future[WorkerMessage]:
        """Sends a request, and returns the future of its reply."""
        self._requests += 1
        request = _Request(
            rank, self._requests, WorkerMessage(header, body), asyncio.get_running_loop().create_future()
        )
        heappush(self._waiting.setdefault(asking_client(), []), request)
        if self.ended.done():
            self._fail_unanswered()
        elif self._awaited is None:
            self._send_next()
        return request.reply

    async def close(self) -> None:
        """Kills the process; all open requests fail."""
        self._closing = True
        self._kill()
        await asyncio.shield(self.ended)

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """The process has started."""
        self._transport = cast("asyncio.SubprocessTransport", transport)
        self._watch = asyncio.get_running_loop().call_later(_START_PATIENCE, self._give_up)

    def pipe_data_received(self, fd: int, data: bytes) -> None:
        """A part of a reply has arrived."""
        for message in self._decoder.feed(data):
            if self._awaited is not None:
                _answer(self._awaited, message)
            self._send_next()

    def process_exited(self) -> None:
        """The worker has ended; one of its children may still hold the pipes."""
        self._transport.close()

    def connection_lost(self, exc: Exception | None) -> None:
        """The pipes are closed: no reply will arrive."""
        _log.info("the speech worker %d ended, exit status %s", self.pid, self._transport.get_returncode())
        self.ended.set_result(None)
        self._fail_unanswered()

    def _send_next(self) -> None:
        """Sends the next request that is not canceled."""
        self._watch.cancel()
        request = self._take_next()
        if request is None:
            self._awaited = None
            return
        self._awaited = request.reply
        cast("asyncio.WriteTransport", self._transport.get_pipe_transport(0)).write(request.message.encode())
        self._watch = asyncio.get_running_loop().call_later(self._patience, self._give_up)

    def _take_next(self) -> _Request | None:
        """Removes the next request of the client whose turn it is; that client is the last one then."""
        while self._waiting:
            client = next(iter(self._waiting))
            requests = self._waiting.pop(client)
            while requests:
                request = heappop(requests)
                if not request.reply.done():
                    if requests:
                        self._waiting[client] = requests
                    return request
        return None

    def _give_up(self) -> None:
        _log.warning("the speech worker %d does not answer and is killed", self.pid)
        self._hung = True
        self._kill()

    def _kill(self) -> None:
        with suppress(ProcessLookupError):
            self._transport.kill()

    def _fail_unanswered(self) -> None:
        self._watch.cancel()
        failed = (
            WorkerMessage({"failed": "no answer"}) if self._hung else failure(self._transport.get_returncode() or 0)
        )
        if self._awaited is not None:
            _answer(self._awaited, failed)
        for request in chain.from_iterable(self._waiting.values()):
            _answer(request.reply, failed if self._closing else UNSENT)
        self._waiting.clear()


def _answer(reply: asyncio.Future[WorkerMessage], message: WorkerMessage) -> None:
    if not reply.done():
        reply.set_result(message)
