"""Films the page, in a browser without a window, into a video with sound (playwright and PyAV, an extra)."""

import asyncio
import shutil
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import AsyncExitStack, asynccontextmanager
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple

from aiohttp import web

from reactive_realizer.assembly.scene import Scene
from reactive_realizer.clock.clock import Clock
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.embodiment.sound_track import SoundTrack
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.server.app import create_app
from reactive_realizer.server.live_scene import LiveScene
from reactive_realizer.server.security import Security

if TYPE_CHECKING:
    from playwright.async_api import Page

_BROWSERS: Final = ("chromium", "chromium-browser", "google-chrome")
FLAGS: Final = ["--no-sandbox", "--use-gl=angle", "--use-angle=gl-egl", "--ignore-gpu-blocklist"]
"""Without a graphics card, Mesa's software renderer, which is faster than the browser's own."""
_PATIENCE: Final = 60.0
"""The longest time until a picture is drawn, s: the first one waits for the avatars."""


class NoVideo(Fault):
    """A video cannot be made."""

    code = "no-video"
    template = "a video cannot be made: {reason}"
    reason: str


class Picture(NamedTuple):
    """What the pictures of a video show.

    Attributes:
        shot: how much of the characters: face, bust, upper or full.
        size: width and height, pixels, even numbers.
    """

    shot: str = "upper"
    size: tuple[int, int] = (1280, 720)


@asynccontextmanager
async def filmed(
    scene: Scene, clock: Clock, path: Path, picture: Picture
) -> AsyncIterator[Callable[[Tick], Awaitable[None]]]:
    """Film a session that is played in the body: gives what is to be called after each of its ticks.

    Args:
        scene: not played yet.
        clock: of the session.
        path: of the video, MP4 with H.264 and AAC. It is written at the end.
        picture: what it shows, 25 times a second.

    Raises:
        RealizerError: "no-video": there is no browser, a package is missing, or the page cannot show the scene.
    """
    if missing := [name for name in ("av", "playwright") if find_spec(name) is None]:
        reason = f"{' and '.join(missing)} not installed: pip install 'reactive-realizer[video]'"
        raise RealizerError(NoVideo(reason=reason))
    from reactive_realizer.export.video_file import VideoFile

    track = SoundTrack()
    scene.realizer.hear(track.take)
    async with _page(LiveScene(scene, clock), picture) as page:
        video = VideoFile(path, picture.size)

        async def take(tick: Tick) -> None:
            while tick.frame and video.duration <= tick.time:
                video.add(await _taken(page, video.duration))

        yield take
    video.finish(track, scene.realizer.time)


async def _taken(page: "Page", time: float) -> bytes:
    """A picture of a time, s, as JPEG."""
    from playwright.async_api import Error

    try:
        await asyncio.wait_for(page.evaluate("time => film.show(time)", time), _PATIENCE)
        return await page.screenshot(type="jpeg", quality=95)
    except TimeoutError:
        raise RealizerError(NoVideo(reason=f"no picture within {_PATIENCE:g} s")) from None
    except Error as problem:
        raise RealizerError(NoVideo(reason=problem.message.splitlines()[0])) from problem


@asynccontextmanager
async def _page(live: LiveScene, picture: Picture) -> AsyncIterator["Page"]:
    """Open the page of a scene in a browser."""
    from playwright.async_api import Error, async_playwright

    width, height = picture.size
    browsers = (found for name in _BROWSERS if (found := shutil.which(name)))
    async with AsyncExitStack() as stack:
        address = await stack.enter_async_context(_served(live))
        playwright = await stack.enter_async_context(async_playwright())
        try:
            browser = await playwright.chromium.launch(executable_path=next(browsers, None), args=FLAGS)
            stack.push_async_callback(browser.close)
            page = await browser.new_page(viewport={"width": width, "height": height}, bypass_csp=True)
            await page.goto(f"{address}?film={picture.shot}")
            await page.wait_for_function("window.film && film.connected")
        except Error as problem:
            raise RealizerError(NoVideo(reason=problem.message.splitlines()[0])) from problem
        yield page


@asynccontextmanager
async def _served(live: LiveScene) -> AsyncIterator[str]:
    """Serve a scene, which is ticked elsewhere, on this machine; the address."""
    runner = web.AppRunner(create_app(live, Security()), handler_cancellation=True, shutdown_timeout=1)
    await runner.setup()
    try:
        await web.TCPSite(runner, "127.0.0.1", 0).start()
        host, port = runner.addresses[0]
        yield f"http://{host}:{port}/"
    finally:
        await runner.cleanup()
