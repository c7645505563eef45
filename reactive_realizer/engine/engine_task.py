"""Runs engines as asyncio tasks, which sleep until something is due or has changed."""

import asyncio
import logging
from collections.abc import Iterable
from functools import partial

from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime, Time
from reactive_realizer.engine.effects import Output, Play
from reactive_realizer.engine.engine import Engine
from reactive_realizer.engine.faults import EngineFailed
from reactive_realizer.pegboard.agenda import Agenda

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

    @property
    def next_due(self) -> Time:
        """As `Engine.next_due`. An engine that cannot tell is due at once, and fails when it plays."""
        try:
            return self.engine.next_due
        except Exception:
            logger.exception("engine %s does not know when it is due", self.engine.name)
            return GlobalTime(0.0)

    def show(self, tick: Tick) -> Output:
        """The output of the engine for the frame of a tick."""
        try:
            return self.engine.show(tick)
        except Exception as failure:
            return Output(effects=self._fail(tick, failure))

    def _play(self, tick: Tick) -> Play:
        try:
            return self.engine.play(tick)
        except Exception as failure:
            return self._fail(tick, failure)

    def _fail(self, tick: Tick, failure: Exception) -> Play:
        logger.error("engine %s failed at tick %d", self.engine.name, tick.number, exc_info=failure)
        return self.engine.fail(tick.time, EngineFailed(engine=self.engine.name, reason=str(failure)))


class EngineTasks:
    """The tasks of some engines; only those play that have something to play.

    Attributes:
        tasks: in rank order.
    """

    def __init__(self, engines: Iterable[Engine]) -> None:
        self.tasks = tuple(map(EngineTask, engines))
        self._ranks = {task: rank for rank, task in enumerate(self.tasks)}
        self._agenda: Agenda[EngineTask] = Agenda(lambda task: task.next_due, lambda task: ())
        self._woken: set[EngineTask] = set()
        for task in self.tasks:
            self._agenda.add(task)
            task.engine.listen(partial(self._woken.add, task))

    async def play(self, tick: Tick) -> list[Play]:
        """One round of a tick: the engines that are due or woken play; their effects are in rank order."""
        answers = [task.post(tick) for task in self._take_due(tick.time)]
        return [await answer for answer in answers]

    def show(self, tick: Tick) -> list[Output]:
        """The outputs of all engines for the frame of a tick, in rank order."""
        return [task.show(tick) for task in self.tasks]

    def _take_due(self, now: GlobalTime) -> list[EngineTask]:
        due = {*self._agenda.take_due(now), *self._woken}
        self._woken.clear()
        for task in due:
            self._agenda.note(task)  # to be read when it has played
        return sorted(due, key=self._ranks.__getitem__)
