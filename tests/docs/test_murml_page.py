"""docs/murml.md: its examples play as the page says."""

import pytest

from reactive_realizer.testing.pilot import open_pilot

from .conftest import Fence, fences

PAGE = "docs/murml.md"
EXAMPLES = fences(PAGE, "xml")


@pytest.mark.parametrize("example", EXAMPLES, ids=str)
async def test_an_example_plays_at_the_times_and_with_the_warnings_of_the_page(example: Fence) -> None:
    async with open_pilot() as pilot:
        pilot.perform(example.text)
        await pilot.advance(4)
        for name, time in example.times("plays"):
            assert pilot.feedback.time(f"{name}:end") == pytest.approx(time, abs=0.05)
        for name, time in example.times("reports"):
            assert pilot.feedback.time(name) == pytest.approx(time, abs=0.05)
        announced = [name for name in example.noted("warns").split(", ") if name]
        assert [id_ for id_, _ in pilot.feedback.warnings] == announced


def test_the_page_has_ten_examples() -> None:
    assert len(EXAMPLES) == 10
