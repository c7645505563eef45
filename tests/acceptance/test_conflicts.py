"""One body, one voice: who plays keeps it; it is judged when the later one starts."""

import pytest

from reactive_realizer.testing.pilot import RealizerPilot

RIGHT = '<gesture id="{}" lexeme="BEAT" mode="RIGHT_HAND" start="{}" end="{}"/>'


async def test_of_two_speeches_the_one_that_speaks_goes_on(pilot: RealizerPilot) -> None:
    pilot.block("one", '<speech id="s"><text>Let me tell you all about it.</text></speech>')
    await pilot.advance(0.5)
    pilot.block("two", '<speech id="s"><text>Wait!</text></speech><head id="h" lexeme="NOD"/>')
    await pilot.advance(5)
    told = pilot.feedback
    assert told.warnings == [("two:s", "IMPOSSIBLE_TO_SCHEDULE")]
    sentence = told.of("warningFeedback")[0].text
    assert "two:s" in sentence
    assert "one:s" in sentence
    assert told.reached("one:s:end")
    assert told.reached("two:h:end")


async def test_an_arm_that_is_free_again_at_the_very_time_is_no_conflict(pilot: RealizerPilot) -> None:
    pilot.block("b", RIGHT.format("one", 0, 1.234) + RIGHT.format("two", 1.234, 3))
    await pilot.advance(4)
    assert pilot.feedback.warnings == []
    assert pilot.feedback.time("b:two:start") == pilot.feedback.time("b:one:end") == 1.234


async def test_an_arm_on_its_way_back_is_free_unless_bml_says_when_it_is_there(pilot: RealizerPilot) -> None:
    for block, back in (("free", ""), ("said", ' end="2"')):
        one = f'<gesture id="one" lexeme="BEAT" mode="RIGHT_HAND" start="0" relax="1"{back}/>'
        pilot.block(block, one + RIGHT.format("two", 1.2, 3))
        await pilot.advance(4)
    assert pilot.feedback.time("free:one:end") == pilot.feedback.time("free:two:start")
    assert pilot.feedback.warnings == [("said:two", "IMPOSSIBLE_TO_SCHEDULE")]
    start = pilot.feedback.time("said:start")
    assert pilot.feedback.time("said:one:end") == pytest.approx(start + 2)


async def test_it_is_judged_when_the_later_one_starts_and_not_when_it_is_planned(pilot: RealizerPilot) -> None:
    pilot.predict("test", "go", 1.0)
    pilot.block("b", RIGHT.format("one", 0, 2) + RIGHT.format("two", "anticipators:test:go", 4))
    await pilot.advance(0.5)
    pilot.predict("test", "go", 2.5)
    await pilot.advance(4)
    assert pilot.feedback.warnings == []
    assert pilot.feedback.time("b:two:start") == 2.5


async def test_different_arms_and_nods_do_not_exclude_each_other(pilot: RealizerPilot) -> None:
    pilot.block("b", RIGHT.format("g", 0, 2) + '<head id="h" lexeme="NOD"/><head id="i" lexeme="SHAKE"/>')
    await pilot.advance(4)
    assert pilot.feedback.warnings == []


@pytest.mark.parametrize("order", [1, -1])
async def test_of_equal_ones_the_choice_is_by_id_whatever_their_order(pilot: RealizerPilot, order: int) -> None:
    pilot.block("b", "".join([RIGHT.format(name, 1, 3) for name in ("x", "y")][::order]))
    await pilot.advance(4)
    assert pilot.feedback.warnings == [("b:y", "IMPOSSIBLE_TO_SCHEDULE")]
    assert pilot.feedback.time("b:x:end") == pilot.feedback.time("b:end") == 3.0


async def test_what_is_dropped_ends_its_block_no_later_than_the_rest(pilot: RealizerPilot) -> None:
    pilot.block("b", RIGHT.format("one", 0, 1) + RIGHT.format("two", 0.5, 9))
    await pilot.advance(2)
    assert pilot.feedback.time("b:end") == 1.0
    assert pilot.feedback.predicted("b:end") == 1.0
