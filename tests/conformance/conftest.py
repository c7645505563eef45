"""Realizers under test: this one, at five times its speed, and a fake one with wrong feedback."""

import asyncio
import re
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager
from itertools import count

import pytest
from aiohttp import web
from aiohttp.test_utils import TestServer
from lxml import etree

from reactive_realizer.assembly.scene import SceneOptions, open_scene
from reactive_realizer.clock.clock import SystemClock
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.server.app import create_app
from reactive_realizer.server.live_scene import LiveScene
from reactive_realizer.server.security import Security
from reactive_realizer.testing.pilot import open_pilot

_SPEED = 5
NOT_REALIZED = {
    "face",
    "face-facs",
    "face-shift",
}
"""Cases of which this realizer, with its text voice, says that it does not support a part."""


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


@asynccontextmanager
async def plain_realizer() -> AsyncIterator[str]:
    """The address of this realizer behind a relay that passes on only what BML 1.0 requires.

    There are no predictions and no attributes of other namespaces, blocks that never start do not end, and warnings
    have another type and the id of the block.
    """

    def plain(xml: str) -> str | None:
        element = etree.fromstring(xml)
        for name in [name for name in element.attrib if str(name).startswith("{")]:
            del element.attrib[name]
        if element.tag.endswith("warningFeedback"):
            element.set("id", element.get("id", "").partition(":")[0])
            element.set("type", "OTHER")
        return None if element.tag.endswith("predictionFeedback") else etree.tostring(element, encoding="unicode")

    async def relay(request: web.Request) -> web.WebSocketResponse:
        socket = web.WebSocketResponse()
        await socket.prepare(request)
        await socket.send_json({"type": "hello", "protocol": 2})
        async with open_pilot() as pilot:
            told = 0
            async for message in socket:
                said = message.json()
                pilot.perform(said["xml"])
                await socket.send_json({"type": "accepted", "ref": said["ref"]})
                await pilot.advance(6)
                for xml in filter(None, map(plain, pilot.feedback.raw[told:])):
                    await socket.send_json({"type": "feedback", "time": 0.0, "xml": xml})
                told = len(pilot.feedback.raw)
        return socket

    async with address_of(relay) as url:
        yield url


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
