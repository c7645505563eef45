"""docs/liveliness.md: its blocks play, and its numbers are those of the code."""

import re

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.cli.scene_options import LIVELINESS
from reactive_realizer.liveliness.prosody import MOST_WORDS
from reactive_realizer.testing.pilot import open_pilot

from .conftest import Fence, fences, page

PAGE = "docs/liveliness.md"


@pytest.mark.parametrize("example", fences(PAGE, "xml"), ids=str)
async def test_every_example_plays_without_warnings(example: Fence) -> None:
    async with open_pilot(SceneOptions(voice="text")) as pilot:
        pilot.perform(example.text)
        await pilot.advance(8)
        assert pilot.feedback.warnings == []
        assert pilot.feedback.status("talk") == "DONE"


async def test_the_ids_of_its_blocks_have_the_form_on_the_page() -> None:
    (id_,) = set(re.findall(r"`(talk\.[a-z0-9.]+)`", page(PAGE)))
    async with open_pilot(SceneOptions(voice="text", liveliness=LIVELINESS)) as pilot:
        pilot.block("talk", '<speech id="words"><text>We never said that it was easy.</text></speech>')
        await pilot.advance(1)
        assert pilot.feedback.reached(f"{id_}:start")


def test_the_default_and_the_longest_phrase_are_on_the_page() -> None:
    assert f"{LIVELINESS} without this option" in page(PAGE)
    assert MOST_WORDS == 9
    assert "more than nine" in page(PAGE)
