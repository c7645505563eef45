"""Future points follow the times that they are tied to, also in a block that partly has passed (docs/semantics.md)."""

from itertools import permutations
from typing import Any

import pytest

from reactive_realizer.testing.assertions import assert_linked, assert_time
from reactive_realizer.testing.pilot import RealizerPilot

from .living_time import BEAT, HIT, moves, nod, synchronize, texts

CLAP = BEAT.format(' stroke="{0}"')
WORDS = '<speech id="s"{}><text>one two <sync id="k"/>three four</text></speech>'


async def test_a_stroke_follows_its_beat_after_the_gesture_has_started(pilot: RealizerPilot) -> None:
    pilot.block("b", CLAP.format("anticipators:metronome:tick2") + nod("n", start="g:stroke-0.5"))
    await pilot.advance(1.6)
    assert_time(pilot.feedback, "b:n:start", 1.5)
    pilot.event("metronome", "tempo", 40)  # the second tick comes at 2.5 s instead of 2
    await pilot.advance(6)
    assert_time(pilot.feedback, "b:g:stroke", 2.5)


async def test_a_moved_time_moves_all_future_points_and_its_ties_to_past_points_are_dropped(
    pilot: RealizerPilot,
) -> None:
    await moves(pilot, ("hit", 4.0))
    pilot.block("b", CLAP.format(HIT) + nod("n", end="g:stroke-1"))
    await moves(pilot, 3.1, ("hit", 5.0), 6)
    assert_time(pilot.feedback, "b:n:end", 3.0)
    assert_time(pilot.feedback, "b:g:stroke", 5.0)
    (text,) = texts(pilot)
    assert "n:end = g:stroke-1 no longer holds" in text


async def test_a_moved_point_of_another_block_moves_all_future_points_too(pilot: RealizerPilot) -> None:
    await moves(pilot, ("hit", 4.0))
    pilot.block("a", WORDS.format(f' start="{HIT}"'))
    pilot.block("b", CLAP.format("a:s:k") + nod("n", end="g:stroke-1"))
    await moves(pilot, 3.6, ("hit", 5.0), 6)
    assert_linked(pilot.feedback, "b:g:stroke", "a:s:k")
    assert_time(pilot.feedback, "a:s:start", 5.0)


async def test_a_speech_is_not_dropped_when_a_behavior_tied_to_it_has_passed(pilot: RealizerPilot) -> None:
    await moves(pilot, ("hit", 6.0))
    pilot.block("b", WORDS.format(f' end="{HIT}"') + nod("n", end="s:start-0.1"))
    await moves(pilot, 4.87, ("hit", 7.0), 8)
    assert_time(pilot.feedback, "b:s:end", 7.0)
    assert_linked(pilot.feedback, "b:s:end", "b:s:start", 1.08)


@pytest.mark.parametrize("refs", list(permutations([HIT, "g:stroke", "n:end+1"])))
async def test_the_order_of_ties_does_not_matter(pilot: RealizerPilot, refs: Any) -> None:
    await moves(pilot, ("hit", 4.0))
    pilot.block("b", BEAT.format("") + nod("n") + synchronize(*refs))
    await moves(pilot, 3.1, ("hit", 5.0), 6)
    assert_time(pilot.feedback, "b:g:stroke", 5.0)


async def test_a_behavior_tied_to_a_word_stays_with_it_when_the_speech_cannot_follow(pilot: RealizerPilot) -> None:
    await moves(pilot, ("hit", 4.0))
    pilot.block("b", WORDS.format(f' end="{HIT}"') + nod("n", start="s:k"))
    await moves(pilot, 3.1, ("hit", 5.0), 6)
    assert_linked(pilot.feedback, "b:n:start", "b:s:k")
    assert_linked(pilot.feedback, "b:s:end", "b:s:start", 1.08)
    (text,) = texts(pilot)
    assert "s:end" in text


async def test_a_behavior_tied_to_an_interrupted_point_keeps_its_last_time(pilot: RealizerPilot) -> None:
    await moves(pilot, ("hit", 4.0))
    pilot.block("b", CLAP.format(HIT) + nod("n", start="g:stroke-1"))
    pilot.block("i", '<bmla:interrupt id="i" target="b" include="g" start="0"/>')
    await moves(pilot, 1.5, ("hit", 5.0), 6)
    assert_time(pilot.feedback, "b:n:start", 3.0)


async def test_the_end_of_a_playing_behavior_follows_the_outer_time_of_its_start(pilot: RealizerPilot) -> None:
    await moves(pilot, ("hit", 1.0))
    pilot.block("b", BEAT.format(f' start="{HIT}-0.5"'))
    await pilot.advance(0.1)
    planned = pilot.realizer.scheduler.blocks.alive[0].units[0].time("end")
    assert planned is not None
    await moves(pilot, 0.7, ("hit", 1.5), 6)
    assert_time(pilot.feedback, "b:g:start", 0.5)
    assert_time(pilot.feedback, "b:g:end", planned + 0.5)
    assert pilot.feedback.warnings == []
