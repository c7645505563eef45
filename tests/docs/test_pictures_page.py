"""docs/pictures.md: its files are those of the example, and its blocks play as described."""

from pathlib import Path

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.pilot import open_pilot

from .conftest import Fence, fences

PAGE = "docs/pictures.md"
EXAMPLE = Path("examples/pictures")
FENCES = [*fences(PAGE, "xml"), *fences(PAGE, "toml")]


@pytest.mark.parametrize("fence", [fence for fence in FENCES if fence.note], ids=str)
def test_the_page_shows_the_files_of_the_example(fence: Fence) -> None:
    assert fence.text == Path(fence.note).read_text(encoding="utf-8")


@pytest.mark.parametrize("block", [fence for fence in FENCES if fence.text.startswith("<bml")], ids=str)
async def test_a_block_plays_without_warnings_and_the_drawn_face_smiles(block: Fence) -> None:
    async with open_pilot(SceneOptions(EXAMPLE / "human.toml", "text", (EXAMPLE,))) as pilot:
        pilot.watch()
        pilot.perform(block.text)
        await pilot.advance(6)
        assert pilot.feedback.warnings == []
        pictures = [frame.pictures for frame in pilot.frames["paula"]]
    assert all(shown[0] in ("faces/head.png", "faces/blink.png") and shown[1] == "faces/rest.png" for shown in pictures)
    assert any("faces/smile.png" in shown for shown in pictures)


async def test_brows_are_raised_at_the_word_that_the_block_names() -> None:
    async with open_pilot(SceneOptions(EXAMPLE / "human.toml", "text", (EXAMPLE,))) as pilot:
        pilot.watch()
        pilot.perform((EXAMPLE / "greeting.xml").read_text(encoding="utf-8"))
        await pilot.advance(6)
        raised = next(frame.time for frame in pilot.frames["paula"] if "faces/brows-2.png" in frame.pictures)
        assert raised == pytest.approx(pilot.feedback.time("greeting:words:name"), abs=0.021)
