"""The planners of the pages run as separate programs against a server on the machine's clock."""

import asyncio
import os
import re
import shutil
import subprocess
import sys
import wave
from pathlib import Path

import pytest

from reactive_realizer.testing.pilot import open_pilot

from .conftest import ADDRESS, EXAMPLES, REPOSITORY, fences, page

PYTHON = (sys.executable, "-u", "-c")
TO_ITS_END = "what no program prints"


def node() -> tuple[str, ...]:
    """The command that runs a JavaScript module with a WebSocket; without one, the test is skipped."""
    found = shutil.which("node", path=f"{Path(sys.executable).parent}:{os.environ['PATH']}")
    if found is None:
        pytest.skip("no node")
    return found, "--experimental-websocket", "--input-type=module", "--eval"


async def run(name: str, server: str, last: str) -> list[str]:
    """The output of an example, up to a line that contains a text."""
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


async def test_the_moving_peg_is_reached_at_its_last_predicted_time(server: str) -> None:
    printed = await run("moving_peg.py", server, "together:end")
    times = {id_: float(time) for id_, time in (line.split() for line in printed)}
    # It was first predicted 2 s after the block was sent, then 2 s after the hands had started.
    assert times["together:clap:stroke"] - times["together:clap:start"] > 1.99
    assert times["together:end"] == times["together:clap:end"] > times["together:clap:stroke"]


def test_the_program_of_the_readme_prints_the_output_in_the_readme() -> None:
    (program,) = fences("README.md", "python")
    printed = subprocess.run([*PYTHON, program.text], capture_output=True, text=True, check=True).stdout
    assert f"It prints `{printed.strip()}`." in page("README.md")


# --- docs/planners.md


PLANNERS = "docs/planners.md"


STORY = "It is a long story, and nobody has ever heard the end of it."


def heard_in(printed: str) -> int:
    """The number of characters of the story that were heard, as an example says it: up to the end of a word."""
    said = re.search(r"heard (\d+) characters, up to the word '(\w+)'", printed)
    assert said is not None
    heard = STORY[: int(said[1])]
    assert heard.endswith(said[2])
    return len(heard)


async def test_a_planner_that_is_interrupted_yields_and_knows_which_words_were_heard(server: str) -> None:
    for _ in range(2):  # the second time, blocks of the first run have ended
        (printed,) = await run("barge_in.py", server, TO_ITS_END)
        # On a busy machine, the interruption comes later than on the page.
        assert heard_in(page(PLANNERS)) <= heard_in(printed) < len(STORY)


@pytest.mark.parametrize(
    ("barges_in", "statuses"),
    [
        (0.6, {"talk": "INTERRUPTED", "more": "REVOKED", "yield": "DONE", "away": "DONE"}),
        (2.0, {"talk": "DONE", "more": "INTERRUPTED", "yield": "DONE", "away": "DONE"}),
        (None, {"talk": "DONE", "more": "DONE", "yield": "INTERRUPTED", "away": "DONE"}),
    ],
)
async def test_a_story_plays_on_while_an_interrupt_waits(barges_in: float | None, statuses: dict[str, str]) -> None:
    story, _ = fences(PLANNERS, "xml")
    async with open_pilot() as pilot:
        pilot.perform(story.text)
        await pilot.advance(0.5)
        pilot.predict("user", "barges_in", barges_in)
        await pilot.advance(6)
        pilot.block("away", **{"bmla:interrupt": "yield"})
        await pilot.advance(0.1)
        assert {id_: pilot.feedback.status(id_) for id_ in statuses} == statuses
        assert pilot.feedback.warnings == []


async def test_a_planner_answers_an_event_with_an_event(server: str) -> None:
    printed = await run("events.py", server, TO_ITS_END)
    assert printed == ["asked: the way\n", "the wait ended with its event\n"]
    assert all(line.strip() in page(PLANNERS) for line in printed)


async def test_a_voice_from_elsewhere_is_spoken_and_heard(server: str, tmp_path: Path) -> None:
    with wave.open(str(tmp_path / "hello.wav"), "wb") as sound:
        sound.setparams((1, 2, 16_000, 0, "NONE", ""))
        sound.writeframes(b"\0\x20\0\xe0" * 12_000)
    text = (EXAMPLES / "cloud_voice.py").read_text(encoding="utf-8").replace(ADDRESS, server)
    process = await asyncio.create_subprocess_exec(
        *PYTHON, text, str(tmp_path / "hello.wav"), "Hello there.", stdout=asyncio.subprocess.PIPE
    )
    printed, _ = await process.communicate()
    *words, end = printed.decode().splitlines()
    assert [line.split()[-1] for line in words] == ["Hello", "there"]
    assert end == " 1.50 s  heard 12 characters"


async def test_a_dialogue_is_interrupted_by_a_typed_line_and_its_answers_know_what_was_heard(quick_server: str) -> None:
    text = (EXAMPLES / "dialogue.py").read_text(encoding="utf-8").replace(ADDRESS, quick_server)
    process = await asyncio.create_subprocess_exec(
        *PYTHON, text, stdin=asyncio.subprocess.PIPE, stdout=asyncio.subprocess.PIPE
    )
    typed, output = process.stdin, process.stdout
    assert typed is not None
    assert output is not None

    async def printed(about: str) -> str:
        line = (await output.readline()).decode()
        assert line.startswith(about)
        return line.removeprefix(about).strip()

    said = await printed("says:")
    typed.write(b"Where is the mill?\n")
    heard = await printed("heard:")
    assert said.startswith(heard)
    assert "mill" not in heard

    said = await printed("says:")
    assert said.startswith("I was coming to that: at the old mill you turn right. First")
    assert await printed("heard:") == said, "nobody interrupts"

    typed.write(b"And the mill?\n")
    assert await printed("says:") == "As I said, at the old mill you turn right."
    typed.close()
    assert await printed("heard:") == "As I said, at the old mill you turn right."
    assert await process.wait() == 0


async def test_the_javascript_planner_yields_too(server: str) -> None:
    program = (EXAMPLES / "barge_in.mjs").read_text(encoding="utf-8")
    for _ in range(2):
        (printed,) = await run_program(program, server, TO_ITS_END, node())
        assert heard_in(page(PLANNERS)) <= heard_in(printed) < len(STORY)


async def test_a_planner_can_use_http_alone(server: str) -> None:
    predicted, accepted, *told = await run("over_http.py", server, "wave:end")
    assert predicted.startswith("{'time': ")
    assert accepted == "{'blocks': ['wave'], 'warnings': []}\n"
    assert "wave:hello:stroke" in "".join(told)
    assert 'bmla:status="DONE"' in told[-1]


async def test_the_javascript_on_the_page_posts_a_block(server: str) -> None:
    _, program = fences(PLANNERS, "javascript")
    (printed,) = await run_program(program.text, server, "202", node())
    assert f"`{printed.strip()}`" in page(PLANNERS)


def test_the_test_on_the_page_runs_a_planner_without_a_server() -> None:
    program = fences(PLANNERS, "python")[-1]
    printed = subprocess.run([*PYTHON, program.text], capture_output=True, text=True, check=True).stdout
    assert f"It prints `{printed.strip()}`." in page(PLANNERS)


def test_the_page_shows_the_programs_of_the_examples() -> None:
    planner, barge_in, dialogue, events, over_http, _ = fences(PLANNERS, "python")
    in_javascript, _ = fences(PLANNERS, "javascript")
    shown = {
        "planner.py": planner,
        "barge_in.py": barge_in,
        "dialogue.py": dialogue,
        "events.py": events,
        "over_http.py": over_http,
    }
    shown["barge_in.mjs"] = in_javascript
    for name, program in shown.items():
        assert program.text == (EXAMPLES / name).read_text(encoding="utf-8")


def test_the_programs_that_the_page_names_exist() -> None:
    named = re.findall(r"^\| `(\w+\.py)` \|", page(PLANNERS), re.MULTILINE)
    assert len(named) > 5
    assert [name for name in named if not (EXAMPLES / name).exists()] == []


async def test_the_floor_is_held_until_the_route_is_known() -> None:
    _, held = fences(PLANNERS, "xml")
    async with open_pilot() as pilot:
        pilot.perform(held.text)
        await pilot.advance(5)
        assert pilot.feedback.reached("first.words.filler:filler1:end")
        pilot.predict("route", "known", pilot.now)
        await pilot.advance(5)
        assert pilot.feedback.status("first.words.filler") == "INTERRUPTED"
        assert pilot.feedback.status("next") == "DONE"
