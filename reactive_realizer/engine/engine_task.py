"""Runs an engine as an asyncio task: it receives ticks and returns effects."""

import asyncio
import logging
from collections.abc import Sequence

from reactive_realizer.clock.ticker import Tick
from reactive_realizer.engine.effects import Play
from reactive_realizer.engine.engine import Engine
from reactive_realizer.engine.faults import EngineFailed

logger = logging.getLogger(__name__)


class EngineTask:
    """Runs one engine; its mailbox holds at most one tick.

    If an engine raises, it drops its units with feedback, and the other engines continue.
    """

    def __init__(self, engine: Engine) -> None:
        self.engine = engine
        self._mailbox: asyncio.Queue[tuple[Tick, asyncio.Future[Play]]] = asyncio.Queue(maxsize=1)

    async def run(self) -> None:
        """Play ticks until cancelled."""
        while True:
            tick, answer = await self._mailbox.get()
            play = self._play(tick)
            if not answer.cancelled():  # the caller may have been cancelled
                answer.set_result(play)

    def post(self, tick: Tick) -> "asyncio.Future[Play]":
        """Let the engine play a tick, and return the result when it is complete."""
        answer: asyncio.Future[Play] = asyncio.get_running_loop().create_future()
        self._mailbox.put_nowait((tick, answer))
        return answer

    def _play(self, tick: Tick) -> Play:
        try:
            return self.engine.play(tick)
        except Exception as failure:
            logger.exception("engine %s failed at tick %d", self.engine.name, tick.number)
            return self.engine.fail(tick.time, EngineFailed(engine=self.engine.name, reason=str(failure)))


async def play_all(tasks: Sequence[EngineTask], tick: Tick) -> list[Play]:
    """One round of a tick: all engines play concurrently; their effects are in the order of the tasks."""
    answers = [task.post(tick) for task in tasks]
    return [await answer for answer in answers]
