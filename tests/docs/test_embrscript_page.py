"""docs/embrscript.md: its examples play as the page says."""

import re

import pytest

from reactive_realizer.bml.embr.reader import DIALECT
from reactive_realizer.testing.pilot import open_pilot

from .conftest import Fence, fences

PAGE = "docs/embrscript.md"

_TIMED = re.compile(r"([\w:,-]+) ([\d.]+)")


def _part(example: Fence, word: str) -> str:
    return next((part.removeprefix(f"{word}: ") for part in example.note.split("; ") if part.startswith(word)), "")


@pytest.mark.parametrize("example", [*fences(PAGE, "embr"), *fences(PAGE, "xml")], ids=str)
async def test_an_example_plays_at_the_times_and_with_the_warnings_of_the_page(example: Fence) -> None:
    async with open_pilot() as pilot:
        for name, time in _TIMED.findall(_part(example, "predicts")):
            anticipator, _, point = name.partition(":")
            pilot.predict(anticipator, point, float(time))
        pilot.perform(example.text)
        await pilot.advance(4)
        for name, time in _TIMED.findall(_part(example, "plays")):
            assert pilot.feedback.time(f"{name}:end") == pytest.approx(float(time), abs=0.01)
        for name, time in _TIMED.findall(_part(example, "reports")):
            assert pilot.feedback.time(name) == pytest.approx(float(time))
        announced = [name for name in _part(example, "warns").split(", ") if name]
        assert [id_ for id_, _ in pilot.feedback.warnings] == announced


def test_the_page_has_ten_examples_that_are_recognized() -> None:
    examples = fences(PAGE, "embr")
    assert len(examples) >= 10
    assert all(DIALECT.recognizes(example.text) for example in examples)
