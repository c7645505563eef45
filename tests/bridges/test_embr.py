"""The bridge for clients of EMBR with real sockets and a real server."""

import asyncio
import socket
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

import pytest
from aiohttp import web
from aiohttp.test_utils import TestServer
from lxml import etree

from reactive_realizer.__main__ import main
from reactive_realizer.bridges.embr import Address, EmbrBridge, run_bridge
from reactive_realizer.errors import RealizerError
from reactive_realizer.limits import Limits
from reactive_realizer.server.live_scene import LiveScene

LIMIT = 30.0
"""The longest wait for a report, s."""
SCRIPT = """BEGIN K_POSE_SEQUENCE
  CHARACTER:Amber
  START:asap
  BEGIN K_POSE
    TIME_POINT:+400
    HOLD:200
    BEGIN POSITION_CONSTRAINT
      BODY_GROUP:rarm
      JOINT:rhand
      TARGET:-0.13;-0.25;0.13
      FEEDBACK_ID:raised
    END
  END
END
"""
LONG = SCRIPT.replace("HOLD:200", "HOLD:80000")


class Client:
    """A client of EMBR: EMBOTS or the Behavior Builder. The clock of the realizer moves while it waits for a report."""

    def __init__(self, bridge: Address, feedback: socket.socket, live: LiveScene) -> None:
        self._bridge, self._feedback, self._live = bridge, feedback, live
        self._ticks = live.ticker.ticks()

    async def send(self, script: str) -> None:
        _, writer = await asyncio.open_connection(*self._bridge)
        writer.write(f"{script}\n".encode())
        await writer.drain()
        writer.close()

    async def hear(self, *kinds: str) -> etree._Element:
        """The next report of one of these kinds."""
        loop = asyncio.get_running_loop()
        async with asyncio.timeout(LIMIT), asyncio.TaskGroup() as group:
            ticking = group.create_task(self._tick())
            while True:
                report = etree.fromstring(await loop.sock_recv(self._feedback, 65536))
                if etree.QName(report).localname in kinds:
                    break
            ticking.cancel()
        return report

    async def _tick(self) -> None:
        while True:
            await self._live.step(await anext(self._ticks))
            await asyncio.sleep(0)


@asynccontextmanager
async def bridged(live: LiveScene, url: str) -> AsyncIterator[Client]:
    with socket.socket(type=socket.SOCK_DGRAM) as feedback:
        feedback.setblocking(False)
        feedback.bind(("127.0.0.1", 0))
        listening = asyncio.get_running_loop().create_future()
        bridge = run_bridge(url, ("127.0.0.1", 0), feedback.getsockname(), listening.set_result)
        async with asyncio.TaskGroup() as group:
            task = group.create_task(bridge)
            yield Client(await listening, feedback, live)
            task.cancel()


async def test_a_script_is_played_and_its_points_are_reported(live: tuple[LiveScene, str]) -> None:
    async with bridged(*live) as client:
        await client.send(SCRIPT)
        reports = [await client.hear("blockProgress", "syncPointProgress") for _ in range(6)]
        assert reports[0].get("id", "").endswith(":start")
        (raised,) = (each for each in reports if each.get("id", "").endswith(":raised"))
        assert float(raised.get("time", "")) == pytest.approx(0.4)
        assert raised.get("characterId") == "alice"


async def test_a_script_that_arrives_later_overrides_what_plays(live: tuple[LiveScene, str]) -> None:
    async with bridged(*live) as client:
        await client.send(LONG)
        await client.hear("blockProgress")
        await client.send(SCRIPT)
        ended = [await client.hear("blockProgress") for _ in range(3)]
        assert {each.get("id", "").rpartition(":")[2] for each in ended} == {"start", "end"}


async def test_a_script_that_cannot_be_read_is_reported_with_its_line_and_the_next_one_plays(
    live: tuple[LiveScene, str],
) -> None:
    async with bridged(*live) as client:
        await client.send("BEGIN K_POSE_SEQUENCE\n  BEGIN K_PSOE\n  END\nEND")
        mistake = await client.hear("warningFeedback", "blockProgress")
        assert (mistake.text or "").startswith("line 2, column 9: K_POSE_SEQUENCE has no K_PSOE")
        await client.send("BEGIN DANCE\nEND")
        refused = await client.hear("warningFeedback")
        assert (refused.get("id"), refused.get("type")) == ("bml", "PARSING_FAILURE")
        await client.send(SCRIPT)
        assert (await client.hear("blockProgress")).get("id", "").endswith(":start")


async def test_a_script_that_is_too_long_is_refused_and_an_empty_connection_means_nothing(
    live: tuple[LiveScene, str],
) -> None:
    async with bridged(*live) as client:
        await client.send("")
        await client.send("#" * (Limits().message_bytes + 1))
        warning = await client.hear("warningFeedback", "blockProgress")
        assert "has more than 1200000 bytes" in (warning.text or "")


async def test_a_receiver_of_feedback_that_is_not_known_is_named(live: tuple[LiveScene, str]) -> None:
    _, url = live
    with pytest.raises(OSError, match=r"feedback cannot be sent to nowhere\.invalid: "):
        await run_bridge(url, ("127.0.0.1", 0), ("nowhere.invalid", 5556))


async def test_only_so_many_connections_are_open_at_once() -> None:
    sent = asyncio.Event()
    reports: list[bytes] = []

    async def send(message: object) -> None:
        sent.set()

    bridge = EmbrBridge(send, reports.append, Limits(connections=1))
    async with await asyncio.start_server(bridge.take, "127.0.0.1", 0) as server:
        address = server.sockets[0].getsockname()
        _, first = await asyncio.open_connection(*address)
        first.write(SCRIPT.encode())
        await first.drain()
        refused, second = await asyncio.open_connection(*address)
        assert await refused.read() == b""
        assert b"the limit of open connections is 1" in reports[0]
        for writer in (first, second):
            writer.close()
            await writer.wait_closed()
        await asyncio.wait_for(sent.wait(), LIMIT)


async def test_a_page_in_a_browser_cannot_send_a_script(live: tuple[LiveScene, str]) -> None:
    async with bridged(*live) as client:
        await client.send(f"POST / HTTP/1.1\r\nHost: localhost:5555\r\n\r\n{SCRIPT}")
        warning = await client.hear("warningFeedback", "blockProgress")
        assert "request of HTTP" in (warning.text or "")


@pytest.mark.parametrize(
    ("url", "reason"), [("http://127.0.0.1:9", "Cannot connect"), ("notaurl", "this is not an address such as http://")]
)
def test_a_bridge_without_a_realizer_says_so(capsys: pytest.CaptureFixture[str], url: str, reason: str) -> None:
    assert main(["bridge", "embr", url]) == 2
    assert f"no realizer can be reached at {url}: {reason}" in capsys.readouterr().err


async def test_a_realizer_that_is_lost_ends_the_bridge() -> None:
    async def vanish(request: web.Request) -> web.WebSocketResponse:
        connection = web.WebSocketResponse()
        await connection.prepare(request)
        await connection.send_json({"type": "hello", "protocol": 2})
        return connection

    app = web.Application()
    app.router.add_get("/ws", vanish)
    async with TestServer(app) as server:
        with pytest.raises(RealizerError, match="the connection was lost"):
            await run_bridge(str(server.make_url("/")), ("127.0.0.1", 0), ("127.0.0.1", 9))


@pytest.mark.parametrize("wrong", [":5", "host:0", "host:x", "host:70000"])
def test_a_wrong_address_is_refused(wrong: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["bridge", "embr", "http://127.0.0.1:9", "--listen", wrong])
    assert f"--listen: invalid address value: {wrong!r}" in capsys.readouterr().err
