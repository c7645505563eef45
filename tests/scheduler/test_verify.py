"""The equations of the thesis, as corrected: a violation has its equation, its points and its amount."""

from collections.abc import Collection, Mapping

import pytest

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.planunit.timing import PhaseKind, Timing, timing_at
from reactive_realizer.scheduler.faults import ContradictoryTie
from reactive_realizer.scheduler.plan_view import PlanView
from reactive_realizer.scheduler.problem import Origin, Point, Precedence, Tie
from reactive_realizer.scheduler.solution import Loss, Solution
from reactive_realizer.scheduler.verify import verify
from reactive_realizer.testing.pilot import open_pilot
from reactive_realizer.testing.problems import TIMINGS, after, at, item, outer, problem

START = Origin.BLOCK_START
NOD = TIMINGS["nod"]


def view(
    times: Mapping[str, tuple[float | None, ...]],
    *kept: Tie | Precedence,
    start: float = 0.0,
    now: float = 0.0,
    past: Collection[str] = (),
    end: float | None = None,
    end_floor: float = 0.0,
    timings: Mapping[str, Timing] | None = None,
) -> PlanView:
    """A plan of nods, ``{"a": (start, stroke, end)}``, unless other timings are given."""
    timings = timings or dict.fromkeys(times, NOD)
    points = {
        Point(id_, sync): time
        for id_, row in times.items()
        for sync, time in zip(timings[id_].points, row, strict=True)
    }
    cells = {node: node.value for each in kept for node in each.nodes if not isinstance(node, Point | Origin)}
    gone = frozenset(Point(*point.split(":")) for point in past)
    return PlanView(timings, points, gone, kept, cells, start, max(start, now), end, end_floor)


def broken(plan: PlanView) -> list[tuple[str, tuple[str, ...], object]]:
    return [(each.equation, each.points, pytest.approx(each.amount)) for each in verify(plan)]


FINE = {"a": (0.0, 0.4, 1.0)}
TWO = {**FINE, "b": (0.0, 0.4, 1.0)}


def test_a_correct_plan_has_no_violations() -> None:
    later = {"a": (0.0, 0.4, 1.0), "b": (1.5, 1.9, 2.5)}
    assert broken(view(later, at("b:start", "a:end", 0.5), after("b:end", "a:end"), end=2.5)) == []


# --- constraints


@pytest.mark.parametrize(
    ("constraint", "equation", "points", "amount"),
    [
        (at("b:start", START, 0.5), "7.8", ("b:start", "block start"), 0.5),
        (at("b:start", "a:end", 0.5), "7.11", ("b:start", "a:end"), 1.5),
        (at("b:end", outer("hit", 3.0), -0.5), "7.32", ("b:end", "hit"), 1.5),
        (after("b:start", START, 0.25), "7.9", ("b:start", "block start"), 0.25),
        (after(START, "b:end"), "7.10", ("block start", "b:end"), 1.0),
        (after("b:start", "a:stroke", 0.1), "7.12", ("b:start", "a:stroke"), 0.5),
        (after("b:start", outer("hit", 3.0)), "7.33", ("b:start", "hit"), 3.0),
        (after(outer("hit", 0.5), "b:end"), "7.34", ("hit", "b:end"), 0.5),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_a_missed_constraint_is_reported_with_its_equation(
    constraint: Tie | Precedence, equation: str, points: tuple[str, str], amount: float
) -> None:
    assert (equation, points, pytest.approx(amount)) in broken(view(TWO, constraint))


def test_before_and_after_constraints_are_inequalities_and_ties_are_not() -> None:
    apart = {"a": (0.0, 0.4, 1.0), "b": (0.0, 1.9, 2.5)}
    assert broken(view(apart, after("b:end", "a:end"))) == []
    assert broken(view(apart, at("b:end", "a:end"))) == [("7.11", ("b:end", "a:end"), 1.5)]


# --- every plan


def test_a_point_before_its_block_is_a_violation() -> None:
    assert broken(view({"a": (-0.5, 0.4, 1.0)})) == [("7.13", ("a:start",), 0.5)]


def test_a_behavior_tied_to_an_outer_time_does_not_start_before_its_block() -> None:
    assert broken(view({"a": (-0.5, 0.5, 1.0)}, at("a:stroke", outer("hit", 0.5)))) == [("7.13", ("a:start",), 0.5)]


def test_a_behavior_without_a_duration_is_a_violation_unless_it_is_an_event() -> None:
    assert [each[0] for each in broken(view({"a": (0.0, 0.0, 0.0)}))] == ["7.14"]
    event = {"e": TIMINGS["event"]}
    assert broken(view({"e": (0.0, 0.0)}, timings=event)) == []


def test_points_out_of_order_are_a_violation() -> None:
    assert broken(view({"a": (0.0, 1.25, 1.0)})) == [("7.15", ("a:stroke", "a:end"), 0.25)]


def test_a_changed_duration_of_a_rigid_phase_is_a_violation() -> None:
    speech = {"s": timing_at({"start": 0.0, "sync": 0.5, "end": 2.0}, PhaseKind.RIGID)}
    assert broken(view({"s": (0.0, 0.75, 2.25)}, timings=speech)) == [("7.1.4", ("s:start", "s:sync"), 0.25)]
    assert broken(view({"s": (0.0, 0.25, 1.75)}, timings=speech)) == [("7.1.4", ("s:start", "s:sync"), 0.25)]


# --- clusters


def test_a_cluster_without_a_given_time_starts_with_its_block() -> None:
    late = {"a": (1.0, 1.4, 2.0), "b": (1.4, 1.8, 2.4)}
    assert broken(view(late, at("b:start", "a:stroke"))) == [("7.24", ("a:start", "b:start"), 1.0)]
    assert broken(view({"a": (1.0, 1.4, 2.0)}, at("a:start", START, 1.0))) == []
    assert broken(view({"a": (1.0, 1.4, 2.0)}, at("a:start", outer("hit", 1.0)))) == []


def test_a_cluster_with_after_constraints_starts_as_early_as_they_allow() -> None:
    waiting = {"a": (0.0, 0.4, 1.0), "b": (1.5, 1.9, 2.5)}
    assert broken(view(waiting, after("b:start", "a:end", 0.5))) == []
    assert broken(view(waiting, after("b:start", "a:end"))) == [("7.24", ("b:start",), 0.5)]
    assert broken(view(waiting, after("b:start", START, 1.5))) == []


def test_a_cluster_starts_now_if_its_block_started_earlier() -> None:
    assert broken(view({"a": (1.0, 1.4, 2.0)}, now=1.0)) == []
    assert broken(view({"a": (1.0, 1.4, 2.0)}, now=0.25)) == [("7.24", ("a:start",), 0.75)]


def test_a_free_behavior_belongs_to_no_cluster_and_may_be_anywhere() -> None:
    timings = {"a": NOD, "c": TIMINGS["change"]}
    times = {"a": (0.0, 0.4, 1.0), "c": (3.0, 4.0)}
    assert broken(view(times, timings=timings)) == []


# --- the end of a block


def test_a_block_ends_with_its_last_behavior() -> None:
    assert broken(view(TWO, end=1.0)) == []
    assert broken(view(TWO, end=0.75)) == [("7.27", ("a:end",), 0.25), ("7.27", ("b:end",), 0.25)]
    assert broken(view(TWO, end=1.5)) == [("7.27", ("a:end", "b:end"), 0.5)]
    assert broken(view(TWO, end=1.5, end_floor=1.5)) == []


# --- unchecked constraints


def test_unknown_times_are_not_checked() -> None:
    assert broken(view({"a": (None, None, None), "b": (0.0, 0.4, 1.0)}, at("a:start", "b:end"), end=None)) == []
    assert broken(view(FINE, after("a:start", outer("hit", None)))) == []


def test_constraints_are_checked_only_if_one_of_their_points_is_ahead() -> None:
    passed = ["a:start", "a:stroke", "a:end"]
    assert broken(view(TWO, at("b:start", "a:end", 0.5), past=passed)) == []
    assert broken(view(TWO, after("a:start", "b:end"), past=passed)) == []
    assert ("7.12", ("b:start", "a:end"), 1.0) in broken(view(TWO, after("b:start", "a:end"), past=passed))


def test_constraints_of_removed_points_are_not_checked() -> None:
    assert broken(view({"b": (2.0, 2.4, 3.0)}, at("b:start", "a:end"))) == []


# --- views


def test_a_view_of_a_solution_has_its_times_and_what_was_kept() -> None:
    kept, lost = at("a:start", START, 1.0), at("a:end", START, 9.0)
    asked = problem([item("a", NOD)], kept, lost)
    times = {Point("a", "start"): 1.0, Point("a", "stroke"): 1.4, Point("a", "end"): 2.0}
    plan = PlanView.of_solution(
        asked, Solution(times, (Loss("a", ContradictoryTie(tie=lost.text, gap=7.0), False, False, lost),))
    )
    assert plan.kept == (kept,)
    assert plan.times == times
    assert verify(plan) == []


def test_points_that_depend_on_unknown_times_are_unknown_in_a_view_of_a_solution() -> None:
    asked = problem([item("a", NOD), item("b", NOD)], at("a:start", outer("hit", None)), after("b:start", "a:end"))
    times = {Point(id_, sync): time for id_ in "ab" for sync, time in zip(NOD.points, NOD.offsets, strict=True)}
    assert set(PlanView.of_solution(asked, Solution(times, ())).times.values()) == {None}


async def test_a_view_of_a_block_has_its_current_times() -> None:
    async with open_pilot() as pilot:
        pilot.predict("partner", "hit", 2.0)
        pilot.block("b", '<gesture id="g" lexeme="BEAT" stroke="anticipators:partner:hit"/>')
        await pilot.advance(1.5)
        (block,) = pilot.realizer.scheduler.blocks.alive
        plan = PlanView.of_block(block, GlobalTime(1.5), played=True)
        assert plan.times[Point("g", "stroke")] == 2.0
        assert Point("g", "start") in plan.past
        assert plan.end == plan.times[Point("g", "end")]
        assert [tie.text for tie in plan.kept] == ["g:stroke = anticipators:partner:hit"]
        assert verify(plan) == []
