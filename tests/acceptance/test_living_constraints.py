"""Constraints hold while times move, or a violation is reported once (docs/time.md)."""

from pathlib import Path

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.assertions import assert_linked, assert_not_played, assert_order, assert_time
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .living_time import BEAT, GO, HIT, LOST, WELL, after, before, brows, moves, nod, texts, wait

# --- chains, clusters, blocks


async def test_a_chain_of_after_constraints_moves_in_both_directions(pilot: RealizerPilot) -> None:
    chain = after(HIT, "w1:start") + after("w1:end", "w2:start") + after("w2:end+0.2", "n:start")
    pilot.predict("t", "hit", 1.0)
    pilot.block("b", wait("w1", 0.5) + wait("w2", 0.5) + nod("n") + chain)
    await moves(pilot, 0.2, ("hit", 3.0), 0.2, ("hit", 0.5), 3)
    for point, time in {"w1:start": 0.5, "w2:start": 1.0, "n:start": 1.7}.items():
        assert_time(pilot.feedback, f"b:{point}", time)
    assert pilot.feedback.warnings == []


@pytest.mark.parametrize("moved", [0.5, 4.0])
async def test_a_cluster_starts_as_early_as_possible_after_a_move(pilot: RealizerPilot, moved: float) -> None:
    pilot.predict("t", "hit", 2.0)
    pilot.block("b", WELL.format("") + nod("n", stroke="s:m") + wait("w", 0.2) + after(HIT, "s:m", "w:start"))
    await moves(pilot, 0.2, ("hit", moved), 8)
    assert_linked(pilot.feedback, "b:n:stroke", "b:s:m")
    assert_time(pilot.feedback, "b:s:m", max(moved, 0.55), tolerance=0.06)
    assert_time(pilot.feedback, "b:w:start", moved)
    assert pilot.feedback.warnings == []  # verify would say that 7.24 does not hold


async def test_constraints_across_blocks_and_characters_hold_while_times_move(tests_data: Path) -> None:
    two = SceneOptions(human=tests_data / "humans" / "two.toml", voice="text", verify=True)
    async with open_pilot(two) as pilot:
        pilot.predict("t", "hit", 1.0)
        pilot.block("a", wait("w", 0.5, start=HIT), characterId="alice")
        more = wait("v", 0.5) + after("a:w:end", "v:start")
        pilot.block("b", nod("n", start="a:w:end+0.1") + more, characterId="bob")
        pilot.block("c", nod("n", start="0.5") + before("a:w:start", "n:end"), characterId="alice")
        await moves(pilot, 0.2, ("hit", 3.0), 0.2, ("hit", 0.9), 4)
        assert_linked(pilot.feedback, "b:n:start", "a:w:end", 0.1)
        assert_linked(pilot.feedback, "b:v:start", "a:w:end")
        assert_linked(pilot.feedback, "c:n:end", "a:w:start")
        assert pilot.feedback.warnings == []


async def test_a_before_constraint_cannot_move_a_behavior_before_the_start_of_its_block(
    pilot: RealizerPilot,
) -> None:
    pilot.block("a", wait("w", 2))
    pilot.block("b", wait("w", 0.5) + before(HIT, "w:end"), composition="APPEND")
    await moves(pilot, 0.2, ("hit", 1.0), 4)
    assert_time(pilot.feedback, "b:w:start", 2.0)
    assert [f"w:end before {HIT} {LOST}: it is off by 1.50 s" in said for said in texts(pilot)] == [True]


async def test_dependents_of_a_chunk_follow_when_it_is_planned_again(pilot: RealizerPilot) -> None:
    pilot.block("a", BEAT.format(' mode="RIGHT_HAND"'))
    chunk = WELL.format("") + BEAT.format(' mode="RIGHT_HAND" stroke="s:m"')
    pilot.block("b", chunk, **{"bmla:chunkAfter": "a"})
    pilot.block("c", nod("n", start="b:s:m") + wait("w", 0.1) + after("b:g:stroke", "w:start"))
    await pilot.advance(6)
    assert_linked(pilot.feedback, "c:n:start", "b:s:m")
    assert_linked(pilot.feedback, "c:w:start", "b:g:stroke")
    assert pilot.feedback.warnings == []


# --- at


async def test_a_reached_point_keeps_its_time_and_later_points_follow(pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", 1.0)
    pilot.block("b", nod("n", start=f"{HIT}-0.5", end=f"{HIT}+1"))
    await moves(pilot, 0.7, ("hit", 1.4), 3)
    assert_time(pilot.feedback, "b:n:start", 0.5)
    assert_time(pilot.feedback, "b:n:end", 2.4)
    assert pilot.feedback.warnings == []


async def test_a_prediction_of_the_next_occurrence_violates_no_constraint_of_a_reached_point(
    pilot: RealizerPilot,
) -> None:
    pilot.predict("t", "hit", 0.5)
    pilot.block("b", nod("n", start=HIT) + wait("w", 5))
    await moves(pilot, 0.7, ("hit", 1.4), 0.2, ("hit", None), 0.2, ("hit", 3.0), 5)
    assert_time(pilot.feedback, "b:n:start", 0.5)
    assert pilot.feedback.warnings == []


async def test_phases_between_two_ties_stretch_by_the_same_factor_while_playing(pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", 1.4)
    pilot.block("b", nod("n", start="0", end=HIT) + nod("m", start="0", end="1.4"))
    await moves(pilot, 0.1, ("hit", 2.8), 4)
    for sync in ("strokeStart", "stroke", "strokeEnd", "end"):
        assert_time(pilot.feedback, f"b:n:{sync}", 2 * pilot.feedback.time(f"b:m:{sync}"))


@pytest.mark.parametrize("turn", [1, -1])
async def test_a_consistent_cycle_of_ties_is_kept_and_an_inconsistent_one_is_reported(
    pilot: RealizerPilot, turn: int
) -> None:
    def circle(last: str) -> str:
        return "".join([nod("x", start="y:start+1"), nod("y", start="z:start+1"), nod("z", start=last)][::turn])

    pilot.block("good", circle("x:start-2"))
    pilot.block("bad", circle("x:start-2.5"), composition="APPEND")
    await pilot.advance(8)
    assert_linked(pilot.feedback, "good:x:start", "good:z:start", 2.0)
    assert pilot.feedback.warnings == [("bad:z", "IMPOSSIBLE_TO_SCHEDULE")]
    assert "z:start = x:start-2.5 contradicts other constraints by 0.50 s" in texts(pilot)[0]


# --- two times from outside


@pytest.mark.parametrize(
    ("moved", "start"), [((0.5, ("go", 1.8)), 2.3), ((1.2, ("hit", 1.3)), 1.5), ((1.6, ("hit", 1.7)), 1.7)]
)
async def test_of_two_behaviors_whose_outer_times_come_too_close_the_later_one_is_delayed(
    pilot: RealizerPilot, moved: tuple[float, tuple[str, float]], start: float
) -> None:
    pilot.predict("t", "go", 1.0)
    pilot.predict("t", "hit", 2.0)
    pilot.block("b", wait("w", 0.5, start=GO) + nod("n", start=HIT) + after("w:end", "n:start"))
    await moves(pilot, *moved, 4)
    assert_time(pilot.feedback, "b:n:start", start)
    assert [f"n:start = {HIT} {LOST}" in said for said in texts(pilot)] == [True] * (start != 1.7)


@pytest.mark.parametrize("moved", [(0.5, ("go", 1.6)), (1.2, ("hit", 1.7)), (0.5, ("hit", 1.3))])
async def test_an_elastic_behavior_between_two_outer_times_is_shortened(
    pilot: RealizerPilot, moved: tuple[float, tuple[str, float]]
) -> None:
    pilot.predict("t", "go", 1.0)
    pilot.predict("t", "hit", 2.0)
    pilot.block("b", nod("m", start=GO) + nod("n", start=HIT) + after("m:end", "n:start"))
    await moves(pilot, *moved, 4)
    predicted = {"go": 1.0, "hit": 2.0} | dict([moved[1]])
    assert_time(pilot.feedback, "b:m:start", predicted["go"])
    assert_time(pilot.feedback, "b:n:start", predicted["hit"])
    assert_order(pilot.feedback, "b:m:end", "b:n:start")
    assert pilot.feedback.warnings == []


async def test_a_point_that_its_successor_overtakes_is_predicted_and_happens_with_it(pilot: RealizerPilot) -> None:
    pilot.predict("t", "go", 1.5)
    pilot.predict("t", "hit", 1.0)
    pilot.block("b", brows("n", start="0", attackPeak=HIT, end=GO))
    await moves(pilot, 0.5, ("hit", 3.0), 0.1)
    assert pilot.feedback.predicted("b:n:attackPeak") == pytest.approx(1.5)
    await pilot.advance(3)
    assert_time(pilot.feedback, "b:n:attackPeak", 1.5)
    assert [f"n:attackPeak = {HIT} {LOST}" in said for said in texts(pilot)] == [True]


@pytest.mark.parametrize(("moved", "why"), [(0.8, ": start is at 1.00 s, end at 0.80 s"), (1.0, "no time is left")])
async def test_a_behavior_that_has_no_duration_left_before_its_start_is_dropped_with_one_warning(
    pilot: RealizerPilot, moved: float, why: str
) -> None:
    pilot.predict("t", "go", 1.0)
    pilot.predict("t", "hit", 3.0)
    pilot.block("b", nod("n", start=GO, end=HIT))
    await moves(pilot, 0.5, ("hit", moved), 2)
    assert_not_played(pilot.feedback, "b:n")
    (said,) = texts(pilot)
    assert why in said


# --- what is predicted


async def test_every_point_of_a_moving_plan_happens_at_its_last_prediction(pilot: RealizerPilot) -> None:
    pilot.predict("t", "go", 1.0)
    pilot.block("b", WELL.format(f' start="{GO}"') + BEAT.format(' stroke="s:m"') + nod("n", start="g:end", end=HIT))
    pilot.block("c", nod("n"), composition="APPEND")
    await moves(pilot, 0.3, ("go", 1.4), 0.1, ("hit", 6.0), 0.4, ("go", 1.2), 1.5, ("hit", 5.0), 8)
    for point in pilot.feedback.progress:
        if point not in ("b:relax", "c:relax", "b:s:m"):
            assert pilot.feedback.predicted(point) == pytest.approx(pilot.feedback.time(point), abs=1e-3)
    assert pilot.feedback.time("c:start") == pilot.feedback.time("b:end")
