"""Bridges that a server starts beside itself, with a real broker."""

import asyncio
import logging
import socket
from collections.abc import AsyncIterator, Iterator
from contextlib import asynccontextmanager
from pathlib import Path

import aiohttp
import aiohttp.test_utils
import aiohttp.web
import pytest

from reactive_realizer.__main__ import main
from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.cli.bridge import bridge
from reactive_realizer.client.stomp_bus import Broker, connected
from reactive_realizer.client.vh_message import SCOPE, VhMessage
from reactive_realizer.server import own_clients
from reactive_realizer.server.own_clients import OwnClient
from reactive_realizer.server.serve import ServerOptions, serve

LIMIT = 30.0
"""The longest wait for a message, s."""
TOKEN = "of & the=server"
WAIT = '<act><bml><wait id="w" start="0" end="0.1"/></bml></act>'


class Log(logging.Handler):
    """Keeps the lines of the server's log, and can wait for one."""

    def __init__(self) -> None:
        super().__init__()
        self._said: asyncio.Queue[str] = asyncio.Queue()

    def emit(self, record: logging.LogRecord) -> None:
        self._said.put_nowait(record.getMessage())

    async def line(self, part: str) -> str:
        async with asyncio.timeout(LIMIT):
            while part not in (said := await self._said.get()):
                pass
        return said


@pytest.fixture
def log(caplog: pytest.LogCaptureFixture) -> Iterator[Log]:
    logger, handler = logging.getLogger("reactive_realizer.server"), Log()
    caplog.set_level(logging.INFO, logger.name)
    logger.addHandler(handler)
    yield handler
    logger.removeHandler(handler)


@asynccontextmanager
async def served(log: Log, *bridges: OwnClient, record: Path | None = None) -> AsyncIterator[str]:
    """A server with a token, and with bridges; its address."""
    options = ServerOptions(port=0, token=TOKEN, scene=SceneOptions(voice="text"), record=record, bridges=bridges)
    async with asyncio.TaskGroup() as group:
        serving = group.create_task(serve(options))
        yield (await log.line("serving on")).rpartition(" ")[2]
        serving.cancel()


async def test_a_bridge_enters_by_the_door_of_the_server_is_recorded_and_ends_with_the_server(
    broker: Broker, log: Log, tmp_path: Path
) -> None:
    record = tmp_path / "session.jsonl"
    async with connected(broker, f"/topic/{SCOPE}") as bus, asyncio.timeout(LIMIT):
        chosen = bridge(f"vhmsg --broker {broker.host}:{broker.port} --agent brad=alice")
        async with served(log, chosen, record=record):
            heard: list[str] = []
            while (message := VhMessage.read(await bus.receive())).word != "vrComponent":
                pass
            request = VhMessage("vrSpeak", f"brad user m1 {WAIT}")
            bus.send(request.text, **request.headers(SCOPE))
            while len(heard) < 2:
                if (message := VhMessage.read(await bus.receive())).word == "vrAgentBML":
                    heard.append(message.argument)
    assert heard == ["brad m1 start", "brad m1 end complete"]
    assert '"type": "bml"' in record.read_text()
    assert {task.get_name() for task in asyncio.all_tasks()} == {asyncio.current_task().get_name()}  # type: ignore[union-attr]


async def test_a_bridge_that_fails_is_told_in_the_log_without_the_token_and_the_server_goes_on(log: Log) -> None:
    async def break_down(url: str) -> None:
        raise KeyError(url)

    with socket.create_server(("127.0.0.1", 0)) as taken:
        _, port = taken.getsockname()
        bridges = (
            bridge("vhmsg --broker 127.0.0.1:9"),
            bridge(f"embr --listen 127.0.0.1:{port}"),
            OwnClient("broken", break_down),
        )
        async with served(log, *bridges) as url:
            lines = sorted([await log.line("the bridge") for _ in bridges])
            assert lines[0].startswith("the bridge broken has failed")
            assert lines[1].startswith("the bridge embr has ended: ")
            assert "address already in use" in lines[1]
            assert lines[2].startswith("the bridge vhmsg has ended: no message broker can be reached at 127.0.0.1:9")
            async with aiohttp.ClientSession() as http, http.get(f"{url}/status?token=wrong") as refused:
                assert refused.status == 401
            headers = {"Authorization": f"Bearer {TOKEN}"}
            async with aiohttp.ClientSession(headers=headers) as http, http.get(f"{url}/status") as answer:
                assert answer.status == 200


async def test_a_bridge_that_ends_by_a_cancellation_of_its_own_is_told_in_the_log_as_other_failures(log: Log) -> None:
    async def loses_a_task(url: str) -> None:
        lost = asyncio.get_running_loop().create_future()
        lost.cancel()
        await lost

    async with served(log, OwnClient("lost", loses_a_task)):
        assert await log.line("the bridge") == "the bridge lost has failed"


async def test_bridges_that_exit_or_do_not_end_hold_up_neither_the_server_nor_its_end(
    log: Log, monkeypatch: pytest.MonkeyPatch
) -> None:
    async def exits(url: str) -> None:
        raise SystemExit(3)

    async def stays(url: str) -> None:
        while True:
            try:
                await asyncio.Event().wait()
            except asyncio.CancelledError:
                if forever.is_set():
                    raise

    forever = asyncio.Event()
    monkeypatch.setattr(own_clients, "_PATIENCE", 0.0)
    before = asyncio.all_tasks()
    async with own_clients.accompanied([OwnClient("exits", exits), OwnClient("stays", stays)], "http://here"):
        assert "exits" in await log.line("has failed")
    forever.set()
    left = asyncio.all_tasks() - before
    for task in left:
        task.cancel()
    assert len(await asyncio.gather(*left, return_exceptions=True)) == 1


async def test_a_realizer_that_refuses_the_token_is_named_without_it() -> None:
    async def refuse(request: aiohttp.web.Request) -> aiohttp.web.Response:
        return aiohttp.web.Response(status=401)

    app = aiohttp.web.Application()
    app.router.add_get("/ws", refuse)
    async with aiohttp.test_utils.TestServer(app) as server:
        chosen = bridge("embr --listen 127.0.0.1:9")
        with pytest.raises(Exception, match="no realizer can be reached") as raised:
            await chosen.run(f"{server.make_url('/')}?token=secret")
    assert "secret" not in str(raised.value)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("vhmgs", "there is no bridge 'vhmgs'; available: embr, vhmsg"),
        ("vhmsg --agent brad", "argument --agent: invalid agent value: 'brad'"),
        ("'vhmsg", "invalid bridge value"),
        ("", "invalid bridge value"),
    ],
)
def test_a_wrong_bridge_is_refused_before_the_server_starts(
    text: str, said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit, match="2"):
        main(["serve", "--bridge", text])
    assert said in capsys.readouterr().err
