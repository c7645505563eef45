"""The text and the code blocks of the pages, and a server for their programs."""

import asyncio
import re
from collections.abc import AsyncIterator, Iterator
from contextlib import asynccontextmanager
from dataclasses import dataclass
from pathlib import Path

import pytest
from aiohttp.test_utils import TestServer

from reactive_realizer.assembly.scene import SceneOptions, open_scene
from reactive_realizer.clock.clock import Clock, SystemClock
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.server.app import create_app
from reactive_realizer.server.live_scene import LiveScene
from reactive_realizer.server.security import Security

ADDRESS = "http://127.0.0.1:8088"
"""The address of the server in the examples."""

REPOSITORY = Path(__file__).resolve().parents[2]
DOCS = REPOSITORY / "docs"
EXAMPLES = REPOSITORY / "examples"

_FENCE = re.compile(
    r"(?:^<!-- (?P<note>[^>\n]*) -->\n)?^```(?P<language>\w+)\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL
)

_TIMED = re.compile(r"([\w:,-]+) ([\d.]+)")


@dataclass(frozen=True, slots=True)
class Fence:
    """A fenced block of a page.

    Attributes:
        line: of the page, from 1, where it begins.
        note: the comment right above it, which readers do not see.
    """

    page: str
    line: int
    language: str
    note: str
    text: str

    def __str__(self) -> str:
        return f"{self.page}:{self.line}"

    def noted(self, word: str) -> str:
        """What the note says after a word, such as ``plays: b:g 1.5; warns: b:h``; empty if it does not have it."""
        parts = (part.removeprefix(f"{word}: ") for part in self.note.split("; ") if part.startswith(word))
        return next(parts, "")

    def times(self, word: str) -> list[tuple[str, float]]:
        """The names that the note lists after a word, each with a time, s."""
        return [(name, float(time)) for name, time in _TIMED.findall(self.noted(word))]


class QuickClock(SystemClock):
    """A clock that is five times as fast as the machine's."""

    def now(self) -> GlobalTime:
        return GlobalTime(5 * super().now())

    async def wait_until(self, moment: GlobalTime) -> None:
        await asyncio.sleep(max(0.0, moment - self.now()) / 5)


@pytest.fixture
async def server() -> AsyncIterator[str]:
    """The address of a scene that is served, on the machine's clock."""
    async with serving(SystemClock()) as address:
        yield address


@pytest.fixture
async def quick_server() -> AsyncIterator[str]:
    """The address of a scene that is served faster than real time."""
    async with serving(QuickClock()) as address:
        yield address


@asynccontextmanager
async def serving(clock: Clock) -> AsyncIterator[str]:
    async with open_scene(SceneOptions(voice="text")) as scene, asyncio.TaskGroup() as group:
        live = LiveScene(scene, clock)
        ticking = group.create_task(live.run())
        async with TestServer(create_app(live, Security())) as server:
            yield str(server.make_url("")).rstrip("/")
        ticking.cancel()


def page(name: str) -> str:
    """The text of a page by its path in the repository."""
    return (REPOSITORY / name).read_text(encoding="utf-8")


def fences(name: str, language: str) -> list[Fence]:
    """The fenced blocks of a language on a page, in order."""
    return [fence for fence in _fences(name) if fence.language == language]


def _fences(name: str) -> Iterator[Fence]:
    text = page(name)
    for found in _FENCE.finditer(text):
        line = text.count("\n", 0, found.start("language")) + 1
        yield Fence(name, line, found["language"], found["note"] or "", found["text"])
