"""What waits to be sent to one client."""

import asyncio
from collections import deque
from collections.abc import Awaitable, Callable, Sequence

from reactive_realizer.limits import Limits

_FRAMES_WAITING = 10
"""A client that is a fifth of a second behind with one character is better off without what it missed."""


class ClientQueue:
    """Keeps text in order and all of it, and of frames the newest; nobody who puts something in ever waits.

    Args:
        limits: how much text may pile up.
        first: what is sent at once; it does not count as piled up.
        characters: how many characters send frames.
    """

    def __init__(self, limits: Limits, first: Sequence[str] = (), characters: int = 1) -> None:
        self._texts = deque(first)
        self._bytes = sum(map(len, first))
        self._most_texts = limits.queued_messages + len(first)
        self._most_bytes = limits.queued_bytes + self._bytes
        self._frames: deque[bytes] = deque(maxlen=_FRAMES_WAITING * characters)
        self._ended = False
        self._overflown = False
        self._news = asyncio.Event()
        self._sending: asyncio.Timeout | None = None

    def put(self, text: str) -> None:
        """Have a text sent after all others; one too many and the client is given up."""
        if self._overflown:
            return
        self._texts.append(text)
        self._bytes += len(text)
        self._news.set()
        if len(self._texts) > self._most_texts or self._bytes > self._most_bytes:
            self._give_up()

    def put_frame(self, frame: bytes) -> None:
        """Have a frame sent when no text waits; it may be displaced by a newer one."""
        self._frames.append(frame)
        self._news.set()

    def end(self) -> None:
        """Nothing follows after the texts that wait."""
        self._ended = True
        self._news.set()

    async def send_all(self, send: Callable[[str | bytes], Awaitable[None]]) -> bool:
        """Send what is put in until the end; False if too much piled up, also in the middle of a sending."""
        try:
            async with asyncio.timeout(0 if self._overflown else None) as self._sending:
                while (entry := await self._next()) is not None:
                    await send(entry)
        except TimeoutError:
            if not self._overflown:
                raise
        return not self._overflown

    def _give_up(self) -> None:
        self._overflown = True
        self._texts.clear()
        self._frames.clear()
        if self._sending is not None:
            self._sending.reschedule(0)  # long ago

    async def _next(self) -> str | bytes | None:
        while not (self._texts or self._frames or self._ended):
            self._news.clear()
            await self._news.wait()
        if self._texts:
            text = self._texts.popleft()
            self._bytes -= len(text)
            return text
        return None if self._ended else self._frames.popleft()
