"""Realizers under test: this one, at five times its speed, and a fake one with wrong feedback."""

import asyncio
import re
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager
from itertools import count

import pytest
from aiohttp import web
from aiohttp.test_utils import TestServer

from reactive_realizer.assembly.scene import SceneOptions, open_scene
from reactive_realizer.clock.clock import SystemClock
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.server.app import create_app
from reactive_realizer.server.live_scene import LiveScene
from reactive_realizer.server.security import Security

_SPEED = 5


class QuickClock(SystemClock):
    """A clock that runs five times as fast as the machine's."""

    def now(self) -> GlobalTime:
        return GlobalTime(_SPEED * super().now())

    async def wait_until(self, moment: GlobalTime) -> None:
        await asyncio.sleep(max(0.0, moment - self.now()) / _SPEED)


@pytest.fixture
async def realizer() -> AsyncIterator[str]:
    """The address of this realizer."""
    async with open_scene(SceneOptions(voice="text")) as scene, asyncio.TaskGroup() as group:
        live = LiveScene(scene, QuickClock())
        ticking = group.create_task(live.run())
        async with TestServer(create_app(live, Security())) as server:
            yield str(server.make_url(""))
        ticking.cancel()


class WrongRealizer:
    """A fake that reports the end of a block before its start, its start twice, and nothing else."""

    def __init__(self, hello: dict[str, object] | None = None) -> None:
        self._hello = hello or {"type": "hello", "protocol": 2}
        self._seq = count(1)

    async def serve(self, request: web.Request) -> web.WebSocketResponse:
        socket = web.WebSocketResponse()
        await socket.prepare(request)
        await socket.send_json(self._hello)
        async for message in socket:
            said = message.json()
            await socket.send_json({"type": "accepted", "ref": said["ref"]})
            for block in re.findall(r'<bml[^>]* id="([^"]*)"', said["xml"]):
                for sync in ("end", "start", "start"):
                    xml = f'<blockProgress id="{block}:{sync}" globalTime="{next(self._seq)}"/>'
                    await socket.send_json({"type": "feedback", "seq": 1, "time": 0.0, "xml": xml})
        return socket


@asynccontextmanager
async def address_of(handler: Callable[[web.Request], Awaitable[web.StreamResponse]]) -> AsyncIterator[str]:
    """The address of a server whose route ``/ws`` has this handler."""
    app = web.Application()
    app.router.add_get("/ws", handler)
    async with TestServer(app) as server:
        yield str(server.make_url(""))
