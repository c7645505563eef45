"""Connections: how many there may be, which one makes room for another, and when one that sends nothing ends."""

import asyncio
import errno
import gc
import resource
import socket
import weakref
from collections.abc import AsyncIterator, Callable, Iterator
from contextlib import AbstractAsyncContextManager, AsyncExitStack, asynccontextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import aiohttp
import pytest
from aiohttp import web

from reactive_realizer.assembly.scene import SceneOptions, open_scene
from reactive_realizer.clock.clock import ManualClock
from reactive_realizer.server import connections, routes_streams
from reactive_realizer.server.connections import listen
from reactive_realizer.server.live_scene import LiveScene
from reactive_realizer.server.security import Security
from reactive_realizer.server.serve import serving
from reactive_realizer.server.socket_client import SocketClient
from reactive_realizer.server.token_check import TokenCheck

from .conftest import ALICE, Open

HANDSHAKE = (
    b"GET /ws?streams=feedback HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
    b"Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n"
)
GET = b"GET /status HTTP/1.1\r\nHost: localhost\r\n\r\n"


@dataclass
class Door:
    """A server that accepts connections at a port."""

    port: int
    stack: AsyncExitStack

    async def connect(self, text: bytes = b"") -> asyncio.StreamReader:
        """Connects and sends a text."""
        reader, writer = await asyncio.open_connection("127.0.0.1", self.port)
        self.stack.callback(writer.close)
        writer.write(text)
        return reader

    async def status(self, text: bytes = GET) -> int:
        """The status of the answer to a request."""
        reader = await self.connect(text)
        return int((await reader.readline()).split()[1])


Doors = Callable[..., AbstractAsyncContextManager[Door]]


@pytest.fixture
def door(tmp_path: Path) -> Doors:
    """Serves a scene with limits."""

    @asynccontextmanager
    async def open_(limits: str) -> AsyncIterator[Door]:
        file = tmp_path / "human.toml"
        file.write_text(f"{ALICE}[limits]\n{limits}\n", encoding="utf-8")
        listening = listen("127.0.0.1", 0)
        async with AsyncExitStack() as stack:
            stack.enter_context(listening)
            scene = await stack.enter_async_context(open_scene(SceneOptions(file, "text")))
            await stack.enter_async_context(serving(LiveScene(scene, ManualClock()), Security(), listening))
            yield Door(listening.getsockname()[1], stack)

    return open_


def from_elsewhere(_: str) -> bool:
    return False


async def test_connections_without_a_request_do_not_keep_others_out(door: Doors) -> None:
    async with door("connections = 4") as served:
        silent = [await served.connect() for _ in range(10)]
        half = [await served.connect(GET[:20]) for _ in range(10)]
        assert await served.status() == 200
        assert await silent[0].read() == b"", "the oldest one was closed"
        assert not half[-1].at_eof()


async def test_a_connection_that_has_been_answered_makes_room_too(door: Doors) -> None:
    async with door("connections = 2") as served:
        assert [await served.status() for _ in range(5)] == [200] * 5


async def test_connections_that_are_used_are_kept_and_further_ones_are_closed(door: Doors) -> None:
    async with door("connections = 2") as served:
        streams = [await served.connect(GET.replace(b"/status", b"/feedback")) for _ in range(2)]
        for stream in streams:
            assert b"200" in await stream.readline()
        assert await (await served.connect()).read() == b""
        assert not any(stream.at_eof() for stream in streams)


async def test_connections_from_one_other_machine_have_a_limit_of_their_own(
    door: Doors, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(connections, "is_loopback", from_elsewhere)
    async with door("connections_per_address = 2") as served:
        first, *_ = [await served.connect() for _ in range(3)]
        assert await first.read() == b""


async def test_connections_from_this_machine_such_as_those_of_a_proxy_only_count_together(door: Doors) -> None:
    async with door("connections_per_address = 2") as served:
        first, *_ = [await served.connect() for _ in range(3)]
        assert await served.status() == 200
        assert not first.at_eof()


@pytest.mark.parametrize("text", [b"", GET[:20], GET[:-2]])
async def test_a_connection_without_a_complete_request_is_closed_after_a_time(door: Doors, text: bytes) -> None:
    async with door("idle_seconds = 1.0") as served:
        assert await (await served.connect(text)).read() == b""


async def test_a_body_that_does_not_arrive_is_not_waited_for(on_air: Open) -> None:
    async with on_air(ALICE + "[limits]\nbody_seconds = 1.0\n") as air:
        reader, writer = await asyncio.open_connection(air.client.host, air.client.port)
        head = "POST /bml HTTP/1.1\r\nHost: localhost\r\nContent-Type: text/xml\r\nContent-Length: 100\r\n\r\n"
        writer.write(head.encode() + b"<bml")
        assert b"408" in await reader.readline()
        assert b"slow-request" in await reader.readuntil(b"}")
        writer.close()


async def test_a_connection_that_is_closed_while_its_body_arrives_is_logged_in_one_line(
    on_air: Open, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    """As one that makes room for another."""

    async def close(_: TokenCheck, request: web.Request) -> None:
        request.protocol.force_close()

    monkeypatch.setattr(TokenCheck, "check", close)
    caplog.set_level("INFO")
    async with on_air() as air:
        reader, writer = await asyncio.open_connection(air.client.host, air.client.port)
        head = b"POST /bml HTTP/1.1\r\nHost: localhost\r\nContent-Type: text/xml\r\nContent-Length: 100\r\n\r\n"
        writer.write(head + b"<bml")
        assert await reader.read() == b""
        writer.close()
    assert "its connection has closed" in caplog.text
    assert not any(each.exc_info for each in caplog.records)


async def test_exhausted_descriptors_are_told_once_and_connections_are_accepted_again_later(
    door: Doors, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setattr(connections, "RETRY", 0.0)
    loop = asyncio.get_running_loop()
    accept, problems = loop.sock_accept, [OSError(errno.EMFILE, "Too many open files")] * 5

    async def failing(listening: socket.socket) -> tuple[socket.socket, Any]:
        if problems:
            raise problems.pop()
        return await accept(listening)

    monkeypatch.setattr(loop, "sock_accept", failing)
    async with door("connections = 4") as served:
        assert await served.status() == 200
    (line,) = [record.getMessage() for record in caplog.records if record.levelname == "ERROR"]
    assert line == "no connections can be accepted for now: [Errno 24] Too many open files"


async def test_descriptors_are_left_for_files_and_the_voice(
    door: Doors, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setattr(resource, "getrlimit", lambda _: (8, 8))
    async with door("connections = 400") as served:
        silent = [await served.connect() for _ in range(5)]
        assert await silent[0].read() == b""
    assert "8 open files are allowed, so at most 4 connections are accepted (ulimit -n)" in caplog.messages


async def test_pings_of_the_socket_count_as_messages(on_air: Open) -> None:
    async with on_air(ALICE + "[limits]\nmessages_per_second = 10\n") as air:
        socket = await air.connect()
        begin = asyncio.get_running_loop().time()
        for _ in range(13):
            await socket.raw.ping()
        assert (await socket.ask(type="clock"))["type"] == "accepted"
        assert asyncio.get_running_loop().time() >= begin + 0.39, "four messages wait"


async def test_a_ping_is_answered_with_its_text(on_air: Open) -> None:
    async with on_air() as air:
        socket = await air.connect("?streams=feedback", autoping=False)
        await socket.raw.ping(b"are you there")
        answer = await socket.raw.receive()
        assert (answer.type, answer.data) == (aiohttp.WSMsgType.PONG, b"are you there")


async def socket_of(served: Door) -> asyncio.StreamWriter:
    """The socket of a new client."""
    reader, writer = await asyncio.open_connection("127.0.0.1", served.port)
    writer.write(HANDSHAKE)
    assert b"101" in await reader.readline()
    return writer


@pytest.fixture
def no_collection() -> Iterator[None]:
    gc.collect()
    gc.disable()
    yield
    gc.enable()


async def test_a_client_that_vanishes_is_freed_without_a_collection(door: Doors, no_collection: None) -> None:
    former = {id(each) for each in gc.get_objects() if isinstance(each, SocketClient)}
    async with door("clients = 1") as served:
        writer = await socket_of(served)
        freed = asyncio.Event()
        clients = (each for each in gc.get_objects() if isinstance(each, SocketClient) and id(each) not in former)
        references = [weakref.ref(each, lambda _: freed.set()) for each in clients]
        writer.transport.abort()
        await asyncio.wait_for(freed.wait(), 10)
        assert len(references) == 1


async def test_the_memory_of_a_client_that_vanishes_is_given_back_at_once(door: Doors) -> None:
    async with door("clients = 1") as served:
        writer = await socket_of(served)
        sockets = [each for each in gc.get_objects() if isinstance(each, web.WebSocketResponse) and not each.closed]
        served_socket = weakref.ref(sockets.pop())
        writer.transport.abort()
        async with asyncio.timeout(10):  # the heartbeat would come after 30 s
            while served_socket() is not None:
                await asyncio.sleep(0)
                gc.collect()


async def test_a_client_that_does_not_answer_a_ping_is_dropped_with_a_line_in_the_log_and_freed_without_a_collection(
    door: Doors, no_collection: None, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    caplog.set_level("INFO")
    monkeypatch.setattr(routes_streams, "_HEARTBEAT", 0.2)
    async with door("clients = 1") as served:
        silent = await socket_of(served)
        sockets = [each for each in gc.get_objects() if isinstance(each, web.WebSocketResponse) and not each.closed]
        freed = asyncio.Event()
        reference = weakref.ref(sockets.pop(), lambda _: freed.set())
        await asyncio.wait_for(freed.wait(), 10)
        assert reference() is None
        (line,) = [record for record in caplog.records if record.name == routes_streams.__name__]
        assert line.getMessage() == "the connection of a client was closed: no answer to a ping within 0.1 s"
        assert vars(line)["address"] == "127.0.0.1"
        silent.close()


async def test_a_request_that_cannot_be_read_is_logged_with_its_address(
    door: Doors, caplog: pytest.LogCaptureFixture
) -> None:
    caplog.set_level("INFO")
    async with door("") as served:
        assert await served.status(b"GET / HTTP/1.1\r\nHost: a\r\nContent-Length: -1\r\n\r\n") == 400
        (line,) = [record for record in caplog.records if record.name == "aiohttp.server"]
        assert line.getMessage().startswith("a request cannot be read: 400")
        assert vars(line)["address"] == "127.0.0.1"
