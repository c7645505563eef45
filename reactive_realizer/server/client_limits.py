"""Limits on clients: their number, their message rate, and the size of their send queues."""

import asyncio
from collections import deque
from collections.abc import Awaitable, Callable, Iterator, Sequence, Sized
from contextlib import contextmanager
from itertools import count
from typing import Any, Generic, TypeVar

from reactive_realizer.errors import RealizerError
from reactive_realizer.limits import Limits
from reactive_realizer.server.faults import TooManyClients

M = TypeVar("M", bound=Sized)

_AT_ONCE = 20
"""Messages after which other tasks have a turn."""

_TURN = 0.01
"""Time between two looks at a queue above its limit, s."""
_PATIENCE = 50
"""Looks after which its client is too slow. While the server itself is held up, no time passes for its clients."""


class ClientQueue(Generic[M]):
    """The messages that one client is to be sent, in order. Adding never blocks.

    Args:
        limits: of the queued messages.
        first: messages that are sent first; they do not count towards the limit.
    """

    def __init__(self, limits: Limits, first: Sequence[M] = ()) -> None:
        self._messages = deque(first)
        self._bytes = sum(map(len, first))
        self._most = limits.queued_messages + len(first)
        self._most_bytes = limits.queued_bytes + self._bytes
        self._ended = False
        self._overflown = False
        self._news = asyncio.Event()
        self._sending: asyncio.Timeout | None = None
        self._watching: asyncio.TimerHandle | None = None

    @property
    def messages(self) -> int:
        """How many messages wait."""
        return len(self._messages)

    @property
    def bytes(self) -> int:
        """Their length: bytes, and characters of text."""
        return self._bytes

    def put(self, message: M) -> None:
        """Adds a message. A client that stays above the limit is disconnected."""
        if self._overflown:
            return
        self._messages.append(message)
        self._bytes += len(message)
        self._news.set()
        if self._watching is None:
            self._watch(_PATIENCE)

    def end(self) -> None:
        """Ends the queue after the messages in it."""
        self._ended = True
        self._news.set()

    async def send_all(self, send: Callable[[M], Awaitable[None]]) -> bool:
        """Sends messages until the end. Returns False if the queue exceeded its limit, even during a send."""
        try:
            async with asyncio.timeout(0 if self._overflown else None) as self._sending:
                for sent in count(1):
                    if (message := await self._next()) is None:
                        break
                    await send(message)
                    if sent % _AT_ONCE == 0:
                        await asyncio.sleep(0)  # neither may have waited
        except TimeoutError:
            if not self._overflown:
                raise
        finally:
            self._sending = None
        return not self._overflown

    def _watch(self, looks: int) -> None:
        """Looks again for a number of times as long as the queue is above its limit, and then gives up."""
        self._watching = None
        if len(self._messages) <= self._most and self._bytes <= self._most_bytes:
            return
        if looks:
            self._watching = asyncio.get_running_loop().call_later(_TURN, self._watch, looks - 1)
        else:
            self._give_up()

    def _give_up(self) -> None:
        self._overflown = True
        self._messages.clear()
        self._bytes = 0
        if self._sending is not None:
            self._sending.reschedule(0)  # long ago

    async def _next(self) -> M | None:
        while not (self._messages or self._ended):
            self._news.clear()
            await self._news.wait()
        if not self._messages:
            return None
        message = self._messages.popleft()
        self._bytes -= len(message)
        return message


class RateLimit:
    """A token bucket that holds the tokens of one second.

    Args:
        per_second: average rate.
    """

    def __init__(self, per_second: int) -> None:
        self._rate = per_second
        self._tokens = float(per_second)
        self._filled = asyncio.get_running_loop().time()

    async def take(self) -> None:
        """Takes a token; waits for it if there is none."""
        now = asyncio.get_running_loop().time()
        self._tokens = min(float(self._rate), self._tokens + (now - self._filled) * self._rate) - 1
        self._filled = now
        if self._tokens < 0:
            await asyncio.sleep(-self._tokens / self._rate)


class Clients:
    """The connected clients, up to a limit.

    Attributes:
        number: of clients that are connected now.
        queues: of those that are served.
    """

    def __init__(self, limit: int) -> None:
        self.number = 0
        self.queues: set[ClientQueue[Any]] = set()
        self._limit = limit

    @contextmanager
    def one(self) -> Iterator[None]:
        """Counts one client for the duration of the context.

        Raises:
            RealizerError: "too-many-clients".
        """
        if self.number >= self._limit:
            raise RealizerError(TooManyClients(limit=self._limit))
        self.number += 1
        try:
            yield
        finally:
            self.number -= 1

    @contextmanager
    def served(self, queue: ClientQueue[Any]) -> Iterator[None]:
        """Includes the queue of a client for the duration of the context."""
        self.queues.add(queue)
        try:
            yield
        finally:
            self.queues.discard(queue)
