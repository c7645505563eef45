"""Turns of tasks that work on the event loop."""

import asyncio
from types import TracebackType


class Turns:
    """Lets tasks work one after another, in short turns, so that ticks and other tasks come in between.

    Used as an async context manager, for one turn.
    """

    def __init__(self) -> None:
        self._lock = asyncio.Lock()

    async def __aenter__(self) -> None:
        await self._lock.acquire()

    async def __aexit__(
        self, kind: type[BaseException] | None, failure: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._lock.release()
        await asyncio.sleep(0)
