"""Slow work, aside of the ticks."""

import asyncio
from collections.abc import Awaitable, Callable, Sequence
from dataclasses import dataclass

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.errors import Fault, RealizerError, error
from reactive_realizer.realizer.entered import Delivery
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
        self._requests = 0
        self._jobs: dict[int, _Job] = {}

    @property
    def busy(self) -> bool:
        """Whether results are outstanding."""
        return bool(self._jobs)

    def request(self, name: str, work: Awaitable[object], done: Done) -> Callable[[], None]:
        """See `Workshop`."""
        self._requests += 1
        number = self._requests
        job = self._jobs[number] = _Job(self._group.create_task(_guarded(work), name=name), done)

        def cancel() -> None:
            job.task.cancel()
            self._jobs.pop(number, None)

        return cancel

    def close(self) -> None:
        """Give up what is outstanding."""
        for job in self._jobs.values():
            job.task.cancel()
        self._jobs = {}

    async def settle(self) -> None:
        """Wait for all that was requested until now: what a virtual clock does before it moves on."""
        await asyncio.gather(*(job.task for job in self._jobs.values()))

    def ready(self) -> tuple[Delivery, ...]:
        """The results that are there, in order of request."""
        done = ((number, job.task.result()) for number, job in self._jobs.items() if job.task.done())
        return tuple(Delivery(number, _fault(result)) for number, result in done)

    def deliver(self, deliveries: Sequence[Delivery], now: GlobalTime) -> None:
        """Hand over results: those that are `ready`, or those that were when a session was recorded.

        Raises:
            RealizerError: "replay-differs": one of them was not requested, or is not there.
        """
        jobs = [self._take(delivery.request, now) for delivery in deliveries]
        for job, delivery in zip(jobs, deliveries, strict=True):
            job.done(job.task.result() if delivery.failure is None else RealizerError(delivery.failure), now)

    def _take(self, number: int, now: GlobalTime) -> _Job:
        if number not in self._jobs or not self._jobs[number].task.done():
            raise error("replay-differs", time=now, request=number)
        return self._jobs.pop(number)


def _fault(result: Result) -> Fault | None:
    match result:
        case RealizerError():
            return result.fault
        case Exception():
            return Fault("work-failed", {"reason": str(result)})
        case _:
            return None


async def _guarded(work: Awaitable[object]) -> Result:
    try:
        return await work
    except Exception as failure:
        return failure
