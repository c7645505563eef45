"""Chunks of speech and gesture that follow each other without a rest between (thesis 12.1)."""

import numpy as np
import pytest

from reactive_realizer.testing.pilot import RealizerPilot

BMLA = {"xmlns:bmla": "http://www.asap-project.org/bmla"}
CHUNK = (
    '<speech id="s"><text>this <sync id="m"/>word</text></speech>'
    '<gesture id="g" lexeme="BEAT" mode="{mode}" stroke="s:m"/>'
)


def chunk(pilot: RealizerPilot, id_: str, mode: str = "RIGHT_HAND", **attributes: str) -> None:
    inside = CHUNK.format(mode=mode)
    named = {"bmla:" + name: value for name, value in attributes.items()}
    pairs = " ".join(f'{name}="{value}"' for name, value in (BMLA | named).items())
    pilot.perform(f'<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" id="{id_}" {pairs}>{inside}</bml>')


async def test_the_next_chunk_starts_its_preparation_from_the_current_hand(pilot: RealizerPilot) -> None:
    chunk(pilot, "one")
    chunk(pilot, "two", chunkAfter="one")
    await pilot.tick()
    planned = pilot.feedback.predicted("two:g:stroke") - pilot.feedback.predicted("two:g:start")
    await pilot.advance(6)
    told = pilot.feedback
    assert told.time("two:start") == told.time("one:g:relax")
    assert told.time("two:g:stroke") - told.time("two:g:start") < planned - 0.1


async def test_stroke_and_word_stay_together_when_a_chunk_is_planned_again(pilot: RealizerPilot) -> None:
    chunk(pilot, "one")
    chunk(pilot, "two", chunkAfter="one")
    await pilot.advance(6)
    assert pilot.feedback.time("two:g:stroke") == pilot.feedback.time("two:s:m")
    assert pilot.feedback.warnings == []


async def test_a_gesture_ends_when_the_next_chunk_takes_its_arm_and_both_points_are_reported(
    pilot: RealizerPilot,
) -> None:
    chunk(pilot, "one")
    chunk(pilot, "two", chunkAfter="one")
    await pilot.advance(6)
    told = pilot.feedback
    assert told.time("one:g:end") == told.time("one:g:relax") == pytest.approx(told.time("two:g:start"))
    assert told.status("one") == "DONE"


async def test_chunks_may_be_tied_at_the_last_and_the_first_word(pilot: RealizerPilot) -> None:
    first = (
        '<speech id="s" start="2"><text>that was one<sync id="last"/></text></speech>'
        '<gesture id="g" lexeme="BEAT" mode="LEFT_HAND" stroke="s:last"/>'
    )
    second = (
        '<speech id="s"><text><sync id="first"/>and two</text></speech>'
        '<gesture id="g" stroke="s:first" mode="RIGHT_HAND" lexeme="BEAT"/>'
    )
    pilot.block("one", first)
    pilot.block("two", second, **{"bmla:chunkAfter": "one"})
    await pilot.advance(8)
    told = pilot.feedback
    assert told.warnings == []
    assert told.time("one:s:start") == 2.0
    assert told.time("one:g:stroke") == told.time("one:s:last") == told.time("one:s:end")
    assert told.time("two:g:stroke") == told.time("two:s:first") == told.time("two:s:start") > told.time("one:s:end")


async def test_an_arm_that_the_next_chunk_does_not_use_retracts_completely(pilot: RealizerPilot) -> None:
    chunk(pilot, "one", mode="LEFT_HAND")
    chunk(pilot, "two", mode="RIGHT_HAND", chunkAfter="one")
    await pilot.advance(6)
    assert pilot.feedback.time("one:g:end") > pilot.feedback.time("one:g:relax") + 0.1


async def test_the_hand_does_not_jump_from_chunk_to_chunk(pilot: RealizerPilot) -> None:
    pilot.watch()
    chunk(pilot, "one")
    chunk(pilot, "two", chunkAfter="one")
    await pilot.advance(6)
    steps = np.linalg.norm(np.diff(pilot.path("r_wrist"), axis=0), axis=1)
    assert len(steps) > 100
    assert 0.01 < steps.max() < 0.05


async def test_dependents_of_a_chunk_follow_when_it_is_planned_again(pilot: RealizerPilot) -> None:
    chunk(pilot, "one")
    chunk(pilot, "two", chunkAfter="one")
    pilot.block("other", '<head id="n" lexeme="NOD" stroke="two:s:m"/>')
    await pilot.advance(6)
    assert pilot.feedback.time("other:n:stroke") == pilot.feedback.time("two:s:m")


async def test_an_appended_block_waits_for_a_chunk_and_its_predecessors(pilot: RealizerPilot) -> None:
    chunk(pilot, "one")
    pilot.block("two", '<wait id="w" duration="0.1"/>', **{"bmla:chunkAfter": "one"})
    pilot.block("next", composition="APPEND")
    await pilot.advance(6)
    assert pilot.feedback.time("two:end") < pilot.feedback.time("one:end") == pilot.feedback.time("next:start")


async def test_a_chunk_starts_when_the_last_behavior_before_it_is_dropped(pilot: RealizerPilot) -> None:
    pilot.block(
        "a",
        '<gesture id="g" lexeme="BEAT" mode="RIGHT_HAND" start="0" relax="1" end="3"/>'
        '<gesture id="h" lexeme="BEAT" mode="RIGHT_HAND" start="1.5"/>',
    )
    pilot.block("b", '<head id="n" lexeme="NOD"/>', **{"bmla:chunkAfter": "a"})
    await pilot.advance(2)
    assert pilot.feedback.warnings == [("a:h", "IMPOSSIBLE_TO_SCHEDULE")]
    assert pilot.feedback.time("a:relax") == pilot.feedback.time("b:n:start") == 1.5
    assert not pilot.feedback.reached("b:n:end")
