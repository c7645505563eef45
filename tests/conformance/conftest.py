"""Realizers to try: ours, quick, and one that does everything wrong."""

import asyncio
from collections.abc import AsyncIterator

import pytest
from aiohttp.test_utils import TestServer

from reactive_realizer.assembly.scene import SceneOptions, open_scene
from reactive_realizer.clock.clock import SystemClock
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.server.app import create_app
from reactive_realizer.server.live import Live
from reactive_realizer.server.security import Security

_SPEED = 8


class QuickClock(SystemClock):
    """Eight seconds a second."""

    def now(self) -> GlobalTime:
        return GlobalTime(_SPEED * super().now())

    async def wait_until(self, moment: GlobalTime) -> None:
        await asyncio.sleep(max(0.0, moment - self.now()) / _SPEED)


@pytest.fixture
async def realizer() -> AsyncIterator[str]:
    """The address of our own."""
    async with open_scene(SceneOptions(voice="text")) as scene, asyncio.TaskGroup() as group:
        live = Live(scene, QuickClock())
        ticking = group.create_task(live.run())
        async with TestServer(create_app(live, Security())) as server:
            yield str(server.make_url(""))
        ticking.cancel()
