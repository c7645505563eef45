"""Slow work, aside of the ticks."""

import asyncio
from collections.abc import Awaitable, Callable
from dataclasses import dataclass

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.scheduler.workshop import Result

Done = Callable[[Result, GlobalTime], None]


@dataclass(slots=True, eq=False)
class _Job:
    task: "asyncio.Task[Result]"
    done: Done


class TaskWorkshop:
    """Does each piece of work in a task of the realizer's group; results are handed over in order of request."""

    def __init__(self, group: asyncio.TaskGroup) -> None:
        self._group = group
        self._jobs: list[_Job] = []

    @property
    def busy(self) -> bool:
        """Whether results are outstanding."""
        return bool(self._jobs)

    def request(self, name: str, work: Awaitable[object], done: Done) -> Callable[[], None]:
        """See `Workshop`."""
        job = _Job(self._group.create_task(_guarded(work), name=name), done)
        self._jobs.append(job)

        def cancel() -> None:
            job.task.cancel()
            if job in self._jobs:
                self._jobs.remove(job)

        return cancel

    def close(self) -> None:
        """Give up what is outstanding."""
        for job in self._jobs:
            job.task.cancel()
        self._jobs = []

    async def settle(self) -> None:
        """Wait for all that was requested until now: what a virtual clock does before it moves on."""
        await asyncio.gather(*(job.task for job in self._jobs))

    def deliver(self, now: GlobalTime) -> None:
        """Hand over the results that are there."""
        ready = [job for job in self._jobs if job.task.done()]
        self._jobs = [job for job in self._jobs if job not in ready]
        for job in ready:
            job.done(job.task.result(), now)


async def _guarded(work: Awaitable[object]) -> Result:
    try:
        return await work
    except Exception as failure:
        return failure
