"""Behaviors tied to points that have passed when they are planned or when their block starts (docs/semantics.md)."""

from reactive_realizer.testing.assertions import assert_not_played, assert_time
from reactive_realizer.testing.pilot import RealizerPilot

from .living_time import GO, HIT, moves, nod, wait


async def test_a_behavior_tied_to_a_past_point_joins_late_without_a_warning(pilot: RealizerPilot) -> None:
    pilot.block("a", wait("w", 3))
    await pilot.advance(0.5)
    pilot.block("b", nod("n", start="a:w:start"))
    await pilot.advance(1)
    assert_time(pilot.feedback, "b:n:start", 0.0)
    assert 0.5 < pilot.feedback.time("b:n:end") < 1.0
    assert pilot.feedback.warnings == []


async def test_a_behavior_whose_end_has_passed_is_dropped_with_a_warning(pilot: RealizerPilot) -> None:
    pilot.block("a", wait("w", 3))
    await pilot.advance(2)
    pilot.block("b", nod("n", start="a:w:start"))
    await pilot.advance(1)
    assert_not_played(pilot.feedback, "b:n")
    assert pilot.feedback.warnings == [("b:n", "IMPOSSIBLE_TO_SCHEDULE")]
    assert pilot.feedback.status("b") == "DONE"


async def test_a_behavior_whose_end_passes_while_its_block_waits_is_dropped(pilot: RealizerPilot) -> None:
    pilot.predict("t", "go", 1.5)
    pilot.predict("t", "hit", 2.0)
    pilot.block("a", wait("w", 0.5, start=GO))
    pilot.block("b", nod("n", start=HIT), composition="APPEND")
    await moves(pilot, 0.2, ("go", None), 2.2, ("go", 2.4), 3)
    assert_not_played(pilot.feedback, "b:n")
    assert [line.id for line in pilot.feedback.of("warningFeedback")] == ["b:n"]


async def test_an_early_prediction_does_not_pin_a_waiting_block(
    pilot: RealizerPilot,
) -> None:
    pilot.predict("t", "go", 1.5)
    pilot.predict("t", "hit", 3.0)
    pilot.block("a", wait("w", 0.5, start=GO))
    pilot.block("b", nod("n", end=HIT), composition="APPEND")
    await moves(pilot, 0.5, ("hit", 0.6), 0.05, ("hit", 5.0), 0.1)
    assert pilot.feedback.predicted("b:n:start") > 4.0
    await pilot.advance(6)
    assert_time(pilot.feedback, "b:n:end", 5.0)
    assert pilot.feedback.time("b:n:start") > 4.0
    assert pilot.feedback.warnings == []


async def test_a_behavior_that_would_start_before_its_block_is_shortened(pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", 5.0)
    pilot.block("a", wait("w", 1))
    pilot.block("b", nod("n", end=HIT), composition="APPEND")
    await moves(pilot, 0.5, ("hit", 1.2), 3)
    assert_time(pilot.feedback, "b:n:start", 1.0)
    assert_time(pilot.feedback, "b:n:end", 1.2)
    assert pilot.feedback.warnings == []
