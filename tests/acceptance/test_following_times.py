"""What is ahead follows the times that it was tied to, whatever of its block has passed (docs/semantics.md)."""

from itertools import permutations
from typing import Any

import pytest

from reactive_realizer.testing.assertions import assert_linked, assert_time
from reactive_realizer.testing.pilot import RealizerPilot

from .living_time import BEAT, HIT, moves, nod, synchronize, texts

CLAP = BEAT.format(' stroke="{0}"')
WORDS = '<speech id="s"{}><text>one two <sync id="k"/>three four</text></speech>'


async def test_a_beat_is_met_though_what_comes_before_it_has_begun(pilot: RealizerPilot) -> None:
    pilot.block("b", CLAP.format("anticipators:metronome:tick2") + nod("n", start="g:stroke-0.5"))
    await pilot.advance(1.6)
    assert_time(pilot.feedback, "b:n:start", 1.5)
    pilot.event("metronome", "tempo", 40)  # the second tick comes at 2.5 s instead of 2
    await pilot.advance(6)
    assert_time(pilot.feedback, "b:g:stroke", 2.5)


async def test_a_time_that_moves_moves_all_that_is_ahead_and_the_tie_to_what_has_passed_is_given_up(
    pilot: RealizerPilot,
) -> None:
    await moves(pilot, ("hit", 4.0))
    pilot.block("b", CLAP.format(HIT) + nod("n", end="g:stroke-1"))
    await moves(pilot, 3.1, ("hit", 5.0), 6)
    assert_time(pilot.feedback, "b:n:end", 3.0)
    assert_time(pilot.feedback, "b:g:stroke", 5.0)
    (text,) = texts(pilot)
    assert "n:end = g:stroke-1 no longer holds" in text


async def test_so_does_a_point_of_another_block(pilot: RealizerPilot) -> None:
    await moves(pilot, ("hit", 4.0))
    pilot.block("a", WORDS.format(f' start="{HIT}"'))
    pilot.block("b", CLAP.format("a:s:k") + nod("n", end="g:stroke-1"))
    await moves(pilot, 3.6, ("hit", 5.0), 6)
    assert_linked(pilot.feedback, "b:g:stroke", "a:s:k")
    assert_time(pilot.feedback, "a:s:start", 5.0)


async def test_a_speech_is_not_lost_because_what_hangs_on_it_has_passed(pilot: RealizerPilot) -> None:
    await moves(pilot, ("hit", 6.0))
    pilot.block("b", WORDS.format(f' end="{HIT}"') + nod("n", end="s:start-0.1"))
    await moves(pilot, 4.87, ("hit", 7.0), 8)
    assert_time(pilot.feedback, "b:s:end", 7.0)
    assert_linked(pilot.feedback, "b:s:end", "b:s:start", 1.08)


@pytest.mark.parametrize("refs", list(permutations([HIT, "g:stroke", "n:end+1"])))
async def test_the_order_in_which_points_are_brought_together_does_not_matter(pilot: RealizerPilot, refs: Any) -> None:
    await moves(pilot, ("hit", 4.0))
    pilot.block("b", BEAT.format("") + nod("n") + synchronize(*refs))
    await moves(pilot, 3.1, ("hit", 5.0), 6)
    assert_time(pilot.feedback, "b:g:stroke", 5.0)


async def test_what_is_tied_to_a_word_stays_with_the_word_when_its_speech_cannot_follow(pilot: RealizerPilot) -> None:
    await moves(pilot, ("hit", 4.0))
    pilot.block("b", WORDS.format(f' end="{HIT}"') + nod("n", start="s:k"))
    await moves(pilot, 3.1, ("hit", 5.0), 6)
    assert_linked(pilot.feedback, "b:n:start", "b:s:k")
    assert_linked(pilot.feedback, "b:s:end", "b:s:start", 1.08)
    (text,) = texts(pilot)
    assert "s:end" in text


async def test_what_was_tied_to_a_point_that_is_cut_keeps_its_last_time(pilot: RealizerPilot) -> None:
    await moves(pilot, ("hit", 4.0))
    pilot.block("b", CLAP.format(HIT) + nod("n", start="g:stroke-1"))
    pilot.block("i", '<bmla:interrupt id="i" target="b" include="g" start="0"/>')
    await moves(pilot, 1.5, ("hit", 5.0), 6)
    assert_time(pilot.feedback, "b:n:start", 3.0)


async def test_the_end_of_what_has_begun_follows_the_time_that_its_start_was_tied_to(pilot: RealizerPilot) -> None:
    await moves(pilot, ("hit", 1.0))
    pilot.block("b", BEAT.format(f' start="{HIT}-0.5"'))
    await pilot.advance(0.1)
    planned = pilot.realizer.scheduler.blocks.alive[0].units[0].time("end")
    assert planned is not None
    await moves(pilot, 0.7, ("hit", 1.5), 6)
    assert_time(pilot.feedback, "b:g:start", 0.5)
    assert_time(pilot.feedback, "b:g:end", planned + 0.5)
    (text,) = texts(pilot)
    assert "g:start = anticipators:t:hit-0.5 no longer holds" in text
