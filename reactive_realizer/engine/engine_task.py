"""Runs engines, which do not raise (`GuardedEngine`), as asyncio tasks that sleep until something is due or changes."""

import asyncio
from collections.abc import Iterable
from functools import partial

from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime, Time
from reactive_realizer.engine.effects import Output, Play
from reactive_realizer.engine.engine import Engine
from reactive_realizer.pegboard.agenda import Agenda


class EngineTask:
    """Runs one engine; its mailbox holds at most one tick."""

    def __init__(self, engine: Engine) -> None:
        self.engine = engine
        self._mailbox: asyncio.Queue[tuple[Tick, asyncio.Future[Play]]] = asyncio.Queue(maxsize=1)

    async def run(self) -> None:
        """Play ticks until cancelled."""
        while True:
            tick, answer = await self._mailbox.get()
            play = self.engine.play(tick)
            if not answer.cancelled():  # the caller may have been cancelled
                answer.set_result(play)

    def post(self, tick: Tick) -> "asyncio.Future[Play]":
        """Let the engine play a tick, and return the result when it is complete."""
        answer: asyncio.Future[Play] = asyncio.get_running_loop().create_future()
        self._mailbox.put_nowait((tick, answer))
        return answer


class EngineTasks:
    """The tasks of some engines; only those play that have something to play.

    Attributes:
        tasks: in rank order.
    """

    def __init__(self, engines: Iterable[Engine]) -> None:
        self.tasks = tuple(map(EngineTask, engines))
        self._ranks = {task: rank for rank, task in enumerate(self.tasks)}
        self._agenda: Agenda[EngineTask] = Agenda(lambda task: task.engine.next_due, lambda task: ())
        self._woken: set[EngineTask] = set()
        self._played: set[EngineTask] = set()
        """Those that have played since it was read when they are due."""
        self._needing: set[EngineTask] = set()
        """The engines that need frames, as they said when they last played or showed one."""
        for task in self.tasks:
            self._agenda.add(task)
            task.engine.listen(partial(self._woken.add, task))

    @property
    def next_due(self) -> Time:
        """A time before which no engine has something to play, as far as it is known; None if there is none."""
        for task in (*self._woken, *self._played):
            self._agenda.note(task)
        self._played.clear()
        return self._agenda.next_due

    async def play(self, tick: Tick) -> list[Play]:
        """One round of a tick: the engines that are due or woken play; their effects are in rank order."""
        due = self._take_due(tick.time)
        answers = [task.post(tick) for task in due]
        plays = [await answer for answer in answers]
        self._note_needs(due)
        return plays

    def show(self, tick: Tick) -> list[Output]:
        """The outputs of all engines for the frame of a tick, in rank order."""
        outputs = [task.engine.show(tick) for task in self.tasks]
        self._note_needs(self.tasks)
        return outputs

    @property
    def need_frames(self) -> bool:
        """Whether an engine needs frames for its own sake."""
        return bool(self._needing)

    def _note_needs(self, tasks: Iterable[EngineTask]) -> None:
        for task in tasks:
            if task.engine.needs_frames:
                self._needing.add(task)
            else:
                self._needing.discard(task)

    def _take_due(self, now: GlobalTime) -> list[EngineTask]:
        for task in self._played - self._woken:  # those that have woken play whenever they are due
            self._agenda.note(task)
        self._played = {*self._agenda.take_due(now), *self._woken}
        self._woken.clear()
        return sorted(self._played, key=self._ranks.__getitem__)
