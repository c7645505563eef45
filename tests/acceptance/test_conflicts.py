"""Conflicts over resources: the playing behavior keeps a resource, and a later one is dropped at its start."""

import pytest

from reactive_realizer.testing.pilot import RealizerPilot

RIGHT = '<gesture id="{}" lexeme="BEAT" mode="RIGHT_HAND" start="{}" end="{}"/>'


async def test_of_two_overlapping_speeches_the_playing_one_continues(pilot: RealizerPilot) -> None:
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


async def test_an_arm_that_is_released_at_the_start_of_a_gesture_is_free(pilot: RealizerPilot) -> None:
    pilot.block("b", RIGHT.format("one", 0, 1.234) + RIGHT.format("two", 1.234, 3))
    await pilot.advance(4)
    assert pilot.feedback.warnings == []
    assert pilot.feedback.time("b:two:start") == pilot.feedback.time("b:one:end") == 1.234


async def test_a_retracting_arm_is_free_unless_its_end_is_constrained(pilot: RealizerPilot) -> None:
    for block, back in (("free", ""), ("said", ' end="2"')):
        one = f'<gesture id="one" lexeme="BEAT" mode="RIGHT_HAND" start="0" relax="1"{back}/>'
        pilot.block(block, one + RIGHT.format("two", 1.2, 3))
        await pilot.advance(4)
    assert pilot.feedback.time("free:one:end") == pilot.feedback.time("free:two:start")
    assert pilot.feedback.warnings == [("said:two", "IMPOSSIBLE_TO_SCHEDULE")]
    start = pilot.feedback.time("said:start")
    assert pilot.feedback.time("said:one:end") == pytest.approx(start + 2)


async def test_conflicts_are_resolved_when_the_later_behavior_starts(pilot: RealizerPilot) -> None:
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
async def test_of_simultaneous_behaviors_the_first_by_id_plays(pilot: RealizerPilot, order: int) -> None:
    pilot.block("b", "".join([RIGHT.format(name, 1, 3) for name in ("x", "y")][::order]))
    await pilot.advance(4)
    assert pilot.feedback.warnings == [("b:y", "IMPOSSIBLE_TO_SCHEDULE")]
    assert pilot.feedback.time("b:x:end") == pilot.feedback.time("b:end") == 3.0


async def test_a_block_with_a_dropped_behavior_ends_with_its_other_behaviors(pilot: RealizerPilot) -> None:
    pilot.block("b", RIGHT.format("one", 0, 1) + RIGHT.format("two", 0.5, 9))
    await pilot.advance(2)
    assert pilot.feedback.time("b:end") == 1.0
    assert pilot.feedback.predicted("b:end") == 1.0
