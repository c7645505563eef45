"""An event counts for a block from its arrival on, or from its activation if it is preplanned (docs/semantics.md)."""

import pytest

from reactive_realizer.testing.assertions import assert_ended, assert_linked, assert_not_played, assert_time
from reactive_realizer.testing.pilot import RealizerPilot

from .living_time import HIT, moves, nod, synchronize, texts, wait

RELEASE = "anticipators:spacebar:release"
SPEECH = f'<speech id="s" start="{RELEASE}"><text>one two three</text></speech>'
LENGTH = 0.78
"""Its duration with the text voice, s."""
PREPLAN = {"bmla:preplan": "true"}


@pytest.fixture
def pilot(any_strategy: RealizerPilot) -> RealizerPilot:
    return any_strategy


async def release(pilot: RealizerPilot, after: float) -> None:
    await pilot.advance(after)
    pilot.event("spacebar", "release")


async def activate(pilot: RealizerPilot, after: float, target: str = "b") -> None:
    await pilot.advance(after)
    pilot.block(f"go-{target}", f'<bmla:activate id="a" target="{target}"/>')


async def test_a_prepared_speech_starts_at_the_release_that_follows_its_activation(pilot: RealizerPilot) -> None:
    pilot.block("b", SPEECH, **PREPLAN)
    await release(pilot, 1.0)
    await activate(pilot, 1.0)
    await release(pilot, 1.2)
    await pilot.advance(2)
    assert_time(pilot.feedback, "b:start", 2.0)
    assert_time(pilot.feedback, "b:s:start", 3.2)
    assert_linked(pilot.feedback, "b:s:end", "b:s:start", LENGTH)
    assert pilot.feedback.warnings == []


async def test_a_block_that_is_planned_after_an_event_waits_for_the_next_one(pilot: RealizerPilot) -> None:
    await release(pilot, 0.5)
    await pilot.advance(0.1)
    pilot.block("b", SPEECH)
    pilot.block("c", SPEECH.replace("release", "press"), **PREPLAN)
    pilot.event("spacebar", "press")
    await activate(pilot, 0.4, "c")
    await pilot.advance(1)
    assert_not_played(pilot.feedback, "b:s")
    assert_not_played(pilot.feedback, "c:s")
    pilot.event("spacebar", "release")
    await pilot.advance(2)
    assert_time(pilot.feedback, "b:s:start", 2.0)


async def test_an_event_in_the_tick_of_the_activation_counts(pilot: RealizerPilot) -> None:
    pilot.block("b", SPEECH, **PREPLAN)
    await release(pilot, 1.0)
    await activate(pilot, 0)
    await pilot.advance(2)
    assert_time(pilot.feedback, "b:s:start", 1.0)


async def test_an_event_between_the_activation_and_the_start_is_kept(pilot: RealizerPilot) -> None:
    pilot.block("a", wait("w", 3))
    pilot.block("b", SPEECH + nod("n", start=f"{RELEASE}+0.5"), **PREPLAN, **{"bmla:appendAfter": "a"})
    await release(pilot, 0.5)
    await activate(pilot, 0.5)
    await release(pilot, 1.0)
    await release(pilot, 0.5)
    await pilot.advance(3)
    assert_time(pilot.feedback, "b:start", 3.0)
    assert_time(pilot.feedback, "b:s:start", 3.0)
    assert_linked(pilot.feedback, "b:s:end", "b:s:start", LENGTH)
    assert_linked(pilot.feedback, "b:n:start", "b:s:start", 0.5)
    assert pilot.feedback.warnings == []


async def test_the_prediction_of_a_waiting_block_follows_its_next_event(pilot: RealizerPilot) -> None:
    pilot.block("b", SPEECH + nod("n", start="s:end"), **PREPLAN)
    await release(pilot, 1.0)
    await activate(pilot, 1.0)
    await pilot.advance(0.5)
    assert pilot.feedback.predictions("b")[-1].element.xpath("count(//*[@id='n'])") == 0
    await release(pilot, 0.5)
    await pilot.tick()
    assert pilot.feedback.predicted("b:n:start") == pytest.approx(3.0 + LENGTH)


async def test_a_block_whose_start_is_an_event_starts_at_the_next_one(pilot: RealizerPilot) -> None:
    pilot.block("b", nod("n") + synchronize("b:start", RELEASE), **PREPLAN)
    await release(pilot, 1.0)
    await activate(pilot, 1.0)
    await pilot.advance(1.0)
    assert not pilot.feedback.reached("b:start")
    await release(pilot, 0.5)
    await pilot.advance(2)
    assert_time(pilot.feedback, "b:start", 3.5)
    assert_time(pilot.feedback, "b:n:start", 3.5)


async def test_a_point_that_a_client_predicted_recurs_too(pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", 1.0)
    await pilot.advance(1.5)
    pilot.block("b", nod("n", start=HIT))
    await pilot.advance(0.5)
    assert not pilot.feedback.reached("b:n:start")
    await moves(pilot, ("hit", 2.5), 2)
    assert_time(pilot.feedback, "b:n:start", 2.5)
    assert pilot.feedback.warnings == []


# --- moments that do not recur

TICK = "anticipators:metronome:tick{}"


async def test_a_behavior_tied_to_a_moment_before_the_arrival_is_dropped_with_the_reason(pilot: RealizerPilot) -> None:
    await pilot.advance(3.5)
    ties = nod("n", stroke=TICK.format(3)) + nod("m", start="n:end") + nod("k", stroke=TICK.format(5))
    pilot.block("b", ties + synchronize("m:end", "k:start"))
    await pilot.advance(4)
    reason = "n:stroke = anticipators:metronome:tick3: that came at 3.00 s, before the block arrived at 3.50 s"
    assert reason in texts(pilot)[0]
    assert "m:start = n:end refers to 'n', which is dropped" in texts(pilot)[1]
    assert "refers to 'm', which is dropped" in texts(pilot)[2]
    assert len(texts(pilot)) == 3
    assert_time(pilot.feedback, "b:k:stroke", 5.0)
    assert_ended(pilot.feedback, "b")


async def test_a_behavior_tied_to_a_moment_before_the_activation_is_dropped_then(pilot: RealizerPilot) -> None:
    pilot.block("b", nod("n", start=TICK.format(1)) + nod("m"), **PREPLAN)
    await activate(pilot, 2.5)
    assert pilot.feedback.warnings == []
    await pilot.advance(2)
    assert [id_ for id_, _ in pilot.feedback.warnings] == ["b:n"]
    assert "that came at 1.00 s, before the block was activated at 2.50 s, and does not come again" in texts(pilot)[0]
    assert_time(pilot.feedback, "b:m:start", 2.5)
    assert_not_played(pilot.feedback, "b:n")


async def test_a_required_behavior_tied_to_a_passed_moment_fails_its_block(pilot: RealizerPilot) -> None:
    pilot.block("b", f"<required>{nod('n', start=TICK.format(1))}</required>" + nod("m"), **PREPLAN)
    await activate(pilot, 2.5)
    await pilot.advance(1)
    assert_ended(pilot.feedback, "b", "FAILED")
    assert_not_played(pilot.feedback, "b:m")


async def test_a_moment_that_passed_may_be_the_base_of_a_time_ahead(pilot: RealizerPilot) -> None:
    await pilot.advance(1.5)
    pilot.block("b", nod("n", start=f"{TICK.format(0)}+2"))
    await pilot.advance(2)
    assert_time(pilot.feedback, "b:n:start", 2.0)
    assert pilot.feedback.warnings == []


async def test_a_moment_that_comes_again_before_the_activation_is_met(pilot: RealizerPilot) -> None:
    pilot.block("b", nod("n", start=TICK.format(1)), **PREPLAN)
    await pilot.advance(2.5)
    pilot.event("metronome", "start")
    await activate(pilot, 0.2)
    await pilot.advance(2)
    assert_time(pilot.feedback, "b:n:start", 3.5)
    assert pilot.feedback.warnings == []
