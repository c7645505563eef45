"""The queue of messages for one client."""

import asyncio

import pytest

from reactive_realizer.limits import Limits
from reactive_realizer.server import client_limits
from reactive_realizer.server.client_limits import ClientQueue, RateLimit

FEW = Limits(queued_messages=3, queued_bytes=100)


@pytest.fixture
def impatient(monkeypatch: pytest.MonkeyPatch) -> None:
    """Clients are dropped sooner than usual."""
    monkeypatch.setattr(client_limits, "_PATIENCE", 2)


async def sent_of(queue: ClientQueue[str]) -> list[str]:
    sent: list[str] = []

    async def send(entry: str) -> None:
        sent.append(entry)

    queue.end()
    assert await queue.send_all(send)
    return sent


async def test_texts_are_sent_in_order_until_the_end() -> None:
    queue: ClientQueue[str] = ClientQueue(FEW, ["hello"])
    queue.put("a")
    queue.put("b")
    assert await sent_of(queue) == ["hello", "a", "b"]


@pytest.mark.parametrize("texts", [["a"] * 4, ["x" * 101], ["x" * 60] * 2])
async def test_a_client_is_dropped_if_too_many_texts_wait_while_a_send_does_not_complete(
    texts: list[str], impatient: None
) -> None:
    queue: ClientQueue[str] = ClientQueue(FEW)
    queue.put("stuck")
    async with asyncio.TaskGroup() as group:
        sending = group.create_task(queue.send_all(never))
        await asyncio.sleep(0)
        for text in texts:
            queue.put(text)
    assert sending.result() is False


async def test_a_client_that_reads_is_not_dropped_for_what_piled_up_while_the_server_was_held_up() -> None:
    queue: ClientQueue[str] = ClientQueue(FEW)
    sent: list[str] = []

    async def read(text: str) -> None:
        await asyncio.sleep(0.001)
        sent.append(text)

    async with asyncio.TaskGroup() as group:
        sending = group.create_task(queue.send_all(read))
        await asyncio.sleep(0)
        for number in range(50):
            queue.put(str(number))
        queue.end()
    assert sending.result() is True
    assert sent == [str(number) for number in range(50)]


async def test_initial_messages_do_not_count_as_waiting() -> None:
    queue: ClientQueue[str] = ClientQueue(FEW, ["x" * 1000] * 10)
    queue.put("a")
    assert len(await sent_of(queue)) == 11


async def test_a_timeout_error_of_the_send_itself_is_raised() -> None:
    async def fail(_: str) -> None:
        raise TimeoutError

    queue: ClientQueue[str] = ClientQueue(FEW, ["a"])
    with pytest.raises(TimeoutError):
        await queue.send_all(fail)


async def never(_: str) -> None:
    await asyncio.Event().wait()


async def test_a_rate_limit_lets_one_second_of_messages_pass_at_once_and_the_others_at_its_rate() -> None:
    loop, rate = asyncio.get_running_loop(), RateLimit(20)
    begin = loop.time()
    assert all(passes_at_once(rate) for _ in range(20))
    for _ in range(4):
        await rate.take()
    assert loop.time() >= begin + 0.2 - 1e-3


def passes_at_once(rate: RateLimit) -> bool:
    taking = rate.take()
    try:
        taking.send(None)
    except StopIteration:
        return True
    taking.close()
    return False
