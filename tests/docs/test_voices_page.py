"""docs/voices.md: its blocks are spoken, with the warnings of the page only."""

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.pilot import open_pilot

from .conftest import Fence, fences

EXAMPLES = fences("docs/voices.md", "xml")


@pytest.mark.speech
@pytest.mark.parametrize("example", EXAMPLES, ids=str)
async def test_every_block_is_spoken_with_the_warnings_of_the_page_only(example: Fence) -> None:
    async with open_pilot(SceneOptions(voice="espeak")) as pilot:
        pilot.perform(example.text)
        await pilot.advance(10.0)
        assert pilot.sounds
        told = example.note.removeprefix("warns: ")
        assert [warning.text.partition(": ")[2] for warning in pilot.feedback.of("warningFeedback")] == [
            text for text in [told] if text
        ]
