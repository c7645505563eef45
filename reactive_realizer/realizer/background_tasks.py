"""Slow work in asyncio tasks, outside of ticks."""

import asyncio
from collections.abc import AsyncGenerator, Awaitable, Callable, Sequence
from contextlib import aclosing
from dataclasses import dataclass, field
from inspect import CORO_CREATED, getcoroutinestate, iscoroutine
from typing import Any

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.engine import Part, SlowWork
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
    """Work in a task of its own, which ends with the work or when it is canceled.

    Attributes:
        work: what is done.
        done: takes the results.
        canceled: whether no more results are taken.
        requested: a future for each part that the task is to do.
    """

    work: SlowWork
    done: Done
    canceled: bool = False
    requested: "asyncio.Queue[asyncio.Future[Result]]" = field(default_factory=asyncio.Queue)
    task: "asyncio.Task[None]" = field(init=False)

    def request(self) -> "asyncio.Future[Result]":
        """The result of the work, or of its next part, when it is there."""
        result: asyncio.Future[Result] = asyncio.get_running_loop().create_future()
        self.requested.put_nowait(result)
        return result

    async def run(self) -> None:
        """Do the work, each part when it is requested; work in parts is closed however this ends."""
        if not isinstance(self.work, AsyncGenerator):
            (await self.requested.get()).set_result(await _guarded(self.work))
            return
        async with aclosing(self.work) as parts:
            followed = True
            while followed:
                requested = await self.requested.get()
                result = await _guarded(_next_part(parts))
                followed = _is_followed(result)
                requested.set_result(result)

    def cancel(self) -> None:
        self.canceled = True
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
        self._awaited: dict[int, tuple[_Job, asyncio.Future[Result]]] = {}

    @property
    def busy(self) -> bool:
        """Whether results are outstanding."""
        return bool(self._awaited)

    def request(self, name: str, work: SlowWork, done: Done) -> Callable[[], None]:
        """See `BackgroundWork`."""
        job = _Job(work, done)
        job.task = self._group.create_task(job.run(), name=name)
        self._await(job)

        def cancel() -> None:
            job.cancel()
            self._awaited = {number: each for number, each in self._awaited.items() if each[0] is not job}

        return cancel

    def close(self) -> None:
        """Cancel the work that is not done."""
        for job, _ in self._awaited.values():
            job.cancel()
        self._awaited = {}

    async def settle(self) -> None:
        """Wait for all requested work but that which waits for an input, as a virtual clock does before it advances."""
        waiting = self._streams.waiting
        while working := [each for job, each in self._awaited.values() if not (each.done() or job.task in waiting)]:
            awaited: list[asyncio.Future[Any]] = [*working, self._streams.wait_begun]
            await asyncio.wait(awaited, return_when=asyncio.FIRST_COMPLETED)

    def ready(self) -> tuple[Delivery, ...]:
        """The results that are ready, in order of request."""
        done = ((number, result.result()) for number, (_, result) in self._awaited.items() if result.done())
        return tuple(Delivery(number, _fault(result)) for number, result in done)

    def deliver(self, deliveries: Sequence[Delivery], now: GlobalTime) -> None:
        """Deliver results: those that are `ready`, or those that were ready when the session was recorded.

        Raises:
            RealizerError: "replay-differs": one of them was not requested, or is not ready.
        """
        taken = [self._take(delivery, now) for delivery in deliveries]
        for job, result in taken:
            if job.canceled:
                continue  # because of a result before it
            if _is_followed(result):
                self._await(job)
            else:
                job.cancel()
            job.done(result, now)

    def _await(self, job: _Job) -> None:
        """Have a job do its next part."""
        self._requests += 1
        self._awaited[self._requests] = job, job.request()

    def _take(self, delivery: Delivery, now: GlobalTime) -> tuple[_Job, Result]:
        job, result = self._awaited.get(delivery.request, (None, None))
        if job is None or result is None or not result.done():
            raise RealizerError(ReplayDiffers(time=now, request=delivery.request))
        del self._awaited[delivery.request]
        return job, result.result() if delivery.failure is None else RealizerError(delivery.failure)


def _is_followed(result: Result) -> bool:
    """Whether another part follows."""
    return isinstance(result, Part) and not result.last


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


async def _next_part(parts: AsyncGenerator[Part, None]) -> Part:
    try:
        return await anext(parts)
    except StopAsyncIteration as end:
        raise EOFError("its slow work ended too early") from end
