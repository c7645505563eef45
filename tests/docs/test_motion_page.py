"""docs/motion.md: its block plays, its programs print their output, and the tests that it names exist."""

import re
import subprocess
import sys

import pytest

from reactive_realizer.embodiment.speed_limit import ROOT_SPEED, WRIST_ACCELERATION, WRIST_SPEED
from reactive_realizer.engines.animation.motions.rotation_curves import CURVES
from reactive_realizer.testing.pilot import open_pilot

from .conftest import REPOSITORY, Fence, fences, page

PAGE = "docs/motion.md"
TEXT = page(PAGE)
PROGRAMS = list(zip(fences(PAGE, "python"), fences(PAGE, "text"), strict=True))
LAWS = TEXT.partition("## Which laws hold")[2].partition("\n## ")[0]


@pytest.mark.parametrize(("program", "shown"), PROGRAMS, ids=str)
def test_a_program_on_the_page_prints_the_output_below_it(program: Fence, shown: Fence) -> None:
    printed = subprocess.run([sys.executable, "-c", program.text], capture_output=True, text=True, check=True).stdout
    assert printed == shown.text


async def test_the_transition_on_the_page_leads_from_one_bar_to_the_next() -> None:
    (block,) = fences(PAGE, "xml")
    async with open_pilot() as pilot:
        pilot.perform(block.text)
        await pilot.advance(6)
        assert pilot.feedback.warnings == []
        assert pilot.feedback.status("swing") == "DONE"
        assert pilot.feedback.time("swing:over:end") == pilot.feedback.time("swing:beat:start") == pytest.approx(2.3)


def test_the_transitions_on_the_page_exist() -> None:
    assert set(re.findall(r"`(\w+Transition)`", TEXT)) <= set(CURVES)


def test_the_speed_limits_on_the_page_match_the_code() -> None:
    assert f"{WRIST_SPEED:g} m/s, and {WRIST_ACCELERATION:g} m/s²" in TEXT
    assert f"| the root | {ROOT_SPEED:g} m/s |" in TEXT


def test_the_tests_of_the_laws_exist(subtests: pytest.Subtests) -> None:
    for file in sorted(set(re.findall(r"`([\w/]+\.py)`", LAWS))):
        with subtests.test(file):
            assert (REPOSITORY / "tests" / file).is_file()
