"""Slow work in asyncio tasks, outside of ticks."""

import asyncio
from collections.abc import Awaitable, Callable, Sequence
from dataclasses import dataclass
from inspect import CORO_CREATED, getcoroutinestate, iscoroutine
from typing import Any

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.speech_streams import SpeechStreams
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.realizer.inputs import Delivery
from reactive_realizer.scheduler.engine_routing import Result
from reactive_realizer.scheduler.faults import WorkFailed

Done = Callable[[Result, GlobalTime], None]


class ReplayDiffers(Fault):
    """A recorded result of work that the replay did not request."""

    code = "replay-differs"
    template = (
        "the replay differs from the recording at {time:g} s: it did not request work item {request}; files or "
        "versions have probably changed"
    )
    time: float
    request: int


@dataclass(slots=True, eq=False)
class _Job:
    work: Awaitable[object]
    task: "asyncio.Task[Result]"
    done: Done

    def cancel(self) -> None:
        self.task.cancel()
        if iscoroutine(self.work) and getcoroutinestate(self.work) == CORO_CREATED:
            self.work.close()  # the task has not begun to wait for it, and never will


class BackgroundTasks:
    """Runs each piece of work in a task of the realizer's group, and delivers results in order of request.

    Args:
        group: of the realizer.
        streams: sound for which work may wait.
    """

    def __init__(self, group: asyncio.TaskGroup, streams: SpeechStreams) -> None:
        self._group = group
        self._streams = streams
        self._requests = 0
        self._jobs: dict[int, _Job] = {}

    @property
    def busy(self) -> bool:
        """Whether results are outstanding."""
        return bool(self._jobs)

    def request(self, name: str, work: Awaitable[object], done: Done) -> Callable[[], None]:
        """See `BackgroundWork`."""
        self._requests += 1
        number = self._requests
        job = self._jobs[number] = _Job(work, self._group.create_task(_guarded(work), name=name), done)

        def cancel() -> None:
            job.cancel()
            self._jobs.pop(number, None)

        return cancel

    def close(self) -> None:
        """Cancel the work that is not done."""
        for job in self._jobs.values():
            job.cancel()
        self._jobs = {}

    async def settle(self) -> None:
        """Wait for all requested work but that which waits for an input, as a virtual clock does before it advances."""
        waiting = self._streams.waiting
        while working := [each.task for each in self._jobs.values() if not (each.task.done() or each.task in waiting)]:
            awaited: list[asyncio.Future[Any]] = [*working, self._streams.wait_begun]
            await asyncio.wait(awaited, return_when=asyncio.FIRST_COMPLETED)

    def ready(self) -> tuple[Delivery, ...]:
        """The results that are ready, in order of request."""
        done = ((number, job.task.result()) for number, job in self._jobs.items() if job.task.done())
        return tuple(Delivery(number, _fault(result)) for number, result in done)

    def deliver(self, deliveries: Sequence[Delivery], now: GlobalTime) -> None:
        """Deliver results: those that are `ready`, or those that were ready when the session was recorded.

        Raises:
            RealizerError: "replay-differs": one of them was not requested, or is not ready.
        """
        jobs = [self._take(delivery.request, now) for delivery in deliveries]
        for job, delivery in zip(jobs, deliveries, strict=True):
            job.done(job.task.result() if delivery.failure is None else RealizerError(delivery.failure), now)

    def _take(self, number: int, now: GlobalTime) -> _Job:
        if number not in self._jobs or not self._jobs[number].task.done():
            raise RealizerError(ReplayDiffers(time=now, request=number))
        return self._jobs.pop(number)


def _fault(result: Result) -> Fault | None:
    match result:
        case RealizerError():
            return result.fault
        case Exception():
            return WorkFailed(reason=str(result))
        case _:
            return None


async def _guarded(work: Awaitable[object]) -> Result:
    """The result of work, whatever it raises; only the task itself can be canceled."""
    try:
        return await work
    except Exception as failure:
        return failure
    except (SystemExit, asyncio.CancelledError) as failure:
        task = asyncio.current_task()
        if task is not None and task.cancelling():
            raise
        return RuntimeError(type(failure).__name__)
