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
        # Released only after the sleep: otherwise, tasks that wake together would all have their turns without a pause.
        try:
            await asyncio.sleep(0)
        finally:
            self._lock.release()
