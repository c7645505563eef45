"""SmartBody's scheduling: dropped behaviors and constraints have no further effect (thesis 7.2.2, 7.24)."""

from collections.abc import Mapping

import pytest

from reactive_realizer.scheduler.plan_view import PlanView
from reactive_realizer.scheduler.problem import Origin, Point, Tie
from reactive_realizer.scheduler.smartbody.smartbody_strategy import SmartBodyStrategy
from reactive_realizer.testing.problems import TIMINGS, at, item, outer, problem

START = Origin.BLOCK_START


def solved(behaviors: dict[str, str], *ties: Tie) -> tuple[Mapping[Point, float | None], list[tuple[str, bool]]]:
    """The times of all points, and the losses as (code, required), of behaviors given as id -> kind."""
    asked = problem([item(id_, TIMINGS[kind]) for id_, kind in behaviors.items()], *ties)
    solution = SmartBodyStrategy().solve(asked)
    times = PlanView.of_solution(asked, solution).times
    return times, [(loss.fault.code, loss.required) for loss in solution.losses]


def test_a_behavior_tied_to_a_dropped_one_starts_with_its_block() -> None:
    hit = outer("hit", 3.0)
    ties = at("lost:start", hit), at("lost:end", hit), at("nod:start", "lost:start", 0.5)
    times, losses = solved({"lost": "beat", "nod": "nod"}, *ties)
    assert losses == [("too-short", False)]
    assert times[Point("nod", "start")] == 0.0


def test_a_cluster_is_placed_without_its_dropped_behavior() -> None:
    ties = at("n:start", "lost:end", 2.0), at("lost:start", "b:end"), at("lost:end", "b:end")
    times, losses = solved({"b": "beat", "lost": "nod", "n": "nod"}, *ties)
    assert losses == [("too-short", False)]
    assert times[Point("n", "start")] == times[Point("b", "start")] == 0.0


def test_a_rigid_behavior_loses_only_the_tie_that_it_cannot_meet() -> None:
    ties = at("s:start", "s:end", 0.5), at("s:end", outer("hit", 4.0))
    times, losses = solved({"s": "speech"}, *ties)
    assert losses == [("rigid", False)]
    assert times[Point("s", "end")] == 4.0


@pytest.mark.parametrize("required", [False, True])
def test_the_loss_of_a_behavior_fails_the_block_if_a_required_constraint_refers_to_it(required: bool) -> None:
    ties = at("lost:start", START, 3.0), at("lost:end", START, 3.0), at("nod:start", "lost:start", required=required)
    _, losses = solved({"lost": "beat", "nod": "nod"}, *ties)
    assert losses == [("too-short", required)]


def test_a_tie_that_puts_a_behavior_before_its_block_is_given_up_also_if_it_follows_a_future_outer_time() -> None:
    ties = at("s:end", outer("hit", 2.5)), at("n:start", "s:start", -1.0)
    times, losses = solved({"s": "speech", "n": "nod"}, *ties)
    assert losses == [("clash", False)]
    assert times[Point("s", "start")] == 0.5
    assert times[Point("n", "start")] == 0.0


def test_behaviors_stay_together_if_a_tie_of_one_puts_them_before_their_block() -> None:
    for hit, offset in ((-0.5, 0.0), (0.5, -1.0)):
        times, losses = solved(
            {"n": "nod", "m": "nod"}, at("n:start", outer("hit", hit), offset), at("m:start", "n:start")
        )
        assert losses == [("clash", False)]
        assert times[Point("n", "start")] == times[Point("m", "start")] == 0.0


def test_a_speech_that_is_tied_to_a_known_time_waits_for_the_behavior_before_it() -> None:
    ties = at("n:end", "s:start"), at("b:start", START, 1.0), at("b:end", "s:end")
    times, losses = solved({"s": "speech", "n": "nod", "b": "beat"}, *ties)
    assert losses == []
    assert [times[Point(id_, "start")] for id_ in "nsb"] == [0.0, 1.0, 1.0]


@pytest.mark.parametrize("other", [at("b:start", START), at("b:start", outer("hit", 0.25))], ids=["block", "outside"])
def test_a_tie_that_puts_a_point_before_the_block_is_given_up_also_if_the_start_is_unknown(other: Tie) -> None:
    ties = other, at("n:start", outer("unknown", None)), at("n:stroke", "b:start", -0.5)
    _, losses = solved({"b": "beat", "n": "nod"}, *ties)
    assert losses == [("contradictory-tie", False)]


def test_a_behavior_without_a_duration_is_dropped_also_if_one_of_its_points_is_unknown() -> None:
    ties = at("b:start", START, 1.0), at("b:stroke", "b:start"), at("b:strokeStart", outer("hit", None))
    _, losses = solved({"b": "beat"}, *ties)
    assert losses == [("too-short", False)]


def test_a_rigid_behavior_does_not_begin_before_its_block_although_another_one_has_an_unknown_time() -> None:
    """The behavior that waits for the unknown time is placed at a time that agrees with the tie before the block."""
    ties = at("q:end", outer("go", None)), at("r:start", "q:start", -0.2), at("r:end", START, -0.2)
    times, losses = solved({"q": "event", "r": "event"}, *ties)
    assert losses == [("clash", False), ("clash", False)]
    assert times[Point("r", "start")] == times[Point("r", "end")] == 0.0
