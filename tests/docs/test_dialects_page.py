"""docs/dialects.md: its examples play without warnings, except those that it announces."""

import pytest

from reactive_realizer.assembly.registry import names
from reactive_realizer.testing.pilot import open_pilot

from .conftest import Fence, fences, page

PAGE = "docs/dialects.md"


@pytest.mark.parametrize("example", [*fences(PAGE, "xml"), *fences(PAGE, "embr")], ids=str)
async def test_every_block_of_an_example_is_played_with_the_warnings_of_the_page_only(example: Fence) -> None:
    announced = example.note.removeprefix("plays").removeprefix(", warns: ")
    async with open_pilot() as pilot:
        pilot.perform(example.text)
        await pilot.advance(12)
        block = pilot.feedback.of("blockProgress")[0].id.partition(":")[0]
        assert pilot.feedback.status(block) == "DONE"
        assert [id_ for id_, _ in pilot.feedback.warnings] == [id_ for id_ in announced.split(", ") if id_]


async def test_the_gesture_in_embrscript_is_the_one_in_bml_frame_by_frame() -> None:
    shown: list[list[bytes]] = []
    for script in (fences(PAGE, "xml")[0], fences(PAGE, "embr")[0]):
        async with open_pilot() as pilot:
            pilot.watch()
            pilot.perform(script.text)
            await pilot.advance(3)
            shown.append([frame.rotations.tobytes() for frame in pilot.frames["alice"]])
    assert len(set(shown[0])) > 100
    assert shown[0] == shown[1]


def test_the_page_lists_every_dialect() -> None:
    rows = [line.split("`")[1] for line in page(PAGE).splitlines() if line.startswith("| `")]
    assert set(rows) >= set(names("dialects"))
