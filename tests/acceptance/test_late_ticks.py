"""Late ticks: frames may be skipped, sync points and their times are not."""

import asyncio
from collections.abc import Iterable
from functools import cache

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.clock.ticker import Tick, tick_time
from reactive_realizer.realizer.inputs import BmlText, Prediction
from reactive_realizer.testing.pilot import RealizerPilot, block, open_pilot

BLOCKS = [
    block("one", '<speech id="s"><text>One <sync id="m"/>two.</text></speech><gesture id="g" lexeme="BEAT"/>'),
    block("two", '<wait id="w" duration="0.123"/>', composition="APPEND"),
    block("three", '<head id="h" lexeme="NOD" start="two:w:end"/>'),
    block("four", '<head id="h" lexeme="SHAKE" end="three:h:end"/>'),
]
REGULAR = range(1001)


async def play(pilot: RealizerPilot, numbers: list[int] | range) -> list[tuple[float, str]]:
    for text in BLOCKS:
        pilot.realizer.put(BmlText(text))
    previous = tick_time(-100)
    for number in numbers:
        await pilot.realizer.step(Tick(number, previous, frame=False))
        previous = tick_time(number)
    return sorted((line.global_time, line.id) for line in pilot.feedback.messages if line.kind.endswith("Progress"))


@pytest.fixture
async def regular() -> list[tuple[float, str]]:
    async with open_pilot() as pilot:
        return await play(pilot, REGULAR)


@pytest.mark.parametrize("jump", [3, 17, 50, 400, 1000])
async def test_ticks_that_jump_report_the_same_points_with_the_same_times(
    pilot: RealizerPilot,
    regular: list[tuple[float, str]],
    jump: int,
) -> None:
    assert await play(pilot, range(0, 1001, jump)) == regular
    assert pilot.feedback.warnings == []


async def test_in_a_late_tick_every_block_starts_before_its_points_and_ends_after_them(
    pilot: RealizerPilot,
) -> None:
    await play(pilot, [0, 1000])
    told = pilot.feedback.progress
    for name in ("one", "two", "three", "four"):
        own = [id_ for id_ in told if id_.startswith(f"{name}:")]
        assert (own[0], own[-1]) == (f"{name}:start", f"{name}:end")
        assert len(own) == len(set(own))


@pytest.mark.parametrize("turn", [1, -1], ids=["written so", "written the other way round"])
@pytest.mark.parametrize("jump", [1, 30])
async def test_requests_of_engines_are_carried_out_in_order_of_time(pilot: RealizerPilot, jump: int, turn: int) -> None:
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
async def test_a_playing_behavior_keeps_its_resource_in_a_late_tick(
    pilot: RealizerPilot, late: Iterable[int], first: str, second: str
) -> None:
    pilot.block("one", first)
    pilot.block("two", second)
    await skip(pilot, late)
    ((id_, _),) = pilot.feedback.warnings
    assert id_ in ("two:s", "two:g")


@pytest.mark.parametrize("late", [(), range(91, 120)], ids=["on time", "late"])
async def test_a_playing_behavior_keeps_its_resource_from_a_block_that_starts_in_the_same_tick(
    pilot: RealizerPilot, late: Iterable[int]
) -> None:
    pilot.block("one", SPEECH.format(""))
    pilot.block("before", '<wait id="w" duration="1"/>')
    pilot.block("two", SPEECH.format(""), **{"bmla:appendAfter": "before"})
    await skip(pilot, late)
    assert pilot.feedback.warnings == [("two:s", "IMPOSSIBLE_TO_SCHEDULE")]
    assert pilot.feedback.time("two:start") == 1.0


@pytest.mark.parametrize("late", [(), range(91, 120)], ids=["on time", "late"])
async def test_a_resource_released_at_the_start_of_a_behavior_is_free_in_a_late_tick(
    pilot: RealizerPilot, late: Iterable[int]
) -> None:
    pilot.block("one", SPEECH.format("") + RIGHT.format(' start="0" relax="0.93"'))
    pilot.block("two", SPEECH.format(' start="one:s:end"') + RIGHT.format(' start="0.99" end="2.5"'))
    pilot.block("three", '<bmla:interrupt id="i" target="two" start="1.105"/>' + SPEECH.format(' start="i:start"'))
    await skip(pilot, late)
    assert pilot.feedback.warnings == []
    assert pilot.feedback.time("two:s:start") == pilot.feedback.time("one:s:end") == 1.08
    assert pilot.feedback.time("three:s:start") == pilot.feedback.time("two:s:end") == 1.105


@pytest.mark.parametrize("late", [(), range(91, 150)], ids=["on time", "late"])
async def test_conflicts_are_resolved_before_a_later_interrupt_in_the_same_tick(
    pilot: RealizerPilot, late: Iterable[int]
) -> None:
    pilot.block("one", RIGHT.format(' start="0" end="2.5"'))
    pilot.block("two", RIGHT.format(' start="1"') + '<wait id="w" duration="2"/>')
    pilot.block("three", '<bmla:interrupt id="i" target="two" start="1.1"/>')
    await skip(pilot, late)
    assert pilot.feedback.warnings == [("two:g", "IMPOSSIBLE_TO_SCHEDULE")]
    assert not pilot.feedback.reached("two:g:start")


@pytest.mark.parametrize("late", [(), range(91, 150)], ids=["on time", "late"])
async def test_a_gesture_ends_when_the_next_one_takes_its_arm_in_a_late_tick(
    pilot: RealizerPilot, late: Iterable[int]
) -> None:
    pilot.block("one", RIGHT.format(' start="0" relax="0.93"'))
    pilot.block("two", RIGHT.format(' start="1" end="2.5"'))
    pilot.block("three", '<wait id="w" duration="1"/>', **{"bmla:appendAfter": "one"})
    await skip(pilot, late)
    assert pilot.feedback.time("one:g:end") == pilot.feedback.time("three:start") == 1.0


@pytest.mark.parametrize("late", [(), range(91, 150)], ids=["on time", "late"])
async def test_a_block_whose_last_behavior_is_dropped_ends_at_the_planned_start_of_that_behavior(
    pilot: RealizerPilot, late: Iterable[int]
) -> None:
    pilot.block("one", RIGHT.format(' start="0" end="2"'))
    pilot.block("two", RIGHT.format(' start="1" end="2.5"'))
    pilot.block("three", '<wait id="w" duration="1"/>', **{"bmla:appendAfter": "two"})
    await skip(pilot, late)
    assert pilot.feedback.warnings == [("two:g", "IMPOSSIBLE_TO_SCHEDULE")]
    assert pilot.feedback.time("two:end") == pilot.feedback.time("three:start") == 1.0


@pytest.mark.parametrize("late", [(), range(41, 150)], ids=["on time", "late"])
async def test_a_speech_finishes_its_word_in_a_late_tick_and_its_lost_end_is_no_mistake(
    pilot: RealizerPilot, late: Iterable[int]
) -> None:
    pilot.block("one", SPEECH.format(' end="1.58"'))
    pilot.block("two", '<bmla:interrupt id="i" target="one" start="0.812" speech="word"/>')
    await skip(pilot, late)
    assert pilot.feedback.time("one:s:end") == 0.98
    assert pilot.feedback.warnings == []


@pytest.mark.parametrize("late", [(), range(91, 150)], ids=["on time", "late"])
async def test_inputs_of_a_late_tick_enter_after_the_skipped_ticks(pilot: RealizerPilot, late: Iterable[int]) -> None:
    pilot.block("one", RIGHT.format(' start="0" relax="0.93"'))
    pilot.block("two", '<wait id="w" duration="1"/>', **{"bmla:chunkAfter": "one"})
    pilot.realizer.put(BmlText(block("three", RIGHT.format(""), composition="REPLACE")), tick_time(150))
    await skip(pilot, late)
    assert pilot.feedback.time("two:start") == 0.93
    assert pilot.feedback.time("two:w:end") == pilot.feedback.time("three:g:start") == 1.5


@pytest.mark.parametrize("late", [(), range(91, 150)], ids=["on time", "late"])
async def test_a_block_that_was_due_in_a_skipped_tick_starts_before_it_is_replaced(
    pilot: RealizerPilot, late: Iterable[int]
) -> None:
    pilot.predict("partner", "hit", 1.0)
    after = '<constraint><after ref="anticipators:partner:hit"><sync ref="one:start"/></after></constraint>'
    pilot.block("one", after + SPEECH.format(""))
    pilot.realizer.put(BmlText(block("two", SPEECH.format(""), composition="REPLACE")), tick_time(150))
    await skip(pilot, late)
    assert pilot.feedback.time("one:start") == 1.0
    assert (pilot.feedback.time("one:end"), pilot.feedback.status("one")) == (1.5, "INTERRUPTED")


async def test_a_prediction_that_enters_with_a_late_tick_moves_only_points_after_the_skipped_ticks(
    pilot: RealizerPilot,
) -> None:
    pilot.predict("partner", "hit", 1.0)
    pilot.block("one", '<wait id="w" start="0" end="anticipators:partner:hit"/>')
    pilot.realizer.put(Prediction("partner", "hit", tick_time(170)), tick_time(140))
    await skip(pilot, range(91, 150))
    assert pilot.feedback.time("one:w:end") == 1.7


async def test_a_chain_of_blocks_longer_than_the_rounds_of_a_tick_ends_in_one_late_tick(pilot: RealizerPilot) -> None:
    pilot.block("first", '<wait id="w" duration="0.5"/>')
    for number in range(150):
        pilot.block(f"b{number}", '<wait id="w" duration="0.01"/>', composition="APPEND")
    await skip(pilot, range(40, 399))
    assert pilot.feedback.time("b149:end") == pytest.approx(2.0)
    assert pilot.feedback.warnings == []


SESSION = [
    block("a", SPEECH.format("") + RIGHT.format(' start="s:start+0.1" relax="0.7"')),
    block("b", '<pointing id="p" target="bluebox" mode="RIGHT_HAND"/>', **{"bmla:chunkAfter": "a"}),
    block("c", RIGHT.format(' start="1.2"') + '<head id="h" lexeme="NOD" stroke="g:stroke"/>'),
    block("d", SPEECH.format(""), **{"bmla:preplan": "true"}),
    block("e", '<bmla:activate id="i" target="d" start="0.985"/><wait id="w" start="d:s:start" end="d:s:end"/>'),
    block("f", '<bmla:interrupt id="i" target="d" start="1.437" speech="word"/>'),
    block("g", RIGHT.format("") + '<gazeShift id="z" target="bluebox"/>', **{"bmla:appendAfter": "c"}),
    block("h", "<required>" + RIGHT.format(' start="2.3"') + '</required><wait id="w" duration="3"/>'),
    block("i", '<posture id="p"><stance type="SITTING"/></posture>', composition="APPEND"),
]


@cache
def told(late: Iterable[int]) -> tuple[list[tuple[object, ...]], list[tuple[str, str]]]:
    """The feedback of the session, without the ticks that report it."""

    async def play() -> tuple[list[tuple[object, ...]], list[tuple[str, str]]]:
        async with open_pilot(SceneOptions(voice="text")) as pilot:
            for text in SESSION:
                pilot.realizer.put(BmlText(text))
            await skip(pilot, late)
            progress = [line for line in pilot.feedback.messages if line.kind.endswith("Progress")]
            warnings = sorted((line.id, line.text) for line in pilot.feedback.of("warningFeedback"))
            return sorted((line.global_time, line.id, *line.element.attrib.items()) for line in progress), warnings

    return asyncio.run(play())


@settings(max_examples=12)  # the blocks are planned in the first ticks
@given(st.lists(st.tuples(st.integers(5, 380), st.integers(1, 90)), min_size=1, max_size=8))
def test_feedback_does_not_depend_on_which_ticks_are_skipped(gaps: list[tuple[int, int]]) -> None:
    late = {first + n for first, length in gaps for n in range(length)} - {399}
    assert told(frozenset(late)) == told(frozenset())


async def skip(pilot: RealizerPilot, late: Iterable[int]) -> None:
    """Four seconds without some ticks."""
    previous = -1
    for number in (number for number in range(400) if number not in late):
        await pilot.realizer.step(Tick(number, tick_time(previous), frame=False))
        previous = number


async def test_a_point_does_not_move_to_before_the_body_could_have_reached_it(any_strategy: RealizerPilot) -> None:
    """The prediction arrives in a late tick, in which the arm has become ready."""
    any_strategy.predict("t", "hit", 1.0)
    any_strategy.block("b", '<gesture id="g" lexeme="BEAT" start="0" ready="anticipators:t:hit-0.7"/>')
    await any_strategy.advance(0.02)
    any_strategy.predict("t", "hit", 0.85)
    any_strategy.skip(40)
    await any_strategy.advance(4)
    assert any_strategy.feedback.time("b:g:ready") == pytest.approx(0.2489, abs=1e-4)
    assert any_strategy.feedback.warnings == []
