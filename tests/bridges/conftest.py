"""What the tests of bridges share: a real server whose clock they move."""

from collections.abc import AsyncIterator

import pytest
from aiohttp import web

from reactive_realizer.assembly.scene import SceneOptions, open_scene
from reactive_realizer.clock.clock import ManualClock
from reactive_realizer.server.app import create_app
from reactive_realizer.server.live_scene import LiveScene
from reactive_realizer.server.security import Security


@pytest.fixture
async def live() -> AsyncIterator[tuple[LiveScene, str]]:
    """A scene, and the address of its server."""
    async with open_scene(SceneOptions(voice="text")) as scene:
        live = LiveScene(scene, ManualClock())
        runner = web.AppRunner(create_app(live, Security()), shutdown_timeout=1)
        await runner.setup()
        await web.TCPSite(runner, "127.0.0.1", 0).start()
        host, port = runner.addresses[0]
        yield live, f"http://{host}:{port}"
        await runner.cleanup()
