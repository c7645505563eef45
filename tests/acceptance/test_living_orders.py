"""Before/after constraints with one side on an outer time hold, or a violation is reported once (docs/time.md)."""

from typing import Any

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.assertions import assert_linked, assert_time
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .living_time import BEAT, GO, HIT, LOST, after, before, moves, nod, texts, wait


@pytest.mark.parametrize("moved", [0.6, 1.0, 2.5])
async def test_an_after_constraint_follows_its_outer_time_in_both_directions(
    pilot: RealizerPilot, moved: float
) -> None:
    pilot.predict("t", "hit", 1.5)
    pilot.block("b", wait("w", 1) + after(HIT, "w:start"))
    await moves(pilot, 0.4, ("hit", 3.0), 0.1, ("hit", moved), 5)
    assert_time(pilot.feedback, "b:w:start", moved)
    assert pilot.feedback.warnings == []


async def test_a_point_that_may_be_earlier_than_now_happens_now(pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", 3.0)
    pilot.block("b", wait("w", 1) + after(f"{HIT}-1", "w:start"))
    await moves(pilot, 1, ("hit", 1.2), 3)
    assert_time(pilot.feedback, "b:w:start", 1.0)
    assert pilot.feedback.warnings == []


@pytest.mark.parametrize("strategy", ["convex", "embr"])
async def test_a_behavior_after_an_unknown_time_comes_with_it_even_if_that_is_earlier_than_constrained(
    strategy: str,
) -> None:
    async with open_pilot(SceneOptions(voice="text", strategy=strategy, verify=True)) as pilot:
        pilot.block("b", wait("w", 3, start="0.4") + nod("n") + before(HIT, "w:start") + after(HIT, "n:start"))
        await moves(pilot, 0.3, ("hit", 0.3), 3)
        assert_time(pilot.feedback, "b:n:start", 0.3)
        (said,) = texts(pilot)
        assert f"w:start before {HIT} {LOST}: it is off by 0.10 s" in said


async def test_an_after_constraint_that_moves_past_a_reached_point_is_reported_once(
    pilot: RealizerPilot,
) -> None:
    pilot.predict("t", "hit", 1.0)
    pilot.block("b", wait("w", 1) + after(f"{HIT}-0.5", "w:start"))
    await moves(pilot, 0.7, ("hit", 2.0), 0.1, ("hit", 2.5), 3)
    assert_time(pilot.feedback, "b:w:start", 0.5)
    (said,) = texts(pilot)
    assert f"w:start after {HIT}-0.5 {LOST}: it is off by 1.00 s" in said


async def test_an_after_constraint_delays_a_point_of_a_playing_gesture(pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", 1.0)
    pilot.block("b", BEAT.format("") + after(HIT, "g:stroke"))
    await moves(pilot, 0.5, ("hit", 3.0), 4)
    assert_time(pilot.feedback, "b:g:stroke", 3.0)
    assert pilot.feedback.time("b:g:start") < 0.5
    (limit,) = texts(pilot)
    assert "g from strokeStart to stroke is to last at most 0.74 s, lasts 1.01 s" in limit


async def test_a_before_constraint_moves_a_point_of_a_playing_behavior_in_both_directions(pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", 3.0)
    pilot.block("b", nod("n") + before(HIT, "n:end"))
    await moves(pilot, 0.2, ("hit", 0.5), 0.1)
    assert pilot.feedback.predicted("b:n:end") == pytest.approx(0.5)
    await moves(pilot, ("hit", 0.6), 2)
    assert_time(pilot.feedback, "b:n:end", 0.6)
    assert pilot.feedback.warnings == []


@pytest.mark.parametrize("first", [wait("w", 2), wait("w", 2, start=GO), nod("w", start="0", end="2")])
async def test_only_a_before_constraint_on_a_fixed_point_is_lost(pilot: RealizerPilot, first: Any) -> None:
    pilot.predict("t", "go", 0.2)
    pilot.predict("t", "hit", 3.0)
    pilot.block("b", first + before(HIT, "w:end"))
    await moves(pilot, 0.3, ("hit", 1.0), 0.1, ("hit", 0.9), 3)
    (said,) = texts(pilot)
    assert f"w:end before {HIT} {LOST}" in said
    assert pilot.feedback.time("b:w:end") in (2.0, 2.2)


@pytest.mark.parametrize("start", ["1", "anticipators:t:go"])
@pytest.mark.parametrize("moved", [0.6, -1.0])
async def test_only_a_before_constraint_that_moves_before_a_fixed_earlier_point_is_lost(
    pilot: RealizerPilot, start: str, moved: float
) -> None:
    pilot.predict("t", "go", 1.0)
    pilot.predict("t", "hit", 3.0)
    pilot.block("b", nod("n", start=start) + nod("like", start="1") + before(HIT, "n:end"))
    await moves(pilot, 0.5, ("hit", moved), 0.1, ("hit", moved + 0.01), 3)
    for sync in ("start", "stroke", "end"):
        assert_linked(pilot.feedback, f"b:n:{sync}", f"b:like:{sync}")
    (said,) = texts(pilot)
    assert f"n:end before {HIT} {LOST}" in said


async def test_a_before_constraint_holds_again_when_its_bound_returns(pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", 3.0)
    pilot.block("b", nod("n", start="1") + before(HIT, "n:end"))
    await moves(pilot, 0.5, ("hit", 0.6), 0.1, ("hit", 1.2), 3)
    assert_time(pilot.feedback, "b:n:start", 1.0)
    assert_time(pilot.feedback, "b:n:end", 1.2)


@pytest.mark.parametrize("strategy", ["convex", "embr"])
@pytest.mark.parametrize("end", ["2", GO])
@pytest.mark.parametrize("moved", [2.0, 2.5])
async def test_only_an_after_constraint_that_moves_past_a_fixed_later_point_is_lost(
    strategy: str, end: str, moved: float
) -> None:
    async with open_pilot(SceneOptions(voice="text", verify=True, strategy=strategy)) as pilot:
        pilot.predict("t", "go", 2.0)
        pilot.predict("t", "hit", 1.0)
        pilot.block("b", nod("n", end=end) + nod("like", end="2") + after(HIT, "n:start"))
        await moves(pilot, 0.5, ("hit", moved), 0.1, ("hit", moved + 0.01), 3)
        for sync in ("start", "stroke", "end"):
            assert_linked(pilot.feedback, f"b:n:{sync}", f"b:like:{sync}")
        (said,) = texts(pilot)
        assert f"n:start after {HIT} {LOST}" in said


async def test_an_after_constraint_holds_again_when_its_bound_returns(pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", 1.0)
    pilot.block("b", nod("n", end="2") + after(HIT, "n:start"))
    await moves(pilot, 0.5, ("hit", 2.4), 0.1, ("hit", 1.6), 3)
    assert_time(pilot.feedback, "b:n:start", 1.6)
    assert_time(pilot.feedback, "b:n:end", 2.0)


@pytest.mark.parametrize("strategy", ["convex", "embr"])
async def test_an_after_constraint_is_dropped_before_the_tie_of_a_later_point(strategy: str) -> None:
    async with open_pilot(SceneOptions(voice="text", verify=True, strategy=strategy)) as pilot:
        pilot.predict("t", "go", 1.5)
        pilot.predict("t", "hit", 0.5)
        pilot.block("b", BEAT.format(f' stroke="{GO}"') + after(HIT, "g:start"))
        await moves(pilot, 0.2, ("hit", 1.6), 3)
        assert_time(pilot.feedback, "b:g:stroke", 1.5)
        assert [f"g:start after {HIT} {LOST}" in said for said in texts(pilot)] == [True]


async def test_a_before_constraint_is_dropped_before_the_tie_of_an_earlier_point(pilot: RealizerPilot) -> None:
    pilot.predict("t", "go", 1.0)
    pilot.predict("t", "hit", 3.0)
    pilot.block("b", BEAT.format(f' stroke="{GO}"') + before(HIT, "g:end"))
    await moves(pilot, 0.5, ("hit", 0.9), 3)
    assert_time(pilot.feedback, "b:g:stroke", 1.0)
    assert [f"g:end before {HIT} {LOST}" in said for said in texts(pilot)] == [True]


async def test_after_constraints_and_ties_on_an_unknown_time_wait_and_before_constraints_do_not(
    pilot: RealizerPilot,
) -> None:
    tied = nod("n", stroke=HIT) + nod("m", start="n:end")
    pilot.block("b", wait("w", 1) + after(HIT, "w:start") + wait("v", 1) + before(HIT, "v:end") + tied)
    await pilot.advance(2)
    assert pilot.feedback.progress == ["b:start", "b:v:start", "b:v:end"]
    await moves(pilot, ("hit", 3.0), 0.8, ("hit", None), 1)
    assert len(pilot.feedback.progress) == 6  # n had begun; its stroke, and all the rest, wait again
    await moves(pilot, ("hit", 4.0), 4)
    assert_time(pilot.feedback, "b:n:stroke", 4.0)
    assert_time(pilot.feedback, "b:w:start", 4.0)
    assert_linked(pilot.feedback, "b:m:start", "b:n:end")
    assert [said for said in texts(pilot) if "v:end" not in said] == []
