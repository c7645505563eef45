"""Constraints that a late prediction violates: each is reported once, unless its amount is too small to notice."""

import re
from typing import Any

import pytest

from reactive_realizer.testing.assertions import assert_time
from reactive_realizer.testing.pilot import RealizerPilot

from .living_time import GO, HIT, LOST, after, brows, moves, nod, wait

AHEAD = nod("n", start=f"{HIT}-0.5")


def missed(pilot: RealizerPilot) -> dict[tuple[Any, str | Any], float]:
    """The reported violations: (id, constraint) -> s."""
    lines = [(line.id, line.text) for line in pilot.feedback.of("warningFeedback")]
    said = [(id_, re.fullmatch(rf"(?:line .*?: )?(.*?) {LOST}: it is off by (.*) s", text)) for id_, text in lines]
    return {(id_, match[1]): float(match[2]) for id_, match in said if match is not None}


@pytest.mark.parametrize("moved", [2.2, 2.0, 1.2])
async def test_a_behavior_before_a_point_that_moves_to_now_is_late_with_its_dependents(
    pilot: RealizerPilot, moved: float
) -> None:
    pilot.predict("t", "hit", 4.0)
    pilot.block("b", AHEAD + wait("w", 1, start="n:start-0.3"))
    await moves(pilot, 2, ("hit", moved), 4)
    assert_time(pilot.feedback, "b:n:start", 2.0)
    assert_time(pilot.feedback, "b:w:start", 2.0)
    late = 2.0 - (max(moved, 2.0) - 0.5)
    ties = {("b:n", f"n:start = {HIT}-0.5"): late, ("b:w", "w:start = n:start-0.3"): 0.3}
    assert missed(pilot) == pytest.approx(ties)
    assert len(pilot.feedback.warnings) == 2


async def test_a_rigid_behavior_that_ends_late_is_reported(pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", 4.0)
    pilot.block("b", AHEAD + wait("w", 1, end="n:start-0.3"))
    await moves(pilot, 3.2, ("hit", 3.0), 4)
    assert_time(pilot.feedback, "b:w:end", 3.2)
    ties = {("b:n", f"n:start = {HIT}-0.5"): 0.5, ("b:w", "w:end = n:start-0.3"): 0.3}
    assert missed(pilot) == pytest.approx(ties)


async def test_the_last_behavior_of_a_block_that_ends_late_is_reported_before_the_end_of_the_block(
    pilot: RealizerPilot,
) -> None:
    pilot.predict("t", "hit", 4.0)
    pilot.block("b", brows("n", end=f"{HIT}-0.5"))
    await moves(pilot, 3, ("hit", 1.0), 1)
    assert_time(pilot.feedback, "b:end", 3.0)
    assert missed(pilot) == pytest.approx({("b:n", f"n:end = {HIT}-0.5"): 0.5})
    assert pilot.feedback.messages[-1].id == "b:end"


async def test_a_missed_tie_between_blocks_is_reported_for_the_block_that_contains_it(pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", 4.0)
    pilot.block("a", wait("w", 1, start=HIT))
    pilot.block("b", nod("n", start="a:w:start-0.5"))
    await moves(pilot, 2, ("hit", 1.0), 4)
    assert missed(pilot) == pytest.approx({("b:n", "n:start = a:w:start-0.5"): 0.5})


@pytest.mark.parametrize("corrections", [[1.96], [2.6], [1.96, 1.92, 1.87, 1.8], [5.0, 1.7]])
async def test_a_point_ahead_of_a_prediction_keeps_to_the_best_one_that_it_had(
    pilot: RealizerPilot, corrections: list[float]
) -> None:
    pilot.predict("t", "hit", 2.0)
    pilot.block("b", AHEAD)
    await pilot.advance(1.55)
    for correction in corrections:
        await moves(pilot, ("hit", correction), 0.05)
    await pilot.advance(4)
    assert_time(pilot.feedback, "b:n:start", 1.5)
    assert missed(pilot) == {}
    assert pilot.feedback.warnings == []


async def test_a_reached_point_may_be_predicted_again_without_a_warning(pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", 2.0)
    pilot.block("b", AHEAD + wait("w", 9))
    await moves(pilot, 2.5, ("hit", 5.0), 0.5, ("hit", 4.0), 4)
    assert pilot.feedback.warnings == []


async def test_ties_within_a_block_and_after_constraints_are_reported_for_small_violations_too(
    pilot: RealizerPilot,
) -> None:
    pilot.predict("t", "hit", 4.0)
    pilot.predict("t", "go", 2.5)
    pilot.block("b", AHEAD + wait("w", 1, start="n:start-0.05") + wait("v", 1) + after(f"{GO}-0.5", "v:start"))
    await moves(pilot, 2.1, ("hit", 2.2), ("go", 2.55), 4)
    ties = {("b:n", f"n:start = {HIT}-0.5"): 0.4, ("b:w", "w:start = n:start-0.05"): 0.05}
    assert missed(pilot) == pytest.approx(ties | {("b", f"v:start after {GO}-0.5"): 0.05})


async def test_ties_of_future_points_are_reported_for_small_violations_too(pilot: RealizerPilot) -> None:
    pilot.predict("t", "go", 1.5)
    pilot.predict("t", "hit", 1.0)
    pilot.block("b", brows("n", start="0", attackPeak=HIT, end=GO))
    await moves(pilot, 0.5, ("hit", 1.55), 2)
    assert missed(pilot) == pytest.approx({("b:n", f"n:attackPeak = {HIT}"): 0.05})


async def test_a_rigid_behavior_that_cannot_follow_a_new_prediction_is_reported(pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", 2.0)
    pilot.block("b", wait("w", 1, end=f"{HIT}+0.8"))
    await moves(pilot, 2.2, ("hit", 5.0), 4)
    assert_time(pilot.feedback, "b:w:end", 2.8)
    assert missed(pilot) == pytest.approx({("b:w", f"w:end = {HIT}+0.8"): 3.0})


async def test_a_withdrawn_past_prediction_may_be_made_again(pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", 1.0)
    pilot.block("b", wait("w", 4) + nod("n", start=HIT))
    await moves(pilot, 1.5, ("hit", None), 0.5)
    pilot.predict("t", "hit", 3.0)
    await pilot.advance(3)
    assert_time(pilot.feedback, "b:n:start", 1.0)
    assert missed(pilot) == {}
