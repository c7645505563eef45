"""Takes pictures of every lexeme and motion unit in the viewer: a strip of moments for each, in docs/gallery.

    python docs/make_gallery.py [--compare] [--assets DIR] [--into FOLDER] [--browser FILE] [NAME...]

With --compare, nothing is written; the strips that differ from the existing ones are listed, with the share of pixels.
With --assets, lexemes of another binding are shown too.
"""

import argparse
import asyncio
import io
import shutil
from collections.abc import AsyncIterator, Iterable, Iterator, Sequence
from contextlib import asynccontextmanager, contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory

from aiohttp import web
from gallery_entries import Entry, entries
from PIL import Image, ImageChops, ImageOps
from playwright.async_api import Page, ViewportSize, async_playwright

from reactive_realizer.assembly.scene import SceneOptions, open_scene
from reactive_realizer.clock.clock import ManualClock
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.lexicon import lexicon_of
from reactive_realizer.realizer.inputs import BmlText, Push
from reactive_realizer.server.app import create_app
from reactive_realizer.server.live_scene import LiveScene
from reactive_realizer.server.security import Security

GALLERY = Path(__file__).parent / "gallery"
FLAGS = ["--no-sandbox", "--use-gl=angle", "--use-angle=gl-egl", "--ignore-gpu-blocklist"]
WITH_SOUND = "--autoplay-policy=no-user-gesture-required"
"""Without this flag, a button that enables sound would be in the picture."""
WIDE: ViewportSize = {"width": 1000, "height": 560}
HIGH: ViewportSize = {"width": 1000, "height": 1200}
"""A high window shows legs and feet."""
NEAR: ViewportSize = {"width": 1000, "height": 600}
"""A window in which the camera comes near to a mouth."""
MOUTH = {"female": 0.183, "male": 0.21}
"""Distance of the mouth from the crown in the picture of a face, m."""
MOMENTS = 7
PUSH_AFTER = 1.0
"""Time from the start of a strip to the push, s."""
LONGEST = 20.0
"""Maximum duration of a strip, s, for behaviors without an end."""

OTHERS = "Other motions"
SECTIONS = {
    "Face lexemes": ("facelexeme",),
    "Action units": ("facefacs",),
    "Further faces": ("facefap", "faceplutchik", "facekeyframe"),
    "Visemes": ("visemes",),
    "Head": ("head", "headdirectionshift"),
    "Gaze": ("gaze", "gazeshift"),
    "Gestures": ("gesture", "pointing"),
    "Postures": ("pose", "stance", "postureshift"),
    "Procedural animations": ("procanimation", "procanimationgesture"),
    OTHERS: (),
}
"""The sections of the page, with the first words of the names of their entries."""

_NOTICEABLE = 24
"""Smallest difference of a pixel that counts, of 255: software renderers differ by less."""


class Studio(LiveScene):
    """A scene that reports a later time than that of its frames, so that the page shows each frame at once.

    Attributes:
        newest: time of the last frame.
    """

    newest = GlobalTime(0.0)

    @property
    def now(self) -> GlobalTime:
        """A time after that of all frames."""
        return GlobalTime(super().now + 3600.0)

    async def step(self, tick: Tick) -> None:
        """Plays a tick, and records the time of its frame."""
        await super().step(tick)
        if tick.frame:
            self.newest = tick.time


@dataclass(frozen=True, slots=True)
class Framing:
    """The window, the size and the crop of a picture.

    Attributes:
        window: of the browser.
        size: of a picture, pixels.
        rows: top and bottom of the part of the canvas around its middle column, pixels; None for all.
    """

    window: ViewportSize
    size: tuple[int, int]
    rows: tuple[int, int] | None = None

    @classmethod
    def of(cls, entry: Entry) -> "Framing":
        """That of an entry."""
        if entry.mouth:
            return cls(NEAR, (150, 120), (140, 460))
        if entry.face:
            return cls(WIDE, (150, 180), (45, 430))
        return cls(HIGH, (150, 300)) if entry.whole_body else cls(WIDE, (180, 240))

    def picture(self, canvas: Image.Image) -> Image.Image:
        """The picture in a screenshot."""
        if self.rows is not None:
            canvas = canvas.crop((0, self.rows[0], canvas.width, self.rows[1]))
        return ImageOps.fit(canvas, self.size)


@dataclass(frozen=True, slots=True)
class Camera:
    """Takes pictures of one character in the viewer.

    Attributes:
        live: the scene.
        page: of the viewer, in a browser.
        framing: of a picture.
    """

    live: Studio
    page: Page
    framing: Framing

    async def picture(self) -> Image.Image:
        """A screenshot of the newest frame."""
        newest = self.live.newest - 1e-6
        shown = "([time, id]) => viewer.lastFrameTime >= time && viewer.morph(id, 'jawOpen') !== null"
        await self.page.wait_for_function(shown, arg=[newest, next(iter(self.live.realizer.characters))])
        await self.page.wait_for_timeout(120)  # low quality draws 12 times a second
        only_canvas = "#viewport > :not(canvas) { visibility: hidden; }"
        shot = Image.open(io.BytesIO(await self.page.locator("#viewport canvas").screenshot(style=only_canvas)))
        return self.framing.picture(shot.convert("RGB"))


async def strip(camera: Camera, entry: Entry) -> Image.Image:
    """An entry at moments from its start to its end, side by side."""
    live = camera.live
    ticks = live.ticker.ticks()
    live.realizer.put(BmlText(entry.block))
    await live.step(await anext(ticks))
    await live.realizer.settle()
    await live.step(await anext(ticks))
    begun, end = live.realizer.time, _end(live, entry)
    if entry.push is not None:
        push = Push(next(iter(live.realizer.characters)), "vl5", entry.push, 0.2)
        live.realizer.put(push, GlobalTime(begun + PUSH_AFTER))
    await camera.page.wait_for_function("viewer.morph('alice', 'jawOpen') !== null")
    await camera.page.click("#shot-face" if entry.face or entry.mouth else "#shot-upper")
    if entry.mouth:
        await approach_mouth(camera.page, entry.avatar)
    pictures = []
    for i in range(MOMENTS):
        moment = begun + (end - begun) * (i + 0.5) / MOMENTS
        while live.realizer.time < moment:
            await live.step(await anext(ticks))
        pictures.append(await camera.picture())
    width, height = camera.framing.size
    whole = Image.new("RGB", (width * MOMENTS, height))
    for i, picture in enumerate(pictures):
        whole.paste(picture, (i * width, 0))
    return whole


def _end(live: LiveScene, entry: Entry) -> float:
    """The time of the last picture of an entry: the end of its block or later."""
    block = live.realizer.scheduler.blocks.find(next(iter(live.realizer.characters)), entry.name)
    now = live.realizer.time
    end = now if block is None or block.end.value is None else block.end.value
    return min(max(end, now + entry.seconds), now + LONGEST)


@contextmanager
def with_avatar(options: SceneOptions, avatar: str) -> Iterator[SceneOptions]:
    """A scene whose character has an avatar of the package."""
    with TemporaryDirectory() as folder:
        human = Path(folder, "human.toml")
        default = options.human.read_text(encoding="utf-8")
        human.write_text(default.replace("avatars/female.glb", f"avatars/{avatar}.glb"), encoding="utf-8")
        yield replace(options, human=human)


async def approach_mouth(page: Page, avatar: str) -> None:
    """Moves the camera from a face near to its mouth, as a user does: by dragging and with the wheel."""
    box = await page.locator("#viewport canvas").bounding_box()
    assert box is not None
    up = (0.16 - MOUTH[avatar]) / 0.42 * box["height"]  # the middle of the shot and its height (web/src/framing.ts)
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    await page.mouse.move(x, y)
    await page.mouse.down(button="right")
    await page.mouse.move(x, y + up, steps=4)
    await page.mouse.up(button="right")
    await page.mouse.move(x, y)
    for _ in range(30):
        await page.mouse.wheel(0, -100)
    await page.wait_for_timeout(2000)  # the camera coasts


@asynccontextmanager
async def studio(options: SceneOptions, page: Page, framing: Framing) -> AsyncIterator[Camera]:
    """Opens a new scene in the viewer."""
    async with open_scene(options) as scene:
        live = Studio(scene, ManualClock())
        runner = web.AppRunner(create_app(live, Security()), shutdown_timeout=1)
        await runner.setup()
        await web.TCPSite(runner, "127.0.0.1", 0).start()
        host, port = runner.addresses[0]
        await page.goto(f"http://{host}:{port}/?quality=low")
        await page.wait_for_function("window.viewer && viewer.connected")
        try:
            yield Camera(live, page, framing)
        finally:
            await page.goto("about:blank")
            await runner.cleanup()


async def make(wanted: Sequence[Entry], options: SceneOptions, folder: Path, browser_file: str, compare: bool) -> int:
    """Make strips in a folder, or compare with the existing ones; the number of those that differ."""
    differing = 0
    async with async_playwright() as playwright:
        browser = await playwright.chromium.launch(executable_path=browser_file, args=[*FLAGS, WITH_SOUND])
        page = await browser.new_page(bypass_csp=True)
        for entry in wanted:
            framing = Framing.of(entry)
            await page.set_viewport_size(framing.window)
            with with_avatar(options, entry.avatar) as own:
                async with studio(own, page, framing) as camera:
                    picture = await strip(camera, entry)
            file = folder / f"{entry.name}.webp"
            if compare:
                share = _difference(file, picture)
                differing += share != 0.0
                print(f"{entry.name}: {_described(share)}")
            else:
                picture.save(file, quality=80, method=6)
                print(file.name)
        await browser.close()
    return differing


def _difference(file: Path, picture: Image.Image) -> float | None:
    """The share of pixels that differ noticeably, 0 to 1; None if there is no existing picture."""
    if not file.is_file():
        return None
    before = Image.open(file).convert("RGB")
    if before.size != picture.size:
        return 1.0
    kept = io.BytesIO()
    picture.save(kept, format="webp", quality=80, method=6)  # compressed like the existing file, for a fair comparison
    differences = ImageChops.difference(before, Image.open(kept).convert("RGB")).convert("L")
    noticed = sum(differences.histogram()[_NOTICEABLE:])
    return noticed / (picture.width * picture.height)


def _described(share: float | None) -> str:
    if share is None:
        return "no picture yet"
    return f"{share:.1%} differs" if share else "same"


def index(all_entries: Iterable[Entry]) -> str:
    """The page that shows all strips, in sections."""
    by_section: dict[str, list[Entry]] = {section: [] for section in SECTIONS}
    for entry in all_entries:
        by_section[section_of(entry)].append(entry)
    lines = [
        "# Gallery",
        "",
        "Every lexeme, action unit, viseme and motion unit at seven moments from start to end.",
        "`make gallery` generates this page.",
        "",
        *(f"- [{section}](#{section.lower().replace(' ', '-')}): {len(own)}" for section, own in by_section.items()),
        "",
    ]
    for section, own in by_section.items():
        lines += [f"## {section}", "", *(line for entry in own for line in _lines(entry))]
    return "\n".join(lines)


def section_of(entry: Entry) -> str:
    """The section in which an entry is shown: that of the first word of its name."""
    kind = entry.name.partition("-")[0]
    return next((section for section, kinds in SECTIONS.items() if kind in kinds), OTHERS)


def _lines(entry: Entry) -> list[str]:
    lines = [f"### {entry.name}", "", f"![{entry.name}]({entry.name}.webp)", ""]
    if entry.caption:
        lines += [entry.caption, ""]
    if not entry.mouth:  # its keyframes are long
        lines += ["```xml", entry.behaviors, "```", ""]
    if entry.push is not None:
        lines += [f"pushed with {max(map(abs, entry.push)):g} N for 0.2 s", ""]
    return lines


async def known(options: SceneOptions) -> list[Entry]:
    """The entries of a scene."""
    async with open_scene(options) as scene:
        engines = next(iter(scene.realizer.characters.values())).engines
        return entries(lexicon_of(engines))


def main() -> None:
    """Run the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", help="make only these, by the names of their files")
    parser.add_argument("--compare", action="store_true", help="list the differences from the existing pictures")
    parser.add_argument("--assets", type=Path, action="append", default=[], metavar="DIR", help="a folder of assets")
    parser.add_argument("--into", type=Path, default=GALLERY, metavar="FOLDER", help="the folder for the pictures")
    parser.add_argument(
        "--browser", default="chromium", metavar="FILE", help="Chromium, as a path or a name on the PATH"
    )
    options = parser.parse_args()
    browser = shutil.which(options.browser)
    if browser is None:
        parser.error(f"there is no program {options.browser}; name a Chromium with --browser")
    scene = SceneOptions(voice="text", assets=tuple(options.assets))
    all_entries = asyncio.run(known(scene))
    wanted = [entry for entry in all_entries if not options.names or entry.name in options.names]
    if missing := set(options.names).difference(entry.name for entry in wanted):
        parser.error(f"unknown names: {', '.join(sorted(missing))}; names are those of the files in {GALLERY.name}")
    options.into.mkdir(exist_ok=True)
    differing = asyncio.run(make(wanted, scene, options.into, browser, options.compare))
    if not options.compare and options.into == GALLERY:
        (GALLERY / "README.md").write_text(index(all_entries), encoding="utf-8")
    raise SystemExit(1 if differing else 0)


if __name__ == "__main__":
    main()
