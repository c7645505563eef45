"""Behaviors tied to times before the start of their block are played whole (docs/semantics.md, late ties)."""

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.audio import AudioStart, AudioStop
from reactive_realizer.testing.assertions import assert_ended, assert_linked, assert_not_played, assert_time
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .living_time import BEAT, GO, HIT, WELL, after, moves, nod, synchronize, texts, wait

STOP = "anticipators:user:stop"
LENGTH = 1.34
"""Duration of `WELL` with the text voice, s."""


@pytest.fixture
def pilot(any_strategy: RealizerPilot) -> RealizerPilot:
    return any_strategy


async def stop_before_start(pilot: RealizerPilot, behaviors: str, *, stop: float = 1.1, start: float = 2.0) -> None:
    """Play a block whose user stops while the block before still plays."""
    pilot.block("a", wait("w", start))
    pilot.block("b", behaviors, composition="APPEND")
    await pilot.advance(stop - 0.1)
    pilot.predict("user", "stop", stop)
    await pilot.advance(6)


async def test_a_late_speech_is_spoken_from_its_first_word_without_a_warning(pilot: RealizerPilot) -> None:
    await stop_before_start(pilot, WELL.format(f' start="{STOP}+0.2"'))
    assert_time(pilot.feedback, "b:s:start", 2.0)
    assert_linked(pilot.feedback, "b:s:end", "b:s:start", LENGTH)
    assert pilot.feedback.warnings == []


async def test_a_late_stroke_has_its_preparation_and_one_warning_says_how_late_it_is(pilot: RealizerPilot) -> None:
    pilot.block("before", BEAT.format(""))
    await pilot.advance(4)
    preparation = pilot.feedback.time("before:g:stroke") - pilot.feedback.time("before:g:start")
    pilot.block("a", wait("w", 2))
    pilot.block("b", BEAT.format(f' stroke="{STOP}"'), composition="APPEND")
    pilot.predict("user", "stop", 4.5)
    await pilot.advance(6)
    assert_time(pilot.feedback, "b:g:start", 6.0)
    assert_linked(pilot.feedback, "b:g:stroke", "b:g:start", preparation)
    said = f"g:stroke = {STOP} is {6.0 + preparation - 4.5:.2f} s late, because the block starts at 6.00 s"
    assert texts(pilot) == [f"line 1, column 174: {said}"]


async def test_until_then_other_blocks_depend_on_the_time_at_which_a_late_stroke_can_be(pilot: RealizerPilot) -> None:
    pilot.block("a", wait("w", 2))
    pilot.block("b", BEAT.format(f' stroke="{STOP}"'), composition="APPEND")
    await pilot.advance(0.5)
    pilot.predict("user", "stop", 1.0)
    await pilot.advance(0.1)
    pilot.block("c", nod("n", start="b:g:stroke") + wait("v", 0.5, end="b:g:stroke"))
    await pilot.advance(6)
    assert_time(pilot.feedback, "b:g:start", 2.0)
    assert_linked(pilot.feedback, "c:n:start", "b:g:stroke", 0.0)
    assert_linked(pilot.feedback, "c:v:start", "b:g:stroke", -0.5)
    assert [id_ for id_, _ in pilot.feedback.warnings] == ["b:g"]


async def test_all_behaviors_that_are_tied_to_a_late_time_move_together(pilot: RealizerPilot) -> None:
    ties = WELL.format(f' start="{STOP}+0.2"') + nod("n", stroke=f"{STOP}+0.7") + nod("m", start=f"{STOP}+3")
    await stop_before_start(pilot, ties + wait("v", 0.5, start="m:start+0.1"))
    assert_time(pilot.feedback, "b:s:start", 2.0)
    assert_linked(pilot.feedback, "b:n:stroke", "b:s:start", 0.5)
    assert_linked(pilot.feedback, "b:m:start", "b:s:start", 2.8)
    assert_linked(pilot.feedback, "b:v:start", "b:m:start", 0.1)
    assert [id_ for id_, _ in pilot.feedback.warnings] == ["b:n"]


async def test_a_late_word_takes_the_words_before_it_into_account(pilot: RealizerPilot) -> None:
    behaviors = WELL.format("") + nod("n", end="s:start") + synchronize("s:m", f"{STOP}+1")
    await stop_before_start(pilot, behaviors, stop=1.1)
    assert_time(pilot.feedback, "b:n:start", 2.0)
    assert_linked(pilot.feedback, "b:s:end", "b:s:start", LENGTH)
    assert [id_ for id_, _ in pilot.feedback.warnings] == ["b"]


async def test_a_word_that_is_tied_too_soon_after_the_start_is_late_too(pilot: RealizerPilot) -> None:
    await stop_before_start(pilot, WELL.format("") + synchronize("s:m", f"{STOP}+0.95"))
    assert_time(pilot.feedback, "b:s:start", 2.0)
    assert [id_ for id_, _ in pilot.feedback.warnings] == ["b"]


async def test_a_speech_that_is_tied_too_soon_after_the_start_through_another_behavior_is_late_too(
    pilot: RealizerPilot,
) -> None:
    ties = nod("n", stroke=f"{STOP}+1.4") + synchronize("s:end", "n:stroke")
    await stop_before_start(pilot, WELL.format("") + ties)
    assert_time(pilot.feedback, "b:s:start", 2.0)
    assert_linked(pilot.feedback, "b:s:end", "b:s:start", LENGTH)
    assert_linked(pilot.feedback, "b:n:stroke", "b:s:end", 0.0)
    (text,) = texts(pilot)
    assert text.endswith(f"n:stroke = {STOP}+1.4 is 0.84 s late, because the block starts at 2.00 s")


async def test_a_behavior_between_a_late_and_a_future_time_begins_at_once(pilot: RealizerPilot) -> None:
    pilot.predict("t", "go", 6.0)
    await stop_before_start(pilot, f'<gaze id="look" target="viewer" start="{STOP}" end="{GO}"/>')
    assert_time(pilot.feedback, "b:look:start", 2.0)
    assert_time(pilot.feedback, "b:look:end", 6.0)
    assert pilot.feedback.warnings == []


async def test_a_behavior_tied_to_a_passed_point_of_another_block_is_played_whole(pilot: RealizerPilot) -> None:
    pilot.block("a", wait("w", 9))
    await pilot.advance(2)
    pilot.block("b", nod("n", start="a:w:start", end="a:w:start+1.5") + WELL.format(' start="a:w:start+0.5"'))
    await pilot.advance(4)
    assert_time(pilot.feedback, "b:n:start", 2.0)
    assert_linked(pilot.feedback, "b:n:end", "b:n:start", 1.5)
    assert_time(pilot.feedback, "b:s:start", 2.5)
    assert [id_ for id_, _ in pilot.feedback.warnings] == ["b:n"]


async def test_a_required_late_tie_fails_its_block_unless_it_ties_a_start(pilot: RealizerPilot) -> None:
    pilot.predict("user", "stop", 1.0)
    pilot.block("a", wait("w", 2))
    pilot.block("b", f"<required>{nod('n', end=STOP)}</required>" + nod("m"), composition="APPEND")
    pilot.block("c", f"<required>{nod('n', start=STOP)}</required>", **{"bmla:appendAfter": "a"})
    await pilot.advance(5)
    assert_ended(pilot.feedback, "b", "FAILED")
    assert_not_played(pilot.feedback, "b:m")
    assert_time(pilot.feedback, "c:n:start", 2.0)
    assert_ended(pilot.feedback, "c")


async def test_the_announced_speech_of_a_block_that_fails_at_its_start_is_stopped(pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", 2.0)
    pilot.predict("t", "go", 4.0)
    pilot.block("b", f"<required>{nod('n', end=GO)}</required>{WELL.format('')}", start=HIT)
    await pilot.advance(1)
    (start,) = pilot.sounds
    assert isinstance(start, AudioStart)
    assert start.start == 2.0
    pilot.predict("t", "go", 1.5)
    await pilot.advance(3)
    assert pilot.feedback.status("b") == "FAILED"
    (stop,) = (change for change in pilot.sounds if isinstance(change, AudioStop))
    assert (stop.id, stop.time) == (start.clip.id, 2.0)


async def test_the_start_of_a_block_may_be_later_than_a_time_that_it_is_tied_to(pilot: RealizerPilot) -> None:
    pilot.predict("user", "stop", 1.0)
    pilot.block("a", wait("w", 2))
    pilot.block("b", nod("n") + synchronize("b:start", STOP), composition="APPEND")
    await pilot.advance(4)
    assert_time(pilot.feedback, "b:n:start", 2.0)
    assert pilot.feedback.warnings == []


async def test_a_tie_is_late_only_if_it_is_when_its_block_starts(pilot: RealizerPilot) -> None:
    pilot.predict("user", "stop", 2.5)
    pilot.block("a", wait("w", 4))
    pilot.block("b", nod("n", stroke=STOP), composition="APPEND")
    await pilot.advance(1)
    pilot.block("c", '<bmla:interrupt id="i" target="a"/>')
    await pilot.advance(4)
    assert_time(pilot.feedback, "b:start", 1.0)
    assert_time(pilot.feedback, "b:n:stroke", 2.5)
    assert pilot.feedback.warnings == []


async def test_a_late_prediction_that_comes_back_is_met(pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", 2.4)
    pilot.block("a", wait("w", 2))
    pilot.block("b", nod("n", start="0", stroke=HIT), composition="APPEND")
    await moves(pilot, 0.5, ("hit", 1.9), 1, ("hit", 2.5), 3)
    assert_time(pilot.feedback, "b:n:start", 2.0)
    assert_time(pilot.feedback, "b:n:stroke", 2.5)
    assert pilot.feedback.warnings == []


async def test_a_behavior_before_a_time_that_comes_soon_after_the_start_is_shortened(pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", 5.0)
    pilot.block("a", wait("w", 1))
    pilot.block("b", nod("n", end=HIT), composition="APPEND")
    await moves(pilot, 0.5, ("hit", 1.2), 3)
    assert_time(pilot.feedback, "b:n:start", 1.0)
    assert_time(pilot.feedback, "b:n:end", 1.2)
    assert pilot.feedback.warnings == []


@pytest.mark.parametrize("strategy", ["convex", "embr"])
async def test_a_behavior_after_a_passed_time_starts_with_its_block(strategy: str) -> None:
    async with open_pilot(SceneOptions(voice="text", strategy=strategy, verify=True)) as pilot:
        await stop_before_start(pilot, nod("n") + after(STOP, "n:start"))
        assert_time(pilot.feedback, "b:n:start", 2.0)
        assert pilot.feedback.warnings == []


async def test_dependents_in_other_blocks_follow_a_behavior_that_was_late(pilot: RealizerPilot) -> None:
    pilot.block("a", wait("w", 2))
    pilot.block("b", nod("n", start=STOP), composition="APPEND")
    pilot.block("c", nod("m", start="b:n:start") + nod("k", start="b:n:end"))
    await pilot.advance(1)
    pilot.predict("user", "stop", 1.1)
    await pilot.advance(5)
    assert_time(pilot.feedback, "b:n:start", 2.0)
    assert_time(pilot.feedback, "c:m:start", 2.0)
    assert_linked(pilot.feedback, "c:k:start", "b:n:end")
    assert pilot.feedback.warnings == []


async def test_what_is_tied_ahead_of_a_passed_time_does_not_begin_before_its_block(pilot: RealizerPilot) -> None:
    pilot.block("a", wait("w", 0.2) + wait("v", 3))
    await pilot.advance(0.25)
    pilot.block("b", nod("n", stroke="a:w:end+0.25"))
    await pilot.advance(2)
    assert_time(pilot.feedback, "b:n:start", 0.25)
    assert_time(pilot.feedback, "b:n:stroke", 0.45)
    assert pilot.feedback.warnings == []


async def test_late_behaviors_are_predicted_at_the_times_at_which_they_will_play(pilot: RealizerPilot) -> None:
    pilot.block("a", wait("w", 2))
    behaviors = WELL.format("") + nod("n", start="s:end") + BEAT.format(f' stroke="{STOP}"')
    pilot.block("b", behaviors + synchronize("s:m", STOP), composition="APPEND")
    await pilot.advance(1)
    pilot.predict("user", "stop", 1.1)
    await pilot.advance(0.5)
    predicted = {point: pilot.feedback.predicted(point) for point in ("b:g:start", "b:s:start", "b:n:start")}
    assert min(predicted.values()) == pytest.approx(2.0)
    await pilot.advance(6)
    assert {point: pilot.feedback.time(point) for point in predicted} == pytest.approx(predicted)


async def test_a_waiting_block_starts_without_a_behavior_whose_time_will_never_come(pilot: RealizerPilot) -> None:
    pilot.block("never", nod("n"), **{"bmla:preplan": "true"})
    pilot.block("a", wait("w", 1))
    pilot.block("b", nod("n", start="never:n:start") + nod("m", start="a:w:start"), composition="APPEND")
    await pilot.advance(0.5)
    pilot.block("c", '<bmla:interrupt id="i" target="never"/>')
    await pilot.advance(3)
    assert_not_played(pilot.feedback, "b:n")
    assert_time(pilot.feedback, "b:m:start", 1.0)
    assert [id_ for id_, _ in pilot.feedback.warnings] == ["b:n"]


async def test_what_comes_after_a_time_to_which_a_tie_is_late_starts_with_the_block() -> None:
    async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
        late = BEAT.format(f' stroke="{STOP}"') + nod("n") + after(STOP, "n:start")
        await stop_before_start(pilot, late)
        assert pilot.feedback.time("b:n:start") == pilot.feedback.time("b:g:start") == 2.0
        (warning,) = pilot.feedback.of("warningFeedback")
        assert f"g:stroke = {STOP} is 1.73 s late" in warning.text


@pytest.mark.parametrize("strategy", ["convex", "embr"])
async def test_a_time_that_becomes_known_after_the_start_counts_as_it_is(strategy: str) -> None:
    """For the tie to the time ahead of it, it comes too early; what comes after it begins as early as it may."""
    behaviors = wait("w", 3) + wait("v", 0.1, start=f"{STOP}-1") + nod("n") + after(STOP, "n:start+0.2")
    async with open_pilot(SceneOptions(voice="text", strategy=strategy, verify=True)) as pilot:
        pilot.block("a", wait("w", 0.5))
        pilot.block("b", behaviors + wait("u", 0.1, start=HIT), composition="APPEND")
        await moves(pilot, 0.6, ("hit", 2.0), 0.2)
        pilot.predict("user", "stop", 0.85)
        await pilot.advance(4)
        assert_time(pilot.feedback, "b:n:start", 0.8)
        assert texts(pilot) == [f"line 1, column 201: v:start = {STOP}-1 no longer holds: it is off by 0.95 s"]
