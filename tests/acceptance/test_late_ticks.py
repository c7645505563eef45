"""However late a tick is: frames may be lost, sync points and times are not."""

import pytest

from reactive_realizer.clock.ticker import Tick, tick_time
from reactive_realizer.realizer.inputs import BmlText
from reactive_realizer.testing.pilot import block, open_pilot

BLOCKS = [
    block("one", '<speech id="s"><text>One <sync id="m"/>two.</text></speech><gesture id="g" lexeme="BEAT"/>'),
    block("two", '<wait id="w" duration="0.123"/>', composition="APPEND"),
    block("three", '<head id="h" lexeme="NOD" start="two:w:end"/>'),
    block("four", '<head id="h" lexeme="SHAKE" end="three:h:end"/>'),
]
REGULAR = range(1001)


async def play(pilot, numbers):
    for text in BLOCKS:
        pilot.realizer.put(BmlText(text))
    previous = tick_time(-100)
    for number in numbers:
        await pilot.realizer.step(Tick(number, previous, frame=False))
        previous = tick_time(number)
    return sorted((line.at, line.id) for line in pilot.feedback.lines if line.kind.endswith("Progress"))


@pytest.fixture
async def regular():
    async with open_pilot() as pilot:
        return await play(pilot, REGULAR)


@pytest.mark.parametrize("jump", [3, 17, 50, 400, 1000])
async def test_ticks_that_jump_report_the_same_points_with_the_same_times(pilot, regular, jump) -> None:
    assert await play(pilot, range(0, 1001, jump)) == regular
    assert pilot.feedback.warnings == []


async def test_within_one_late_tick_every_block_still_starts_before_its_points_and_ends_after_them(pilot) -> None:
    await play(pilot, [0, 1000])
    told = pilot.feedback.progress
    for name in ("one", "two", "three", "four"):
        own = [id_ for id_ in told if id_.startswith(f"{name}:")]
        assert (own[0], own[-1]) == (f"{name}:start", f"{name}:end")
        assert len(own) == len(set(own))
