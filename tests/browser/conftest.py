"""The built page in a real browser, before a scene on the machine's clock."""

import asyncio
from collections.abc import AsyncIterator, Callable
from contextlib import AbstractAsyncContextManager, asynccontextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from urllib.parse import urlsplit

import pytest
import pytest_asyncio
from aiohttp import web
from playwright.async_api import Browser, BrowserContext, Page, ViewportSize, async_playwright, expect

from reactive_realizer.assembly.scene import SceneOptions, open_scene
from reactive_realizer.clock.clock import SystemClock
from reactive_realizer.export.video import FLAGS
from reactive_realizer.server.app import create_app
from reactive_realizer.server.live_scene import LiveScene
from reactive_realizer.server.security import Security

WITH_SOUND = "--autoplay-policy=no-user-gesture-required"
SMALL: ViewportSize = {"width": 900, "height": 500}
PATIENCE = 60_000
"""The longest time for which a page is waited for, ms: software on a busy machine may draw it once a second."""

expect.set_options(timeout=PATIENCE)


@dataclass
class ServedScene:
    """A live scene that is served, and the context of a browser to open it in."""

    live: LiveScene
    address: str
    context: BrowserContext
    errors: list[str] = field(default_factory=list)

    async def open(self, query: str = "?quality=low", address: str | None = None) -> Page:
        """A page that shows every character, by default from the server's own address; errors of the page are kept."""
        page = await self.context.new_page()
        page.on("pageerror", lambda error: self.errors.append(str(error)))
        page.on("console", lambda message: self.errors.append(message.text) if message.type == "error" else None)
        await page.goto((address or self.address) + query)
        everybody = [(id_, "Hips") for id_ in self.live.realizer.characters]
        await page.wait_for_function(
            "who => viewer.connected && viewer.framesPlayed > 0 && who.every(([id, bone]) => viewer.bone(id, bone))",
            arg=everybody,
        )
        return page


Serve = Callable[..., AbstractAsyncContextManager[ServedScene]]


@pytest_asyncio.fixture(scope="module", loop_scope="module")
async def browser(chromium: str) -> AsyncIterator[Browser]:
    """One Chromium for all tests of a module: to start it takes longer than most of them."""
    async with async_playwright() as playwright:
        browser = await playwright.chromium.launch(executable_path=chromium, args=[*FLAGS, WITH_SOUND])
        yield browser
        await browser.close()


@pytest.fixture
def serve(browser: Browser, tmp_path: Path) -> Serve:
    """Serves the scene of a human file."""

    @asynccontextmanager
    async def open_(human: str, voice: str = "text", assets: tuple[Path, ...] = ()) -> AsyncIterator[ServedScene]:
        file = tmp_path / "human.toml"
        file.write_text(human, encoding="utf-8")
        async with (
            open_scene(SceneOptions(file, voice, assets)) as scene,
            served(LiveScene(scene, SystemClock())) as (live, address),
            await browser.new_context(
                viewport=SMALL
            ) as context,  # closes its pages, which draw as long as they are open
        ):
            context.set_default_timeout(PATIENCE)
            served_scene = ServedScene(live, address, context)
            yield served_scene
        assert not served_scene.errors

    return open_


@asynccontextmanager
async def served(live: LiveScene) -> AsyncIterator[tuple[LiveScene, str]]:
    async with asyncio.TaskGroup() as group:
        ticking = group.create_task(live.run())
        runner = web.AppRunner(create_app(live, Security()), handler_cancellation=True, shutdown_timeout=1)
        await runner.setup()
        try:
            await web.TCPSite(runner, "127.0.0.1", 0).start()
            host, port = runner.addresses[0]
            yield live, f"http://{host}:{port}/"
        finally:
            await runner.cleanup()
            ticking.cancel()


@asynccontextmanager
async def far_away(address: str, latency: float) -> AsyncIterator[str]:
    """Another address of a server, to and from which everything takes some time, s."""
    near = urlsplit(address)
    loop = asyncio.get_running_loop()
    ends: list[asyncio.StreamWriter] = []

    async def carry(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        ends.append(writer)
        with suppress(ConnectionError):
            while data := await reader.read(65536):
                loop.call_later(latency, writer.write, data)
        loop.call_later(latency, writer.close)

    async def connect(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        there, back = await asyncio.open_connection(near.hostname, near.port)
        await asyncio.gather(carry(reader, back), carry(there, writer))

    async with await asyncio.start_server(connect, "127.0.0.1", 0) as server:
        host, port = server.sockets[0].getsockname()
        yield f"http://{host}:{port}/"
    for end in ends:
        end.close()
        with suppress(ConnectionError):
            await end.wait_closed()
