"""Predictions that move times into the past: points that move to now take their dependents with them."""

from typing import Any

import pytest

from reactive_realizer.testing.assertions import assert_linked, assert_time
from reactive_realizer.testing.pilot import RealizerPilot

from .living_time import HIT, moves

SPEECH = '<speech id="{}"{}><text>one two <sync id="k"/>three four</text></speech>'
LONG = 1.08
"""Its duration with the text voice, s."""


@pytest.fixture(params=[1, -1], ids=["in order", "in the other order"])
def turned(request: pytest.FixtureRequest) -> Any:
    return lambda *behaviors: "".join(behaviors[:: request.param])


@pytest.mark.parametrize("known", [4.0, None])
async def test_a_speech_whose_start_moves_into_the_past_starts_now_and_stays_whole(
    pilot: RealizerPilot, turned: Any, known: float | None
) -> None:
    pilot.predict("t", "hit", known)
    speech = SPEECH.format("s", f' end="{HIT}"')
    pilot.block("b", turned(speech, '<head id="h" lexeme="NOD" end="s:start-0.3"/>'))
    await moves(pilot, 1, ("hit", 1.2), 4)
    assert_linked(pilot.feedback, "b:s:end", "b:s:start", LONG)


async def test_a_stroke_stays_with_its_word_when_the_speech_moves_to_now(pilot: RealizerPilot, turned: Any) -> None:
    pilot.predict("t", "hit", 4.0)
    speech = SPEECH.format("s", f' end="{HIT}"')
    pilot.block("b", turned(speech, '<gesture id="g" lexeme="BEAT" stroke="s:k"/>'))
    await moves(pilot, 1, ("hit", 1.2), 4)
    assert_linked(pilot.feedback, "b:g:stroke", "b:s:k")
    assert_linked(pilot.feedback, "b:s:end", "b:s:start", LONG)


async def test_two_consecutive_speeches_are_both_played(pilot: RealizerPilot, turned: Any) -> None:
    pilot.predict("t", "hit", 4.0)
    pilot.block("b", turned(SPEECH.format("a", ' end="c:start"'), SPEECH.format("c", f' end="{HIT}"')))
    await moves(pilot, 1, ("hit", 2.0), 4)
    assert_time(pilot.feedback, "b:a:start", 1.0)
    assert_time(pilot.feedback, "b:c:start", 1.0 + LONG)
    assert_time(pilot.feedback, "b:c:end", 1.0 + 2 * LONG)


async def test_a_block_does_not_end_before_a_behavior_that_a_rigid_one_does_not_wait_for(pilot: RealizerPilot) -> None:
    shift = f'<gazeShift id="g" target="bluebox" start="{HIT}-1"/>'
    pilot.block("b", shift + '<wait id="w" start="g:end" duration="0.01"/>')
    await moves(pilot, 0.5, ("hit", 0.5), 1)
    assert_time(pilot.feedback, "b:w:end", 0.51)
    assert pilot.feedback.time("b:end") == pilot.feedback.time("b:g:end") > 0.51
    assert pilot.feedback.progress[-1] == "b:end"


async def test_an_interruption_at_a_point_that_comes_later_than_it_should_waits_for_it(pilot: RealizerPilot) -> None:
    pilot.block("a", '<wait id="w" duration="5"/>')
    shift = f'<gazeShift id="g" target="bluebox" start="{HIT}-1"/>'
    pilot.block("b", shift + '<bmla:interrupt id="i" target="a" start="g:end"/>')
    await moves(pilot, 0.5, ("hit", 0.5), 1)
    assert pilot.feedback.time("a:end") == pilot.feedback.time("b:i:start") == pilot.feedback.time("b:g:end") > 0.5
