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


@pytest.mark.parametrize("turn", [1, -1], ids=["written so", "written the other way round"])
@pytest.mark.parametrize("jump", [1, 30])
async def test_what_engines_ask_for_is_done_in_order_of_time_whatever_was_written_first(pilot, jump, turn) -> None:
    interrupt = '<bmla:interrupt id="i" target="{0}" start="{1}"/>'
    activate = '<bmla:activate id="a" target="{0}" start="{1}"/>'
    for name, *events in (
        ("cut", interrupt.format("cut", 0.101), activate.format("cut", 0.105)),
        ("woken", activate.format("woken", 0.101), interrupt.format("woken", 0.105)),
    ):
        pilot.block(name, '<wait id="w" duration="1"/>', **{"bmla:preplan": "true"})
        pilot.block(f"on_{name}", "".join(events[::turn]))
    for number in range(0, 121, jump):
        await pilot.realizer.step(Tick(number, tick_time(number - jump), frame=False))
    # The interrupt finds one of them asleep and the other one awake; both are gone before they begin.
    assert pilot.feedback.warnings == [("on_cut:a", "IMPOSSIBLE_TO_SCHEDULE")]
    assert (pilot.feedback.time("cut:end"), pilot.feedback.time("woken:end")) == (0.101, 0.105)


SPEECH = '<speech id="s"{}><text>one two three four</text></speech>'  # 1.08 s
RIGHT = '<gesture id="g" lexeme="BEAT" mode="RIGHT_HAND"{}/>'


@pytest.mark.parametrize(
    ("first", "second"),
    [
        (SPEECH.format(""), SPEECH.format(' start="1.0"')),
        (RIGHT.format(' start="0" end="1.08"'), RIGHT.format(' start="1.0" end="2.5"')),
        (SPEECH.format("") + '<bmla:interrupt id="i" target="one" start="1.05"/>', SPEECH.format(' start="1.0"')),
    ],
)
@pytest.mark.parametrize("late", [(), range(91, 120)], ids=["on time", "late"])
async def test_who_plays_when_the_later_one_is_to_start_keeps_what_it_has(pilot, late, first, second) -> None:
    pilot.block("one", first)
    pilot.block("two", second)
    await skip(pilot, late)
    ((id_, _),) = pilot.feedback.warnings
    assert id_ in ("two:s", "two:g")


@pytest.mark.parametrize("late", [(), range(91, 120)], ids=["on time", "late"])
async def test_so_it_is_when_the_later_one_is_in_a_block_that_starts_in_the_same_tick(pilot, late) -> None:
    pilot.block("one", SPEECH.format(""))
    pilot.block("before", '<wait id="w" duration="1"/>')
    pilot.block("two", SPEECH.format(""), **{"bmla:appendAfter": "before"})
    await skip(pilot, late)
    assert pilot.feedback.warnings == [("two:s", "IMPOSSIBLE_TO_SCHEDULE")]
    assert pilot.feedback.time("two:start") == 1.0


@pytest.mark.parametrize("late", [(), range(91, 120)], ids=["on time", "late"])
async def test_what_is_free_again_at_the_very_time_is_free_however_late_the_tick(pilot, late) -> None:
    pilot.block("one", SPEECH.format("") + RIGHT.format(' start="0" relax="0.93"'))
    pilot.block("two", SPEECH.format(' start="one:s:end"') + RIGHT.format(' start="0.99" end="2.5"'))
    pilot.block("three", '<bmla:interrupt id="i" target="two" start="1.105"/>' + SPEECH.format(' start="i:start"'))
    await skip(pilot, late)
    assert pilot.feedback.warnings == []
    assert pilot.feedback.time("two:s:start") == pilot.feedback.time("one:s:end") == 1.08
    assert pilot.feedback.time("three:s:start") == pilot.feedback.time("two:s:end") == 1.105


async def skip(pilot, late):
    """Four seconds without some ticks."""
    previous = -1
    for number in (number for number in range(400) if number not in late):
        await pilot.realizer.step(Tick(number, tick_time(previous), frame=False))
        previous = number
