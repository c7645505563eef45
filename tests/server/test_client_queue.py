"""The queue of messages for one client."""

import asyncio

import pytest

from reactive_realizer.clock.clock import ManualClock
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.limits import Limits
from reactive_realizer.server.client_limits import ClientQueue, RateLimit

FEW = Limits(queued_messages=3, queued_bytes=100)


async def sent_of(queue: ClientQueue) -> list[str]:
    sent: list[str] = []

    async def send(entry: str) -> None:
        sent.append(entry)

    queue.end()
    assert await queue.send_all(send)
    return sent


async def test_texts_are_sent_in_order_until_the_end() -> None:
    queue = ClientQueue(FEW, ["hello"])
    queue.put("a")
    queue.put("b")
    assert await sent_of(queue) == ["hello", "a", "b"]


@pytest.mark.parametrize("texts", [["a"] * 4, ["x" * 101], ["x" * 60] * 2])
async def test_a_client_is_dropped_if_too_many_texts_wait(texts: list[str]) -> None:
    queue = ClientQueue(FEW)
    for text in texts:
        queue.put(text)
    assert not await queue.send_all(never)


async def test_a_client_is_dropped_while_a_send_does_not_complete() -> None:
    queue = ClientQueue(FEW)
    queue.put("stuck")
    async with asyncio.TaskGroup() as group:
        sending = group.create_task(queue.send_all(never))
        await asyncio.sleep(0)
        for _ in range(4):
            queue.put("more")
    assert sending.result() is False


async def test_initial_messages_do_not_count_as_waiting() -> None:
    queue = ClientQueue(FEW, ["x" * 1000] * 10)
    queue.put("a")
    assert len(await sent_of(queue)) == 11


async def test_a_timeout_error_of_the_send_itself_is_raised() -> None:
    async def fail(_: str) -> None:
        raise TimeoutError

    queue = ClientQueue(FEW, ["a"])
    with pytest.raises(TimeoutError):
        await queue.send_all(fail)


async def never(_: str) -> None:
    await asyncio.Event().wait()


async def test_a_rate_limit_allows_one_second_of_messages_at_once_and_then_its_rate() -> None:
    clock = ManualClock()
    rate = RateLimit(10, clock)
    assert [rate.allows() for _ in range(12)] == [True] * 10 + [False] * 2
    await clock.wait_until(GlobalTime(0.25))
    assert [rate.allows() for _ in range(3)] == [True, True, False]
    await clock.wait_until(GlobalTime(100.0))
    assert [rate.allows() for _ in range(11)] == [True] * 10 + [False]
