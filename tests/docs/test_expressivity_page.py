"""docs/expressivity.md: its examples play as the page says."""

import re
import tomllib
from pathlib import Path

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.pilot import open_pilot

from .conftest import Fence, fences

PAGE = "docs/expressivity.md"


@pytest.mark.parametrize("example", [*fences(PAGE, "xml"), *fences(PAGE, "embr")], ids=str)
async def test_an_example_plays_at_the_times_of_the_page_without_warnings(example: Fence) -> None:
    async with open_pilot(SceneOptions(voice="text")) as pilot:
        pilot.perform(example.text)
        await pilot.advance(6)
        for name, time in re.findall(r"([\w:]+) ([\d.]+)", example.note.removeprefix("plays: ")):
            assert pilot.feedback.time(name) == pytest.approx(float(time), abs=0.05)
        assert pilot.feedback.warnings == []


async def test_the_character_of_the_page_can_be_played(tmp_path: Path) -> None:
    (example,) = fences(PAGE, "toml")
    assert len(tomllib.loads(example.text)["character"]["alice"]["expressivity"]) == 3
    human = tmp_path / "human.toml"
    human.write_text(example.text)
    async with open_pilot(SceneOptions(human, "text")) as pilot:
        pilot.block("b", '<gesture id="g" lexeme="BEAT"/>')
        await pilot.advance(5)
        assert pilot.feedback.status("b") == "DONE"
