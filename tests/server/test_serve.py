"""A server on the machine's clock, from its command line to its end."""

import asyncio
import logging
import os
import signal
from collections.abc import Callable, Iterator
from typing import Any

import aiohttp
import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.server import serve as serve_module
from reactive_realizer.server.serve import ServerOptions, serve

TEXT = SceneOptions(voice="text")


class Lines(logging.Handler):
    """A handler that keeps the messages of a logger."""

    def __init__(self) -> None:
        super().__init__()
        self.said: asyncio.Queue[str] = asyncio.Queue()

    def emit(self, record: logging.LogRecord) -> None:
        self.said.put_nowait(record.getMessage())


@pytest.fixture
def lines(caplog: pytest.LogCaptureFixture) -> Iterator[Lines]:
    caplog.set_level(logging.INFO, "reactive_realizer.server.serve")
    handler = Lines()
    logger = logging.getLogger("reactive_realizer.server.serve")
    logger.addHandler(handler)
    yield handler
    logger.removeHandler(handler)


async def test_the_server_prints_its_address_ticks_and_ends_on_sigterm(lines: Lines) -> None:
    async with asyncio.TaskGroup() as group:
        serving = group.create_task(serve(ServerOptions(port=0, scene=TEXT)))
        address = (await lines.said.get()).rpartition(" ")[2]
        async with aiohttp.ClientSession(address) as session, session.ws_connect("/ws") as socket:
            hello = await socket.receive_json()
            frame = await socket.receive_bytes()
            assert len(frame) > 32
            assert hello["characters"][0]["id"] == "alice"
            os.kill(os.getpid(), signal.SIGTERM)
            async for _ in socket:
                pass
            assert socket.close_code == 1001
        await serving


async def test_the_clock_starts_when_everything_is_ready(lines: Lines, monkeypatch: pytest.MonkeyPatch) -> None:
    steps = list[str]()

    def noting(name: str, act: Callable[..., Any]) -> Callable[..., Any]:
        def noted(*arguments: Any) -> Any:
            steps.append(name)
            return act(*arguments)

        return noted

    for name in ("found_for", "keep_from_ticks", "SystemClock"):
        monkeypatch.setattr(serve_module, name, noting(name, getattr(serve_module, name)))
    async with asyncio.TaskGroup() as group:
        serving = group.create_task(serve(ServerOptions(port=0, scene=TEXT)))
        await lines.said.get()
        serving.cancel()
    assert steps == ["found_for", "keep_from_ticks", "SystemClock"]


async def test_a_port_that_is_in_use_is_an_error_and_nothing_keeps_running(lines: Lines) -> None:
    async with asyncio.TaskGroup() as group:
        serving = group.create_task(serve(ServerOptions(port=0, scene=TEXT)))
        port = int((await lines.said.get()).rpartition(":")[2])
        with pytest.raises(OSError):
            await serve(ServerOptions(port=port, scene=TEXT))
        serving.cancel()
