"""The event loop of servers: timers are not rounded to milliseconds, and files are served as by any other loop."""

import asyncio
import select
import sys
from collections.abc import Sequence

import pytest

from reactive_realizer.clock.punctual_loop import run_punctually


def test_it_returns_what_the_coroutine_returns_and_raises_what_it_raises() -> None:
    assert run_punctually(asyncio.sleep(0, "result")) == "result"
    with pytest.raises(ZeroDivisionError):
        run_punctually(_fail())


async def _fail() -> None:
    raise ZeroDivisionError


@pytest.mark.skipif(sys.platform != "linux", reason="other systems have their own timers")
def test_it_waits_for_the_time_of_a_timer_not_for_whole_milliseconds(monkeypatch: pytest.MonkeyPatch) -> None:
    waits: list[float] = []
    wait = select.select

    def noted(read: Sequence[int], write: Sequence[int], other: Sequence[int], timeout: float) -> object:
        waits.append(timeout)
        return wait(read, write, other, timeout)

    async def sleep() -> None:
        # The loop's time passes only in its waits: on a busy machine, a timer may be due before the loop comes to it.
        loop = asyncio.get_running_loop()
        begin = loop.time()
        monkeypatch.setattr(loop, "time", lambda: begin + sum(waits))
        await asyncio.sleep(0.0034)

    monkeypatch.setattr(select, "select", noted)
    run_punctually(sleep())
    assert waits == [pytest.approx(0.0034)]


def test_what_arrives_ends_the_wait_for_a_timer() -> None:
    async def echo() -> bytes:
        async def answer(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
            writer.write(await reader.readline())
            writer.close()

        async with await asyncio.start_server(answer, "127.0.0.1", 0) as server:
            reader, writer = await asyncio.open_connection(*server.sockets[0].getsockname())
            writer.write(b"heard\n")
            line = await asyncio.wait_for(reader.readline(), 60.0)
            writer.close()
            return line

    assert run_punctually(echo()) == b"heard\n"


def test_it_runs_other_programs() -> None:
    async def run() -> int | None:
        process = await asyncio.create_subprocess_exec(sys.executable, "-c", "raise SystemExit(3)")
        return await process.wait()

    assert run_punctually(run()) == 3
