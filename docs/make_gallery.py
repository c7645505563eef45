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
from gallery_entries import entries
from gallery_entry import Entry
from PIL import Image, ImageChops
from playwright.async_api import Page, ViewportSize, async_playwright

from reactive_realizer.assembly.scene import SceneOptions, open_scene
from reactive_realizer.clock.clock import ManualClock
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.lexicon import lexicon_of
from reactive_realizer.export.video import FLAGS
from reactive_realizer.realizer.inputs import BmlText, Push
from reactive_realizer.server.app import create_app
from reactive_realizer.server.live_scene import LiveScene
from reactive_realizer.server.security import Security

GALLERY = Path(__file__).parent / "gallery"
CLOSEUPS = {
    ("mouth", "female"): (4.4, 0.56),
    ("mouth", "male"): (4.4, 0.62),
    ("eyes", "female"): (3.6, 0.40),
    ("nose", "male"): (4.4, 0.54),
}
"""For a part of the face of an avatar, how large the face is, and the height of the part, as a share from above."""
MOMENTS = 7
FRAME = 0.02
"""Time between two frames, s."""
PUSH_AFTER = 1.0
"""Time from the start of a strip to the push, s."""
LONGEST = 20.0
"""Maximum duration of a strip, s, for behaviors without an end."""

OTHERS = "Other motions"
SECTIONS = {
    "Face lexemes": ("facelexeme",),
    "Action units": ("facefacs",),
    "MPEG-4 parameters": ("faps", "facefap"),
    "Further faces": ("faceplutchik", "facekeyframe"),
    "Visemes": ("visemes",),
    "Head": ("head", "headdirectionshift"),
    "Gaze": ("gaze", "gazeshift"),
    "Gestures": ("gesture", "pointing", "murmlgesture"),
    "Expressivity": ("expressivity",),
    "Postures": ("pose", "stance", "postureshift"),
    "Procedural animations": ("procanimation", "procanimationgesture"),
    "One gesture in three languages": ("language",),
    OTHERS: (),
}
"""The sections of the page, with the first words of the names of their entries."""

_NOTICEABLE = 24
"""Smallest difference of a pixel that counts, of 255: software renderers differ by less."""


@dataclass(frozen=True, slots=True)
class Framing:
    """Chooses the shot, the size and the crop of a picture.

    Attributes:
        shot: of the film (`web/src/framing.ts`).
        size: of a picture, pixels.
        zoom: how many times as large the window is.
        middle: height of the middle of the picture in the window, as a share of it from above.
    """

    shot: str
    size: tuple[int, int]
    zoom: float = 1.0
    middle: float = 0.5

    @classmethod
    def of(cls, entry: Entry) -> "Framing":
        """That of an entry."""
        if entry.closeup:
            return cls("face", (150, 120), *CLOSEUPS[entry.closeup, entry.avatar])
        if entry.face:
            return cls("face", (165, 180), 1.35, 0.47)
        return cls("full", (260, 300)) if entry.whole_body else cls("upper", (300, 240))

    @property
    def window(self) -> ViewportSize:
        """The size of the window."""
        width, height = self.size
        return {"width": round(self.zoom * width), "height": round(self.zoom * height)}

    def picture(self, whole: Image.Image) -> Image.Image:
        """The picture in a screenshot of the window."""
        width, height = self.size
        left, top = (whole.width - width) // 2, round(self.middle * whole.height - height / 2)
        return whole.crop((left, top, left + width, top + height))


@dataclass(frozen=True, slots=True)
class Camera:
    """Takes pictures of a scene in the page.

    Attributes:
        live: the scene.
        page: in a browser, as a film.
        framing: of a picture.
    """

    live: LiveScene
    page: Page
    framing: Framing

    async def picture(self, time: float) -> Image.Image:
        """A picture of a time, s, whose frame has been sent."""
        await self.page.evaluate("time => film.show(time)", time)
        shot = await self.page.screenshot(style="#captions { visibility: hidden; }")
        return self.framing.picture(Image.open(io.BytesIO(shot)).convert("RGB"))


async def strip(camera: Camera, entry: Entry) -> Image.Image:
    """An entry at moments from its start to its end, side by side."""
    live = camera.live
    ticks = live.ticker.ticks()
    live.realizer.put(BmlText(entry.document))
    await live.step(await anext(ticks))
    await live.realizer.settle()
    await live.step(await anext(ticks))
    begun, end = live.realizer.time, _end(live, entry)
    if entry.push is not None:
        push = Push(next(iter(live.realizer.characters)), "vl5", entry.push, 0.2)
        live.realizer.put(push, GlobalTime(begun + PUSH_AFTER))
    pictures = []
    count = entry.held or MOMENTS
    for i in range(count):
        moment = begun + (end - begun) * (i + 0.5) / count
        while live.realizer.time < moment + FRAME:
            await live.step(await anext(ticks))
        pictures.append(await camera.picture(moment))
    width, height = camera.framing.size
    whole = Image.new("RGB", (width * count, height))
    for i, picture in enumerate(pictures):
        whole.paste(picture, (i * width, 0))
    return whole


def _end(live: LiveScene, entry: Entry) -> float:
    """The time of the last picture of an entry: the end of its block or later."""
    block = live.realizer.scheduler.blocks.find(next(iter(live.realizer.characters)), entry.block)
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


@asynccontextmanager
async def studio(options: SceneOptions, page: Page, framing: Framing) -> AsyncIterator[Camera]:
    """Opens a new scene in the viewer."""
    async with open_scene(options) as scene:
        live = LiveScene(scene, ManualClock())
        runner = web.AppRunner(create_app(live, Security()), shutdown_timeout=1)
        await runner.setup()
        await web.TCPSite(runner, "127.0.0.1", 0).start()
        host, port = runner.addresses[0]
        await page.goto(f"http://{host}:{port}/?film={framing.shot}")
        await page.wait_for_function("window.film && film.connected")
        try:
            yield Camera(live, page, framing)
        finally:
            await page.goto("about:blank")
            await runner.cleanup()


async def make(wanted: Sequence[Entry], options: SceneOptions, folder: Path, browser_file: str, compare: bool) -> int:
    """Make strips in a folder, or compare with the existing ones; the number of those that differ."""
    differing = 0
    async with async_playwright() as playwright:
        browser = await playwright.chromium.launch(executable_path=browser_file, args=FLAGS)
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
        "Every lexeme, action unit, MPEG-4 parameter, viseme and motion unit at seven moments from start to end.",
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
    if not entry.held:  # its keyframes are long
        language, text = ("embr", entry.script) if entry.script else ("xml", entry.behaviors)
        lines += [f"```{language}", text, "```", ""]
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
