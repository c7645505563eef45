"""docs/embrscript.md: its examples play as the page says."""

import pytest

from reactive_realizer.bml.embr.reader import DIALECT
from reactive_realizer.testing.pilot import open_pilot

from .conftest import Fence, fences

PAGE = "docs/embrscript.md"


@pytest.mark.parametrize("example", [*fences(PAGE, "embr"), *fences(PAGE, "xml")], ids=str)
async def test_an_example_plays_at_the_times_and_with_the_warnings_of_the_page(example: Fence) -> None:
    async with open_pilot() as pilot:
        for name, time in example.times("predicts"):
            anticipator, _, point = name.partition(":")
            pilot.predict(anticipator, point, time)
        pilot.perform(example.text)
        await pilot.advance(4)
        for name, time in example.times("plays"):
            assert pilot.feedback.time(f"{name}:end") == pytest.approx(time, abs=0.01)
        for name, time in example.times("reports"):
            assert pilot.feedback.time(name) == pytest.approx(time)
        announced = [name for name in example.noted("warns").split(", ") if name]
        assert [id_ for id_, _ in pilot.feedback.warnings] == announced


def test_the_page_has_ten_examples_that_are_recognized() -> None:
    examples = fences(PAGE, "embr")
    assert len(examples) >= 10
    assert all(DIALECT.recognizes(example.text) for example in examples)
