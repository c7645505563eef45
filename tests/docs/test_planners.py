"""The planners of the pages, as programs of their own, against a server on the machine's clock."""

import asyncio
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from reactive_realizer.testing.pilot import open_pilot

from .conftest import ADDRESS, EXAMPLES, REPOSITORY, fences, page

PYTHON = (sys.executable, "-u", "-c")
TO_ITS_END = "what no program prints"


def node() -> tuple[str, ...]:
    """What runs a module of JavaScript with a WebSocket; the test is left out where there is none."""
    found = shutil.which("node", path=f"{Path(sys.executable).parent}:{os.environ['PATH']}")
    if found is None:
        pytest.skip("no node")
    return found, "--experimental-websocket", "--input-type=module", "--eval"


async def run(name: str, server: str, last: str) -> list[str]:
    """What an example prints, up to a line that contains something."""
    text = (EXAMPLES / name).read_text(encoding="utf-8")
    return await run_program(text, server, last, PYTHON)


async def run_program(text: str, server: str, last: str, command: tuple[str, ...]) -> list[str]:
    assert ADDRESS in text
    program = text.replace(ADDRESS, server)
    process = await asyncio.create_subprocess_exec(*command, program, cwd=REPOSITORY, stdout=asyncio.subprocess.PIPE)
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


async def test_the_first_planner_prints_feedback_until_its_block_ends(server: str) -> None:
    printed = await run("planner.py", server, TO_ITS_END)
    assert printed[0] == "connected\n"
    assert 'bmla:status="DONE"' in printed[-1]
    assert [line for line in printed if "warningFeedback" in line] == []


async def test_the_moving_peg_is_reached_where_it_was_moved_to(server: str) -> None:
    printed = await run("moving_peg.py", server, "together:end")
    times = {id_: float(time) for id_, time in (line.split() for line in printed)}
    # The stroke was to be two seconds after the block was sent, then two seconds after the hands had set out.
    assert times["together:clap:stroke"] - times["together:clap:start"] > 1.99
    assert times["together:end"] == times["together:clap:end"] > times["together:clap:stroke"]


def test_the_program_of_the_readme_prints_what_the_readme_says() -> None:
    (program,) = fences("README.md", "python")
    printed = subprocess.run([*PYTHON, program.text], capture_output=True, text=True, check=True).stdout
    assert f"It prints `{printed.strip()}`." in page("README.md")


# --- docs/planners.md


PLANNERS = "docs/planners.md"


async def test_whoever_barges_in_is_given_way_to_and_the_planner_knows_what_was_heard(server: str) -> None:
    for _ in range(2):  # also where somebody barged in before
        (printed,) = await run("barge_in.py", server, TO_ITS_END)
        assert printed.strip() in page(PLANNERS)


@pytest.mark.parametrize(
    ("barges_in", "statuses"),
    [
        (0.6, {"talk": "INTERRUPTED", "more": "REVOKED", "yield": "DONE", "away": "DONE"}),
        (2.0, {"talk": "DONE", "more": "INTERRUPTED", "yield": "DONE", "away": "DONE"}),
        (None, {"talk": "DONE", "more": "DONE", "yield": "INTERRUPTED", "away": "DONE"}),
    ],
)
async def test_a_story_goes_on_beside_what_waits_to_break_it_off(barges_in: float, statuses: dict[str, str]) -> None:
    (story,) = fences(PLANNERS, "xml")
    async with open_pilot() as pilot:
        pilot.perform(story.text)
        await pilot.advance(0.5)
        pilot.predict("user", "barges_in", barges_in)
        await pilot.advance(6)
        pilot.block("away", **{"bmla:interrupt": "yield"})
        await pilot.advance(0.1)
        assert {id_: pilot.feedback.status(id_) for id_ in statuses} == statuses
        assert pilot.feedback.warnings == []


async def test_the_same_in_javascript(server: str) -> None:
    program = (EXAMPLES / "barge_in.mjs").read_text(encoding="utf-8")
    for _ in range(2):
        (printed,) = await run_program(program, server, TO_ITS_END, node())
        assert printed.strip() in page(PLANNERS)


async def test_a_planner_needs_nothing_but_http(server: str) -> None:
    predicted, accepted, *told = await run("over_http.py", server, "wave:end")
    assert predicted.startswith("{'time': ")
    assert accepted == "{'blocks': ['wave']}\n"
    assert "wave:hello:stroke" in "".join(told)
    assert 'bmla:status="DONE"' in told[-1]


async def test_a_block_is_posted_from_javascript(server: str) -> None:
    _, program = fences(PLANNERS, "javascript")
    (printed,) = await run_program(program.text, server, "202", node())
    assert f"`{printed.strip()}`" in page(PLANNERS)


def test_a_planner_is_tested_without_a_server() -> None:
    program = fences(PLANNERS, "python")[-1]
    printed = subprocess.run([*PYTHON, program.text], capture_output=True, text=True, check=True).stdout
    assert f"It prints `{printed.strip()}`." in page(PLANNERS)


def test_the_page_shows_the_programs_as_they_are() -> None:
    planner, barge_in, over_http, _ = fences(PLANNERS, "python")
    in_javascript, _ = fences(PLANNERS, "javascript")
    shown = {"planner.py": planner, "barge_in.py": barge_in, "over_http.py": over_http, "barge_in.mjs": in_javascript}
    for name, program in shown.items():
        assert program.text == (EXAMPLES / name).read_text(encoding="utf-8")


def test_the_page_names_programs_that_are_there() -> None:
    named = re.findall(r"^\| `(\w+\.py)` \|", page(PLANNERS), re.MULTILINE)
    assert len(named) > 5
    assert [name for name in named if not (EXAMPLES / name).exists()] == []
