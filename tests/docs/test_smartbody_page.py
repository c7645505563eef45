"""docs/smartbody.md: its examples play as the page says, each moving the character."""

from pathlib import Path

import numpy as np
import pytest

from reactive_realizer.assembly.scene import DEFAULT_HUMAN, SceneOptions
from reactive_realizer.testing.pilot import open_pilot

from .conftest import Fence, fences

PAGE = "docs/smartbody.md"
EXAMPLES = fences(PAGE, "xml")


@pytest.fixture
def assets(tmp_path: Path) -> Path:
    """The files of docs/binding.md, which the examples use."""
    for fence in (*fences("docs/binding.md", "xml"), *fences("docs/binding.md", "text")):
        if fence.note.startswith("my_assets/"):
            (tmp_path / fence.note.removeprefix("my_assets/")).write_text(fence.text, encoding="utf-8")
    (tmp_path / "gesturebinding.xml").unlink(missing_ok=True)
    return tmp_path


@pytest.mark.parametrize("example", EXAMPLES, ids=str)
async def test_an_example_plays_at_the_times_and_with_the_warnings_of_the_page(example: Fence, assets: Path) -> None:
    folders = (assets,) if "assets" in example.note else ()
    async with open_pilot(SceneOptions(DEFAULT_HUMAN, "text", folders)) as pilot:
        pilot.watch()
        pilot.move("cup", (-0.25, 1.15, 0.4))
        pilot.perform(example.text)
        await pilot.advance(10)
        told = pilot.feedback
        plays = example.times("plays")
        assert plays
        for name, time in plays:
            assert told.time(f"{name}:end") == pytest.approx(time, abs=0.05)
        announced = [name for name in example.noted("warns").split(", ") if name]
        assert [id_ for id_, _ in told.warnings] == announced
        for block, status in [example.noted("status").split()] if example.noted("status") else []:
            assert told.status(block) == status
        events = [element.get("name") for xml in told.messages for element in xml.element.iter("{*}event")]
        assert events == ([example.noted("event")] if example.noted("event") else events)
        shown = [
            np.concatenate((frame.root, frame.rotations.ravel(), frame.weights)) for frame in pilot.frames["alice"]
        ]
        assert np.ptp(shown, axis=0).max() > 0.05


def test_the_page_has_more_than_ten_examples_that_all_differ() -> None:
    assert len({example.text for example in EXAMPLES}) == len(EXAMPLES) > 10
