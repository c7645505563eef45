"""docs/greta.md: its examples play as the page says."""

import numpy as np
import pytest

from reactive_realizer.testing.pilot import open_pilot

from .conftest import Fence, fences

PAGE = "docs/greta.md"
EXAMPLES = fences(PAGE, "xml")


@pytest.mark.parametrize("example", EXAMPLES, ids=str)
async def test_an_example_plays_at_the_times_and_with_the_warnings_of_the_page(example: Fence) -> None:
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.perform(example.text)
        await pilot.advance(4)
        plays = example.times("plays")
        assert plays
        for name, time in plays:
            assert pilot.feedback.time(f"{name}:end") == pytest.approx(time, abs=0.05)
        announced = [name for name in example.noted("warns").split(", ") if name]
        assert [id_ for id_, _ in pilot.feedback.warnings] == announced
        shown = [np.concatenate((frame.rotations.ravel(), frame.weights)) for frame in pilot.frames["alice"]]
        assert np.ptp(shown, axis=0).max() > 0.05


def test_the_page_has_ten_examples_that_all_differ() -> None:
    assert len({example.text for example in EXAMPLES}) >= 10
