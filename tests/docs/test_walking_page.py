"""docs/walking.md: its example plays, and its tables name what there is."""

import re

from reactive_realizer.engines.animation.walking.manner import MANNERS
from reactive_realizer.testing.pilot import open_pilot

from .conftest import fences, page

PAGE = "docs/walking.md"


async def test_the_example_plays_without_warnings() -> None:
    async with open_pilot() as pilot:
        for fence in fences(PAGE, "xml"):
            pilot.perform(fence.text)
        await pilot.advance(10)
        assert pilot.feedback.warnings == []
        assert pilot.feedback.reached("come:there:end")


def test_the_table_of_manners_gives_their_speeds() -> None:
    rows = re.findall(r"\| (\w+) \| ([\d.]+) m/s \| ([\d.]+) m/s \|", page(PAGE))
    assert rows == [(each.name, f"{each.speed:g}", f"{each.top:g}") for each in MANNERS.values()]
