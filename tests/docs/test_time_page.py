"""docs/time.md: its drawings are up to date, its programs print their output, and its tables are complete."""

import re
import runpy
import subprocess
import sys
from importlib.metadata import entry_points

import pytest

from reactive_realizer.pegboard import block_pegs, bounded_pegs, open_pegs, time_peg
from reactive_realizer.pegboard.time_peg import TimePeg
from reactive_realizer.testing.pilot import open_pilot

from .conftest import DOCS, Fence, fences, page

PAGE = "docs/time.md"
PROGRAMS = list(zip(fences(PAGE, "python"), fences(PAGE, "text"), strict=True))


@pytest.mark.parametrize(("program", "shown"), PROGRAMS, ids=str)
def test_a_program_on_the_page_prints_the_output_below_it(program: Fence, shown: Fence) -> None:
    printed = subprocess.run([sys.executable, "-c", program.text], capture_output=True, text=True, check=True).stdout
    assert printed == shown.text


def test_the_drawings_are_up_to_date() -> None:
    made = runpy.run_path(str(DOCS / "make_drawings.py"))["drawings"]()
    drawn = {path.name: path.read_text(encoding="utf-8") for path in (DOCS / "pictures").glob("time-*.svg")}
    assert made == drawn, "run `make docs`"
    assert set(re.findall(r"\(pictures/(.+?)\)", page(PAGE))) == set(drawn)


async def test_the_nod_happens_at_the_later_of_the_word_and_the_hit() -> None:
    (block,) = fences(PAGE, "xml")
    async with open_pilot() as pilot:
        pilot.predict("partner", "hit", 0.3)
        pilot.perform(block.text)
        await pilot.tick()
        assert pilot.feedback.predicted("order:nod:start") == pilot.feedback.predicted("order:words:end")
        pilot.predict("partner", "hit", 1.5)
        await pilot.advance(0.1)
        assert pilot.feedback.predicted("order:nod:start") == 1.5
        pilot.predict("partner", "hit", 0.4)
        await pilot.advance(3)
        assert pilot.feedback.time("order:nod:start") == pilot.feedback.time("order:words:end")
        assert pilot.feedback.warnings == []


def test_the_page_lists_every_kind_of_peg() -> None:
    modules = (time_peg, bounded_pegs, block_pegs, open_pegs)
    names = (each for module in modules for each in vars(module).values())
    classes = [each for each in names if isinstance(each, type) and issubclass(each, TimePeg)]
    kinds = {each.kind for each in classes if "kind" in vars(each)}
    listed = re.findall(r"^\| `(\w+)` \| ", page(PAGE).partition("## States")[0], re.MULTILINE)
    assert set(listed) == {*kinds, "predicted"}


def test_the_page_lists_every_strategy() -> None:
    listed = re.findall(r"^\| `(\w+)` \| ", page(PAGE).partition("## Strategies")[2], re.MULTILINE)
    assert set(listed) == {each.name for each in entry_points(group="reactive_realizer.strategies")}
