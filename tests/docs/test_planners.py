"""The planners of the pages, as programs of their own, against a server on the machine's clock."""

import asyncio
import sys
from collections.abc import AsyncIterator

import pytest
from aiohttp.test_utils import TestServer

from reactive_realizer.assembly.scene import SceneOptions, open_scene
from reactive_realizer.clock.clock import SystemClock
from reactive_realizer.server.app import create_app
from reactive_realizer.server.live import Live
from reactive_realizer.server.security import Security

from .conftest import EXAMPLES, REPOSITORY, fences

ADDRESS = "http://127.0.0.1:8088"


@pytest.fixture
async def server() -> AsyncIterator[TestServer]:
    async with open_scene(SceneOptions(voice="text")) as scene, asyncio.TaskGroup() as group:
        live = Live(scene, SystemClock())
        ticking = group.create_task(live.run())
        async with TestServer(create_app(live, Security())) as server:
            yield server
        ticking.cancel()


async def run(name: str, server: TestServer, last: str) -> list[str]:
    """What an example prints, up to a line that contains something."""
    text = (EXAMPLES / name).read_text(encoding="utf-8")
    assert ADDRESS in text
    program = text.replace(ADDRESS, str(server.make_url("")).rstrip("/"))
    process = await asyncio.create_subprocess_exec(
        sys.executable, "-u", "-c", program, cwd=REPOSITORY, stdout=asyncio.subprocess.PIPE
    )
    assert process.stdout is not None
    printed: list[str] = []
    async for line in process.stdout:
        printed.append(line.decode())
        if last in printed[-1]:
            break
    if process.returncode is None:
        process.kill()
    await process.communicate()
    return printed


async def test_the_planner_of_the_readme_has_its_block_played_and_is_told(server: TestServer) -> None:
    printed = await run("planner.py", server, 'id="hello:end"')
    assert printed[0] == "connected\n"
    assert 'bmla:status="DONE"' in printed[-1]
    assert [line for line in printed if "warningFeedback" in line] == []


async def test_the_moving_peg_is_reached_where_it_was_moved_to(server: TestServer) -> None:
    printed = await run("moving_peg.py", server, "together:end")
    times = {id_: float(time) for id_, time in (line.split() for line in printed)}
    # The stroke was to be two seconds after the block was sent, then two seconds after the hands had set out.
    assert times["together:clap:stroke"] - times["together:clap:start"] > 1.99
    assert times["together:end"] == times["together:clap:end"] > times["together:clap:stroke"]


def test_the_readme_shows_the_planner_as_it_is() -> None:
    (program,) = fences("README.md", "python")
    assert program.text == (EXAMPLES / "planner.py").read_text(encoding="utf-8")
