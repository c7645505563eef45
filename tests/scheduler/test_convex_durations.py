"""The strategy `convex`: durations of least cost (docs/semantics.md, scheduling)."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive_realizer.planunit.timing import Phase, PhaseKind, Timing, timing_at
from reactive_realizer.scheduler.convex.convex_strategy import ConvexStrategy
from reactive_realizer.scheduler.plan_view import PlanView
from reactive_realizer.scheduler.problem import Point, Precedence, SchedulingProblem, Tie
from reactive_realizer.scheduler.strategy import solve
from reactive_realizer.testing.problems import at, problems

from .convex_plan import BEAT, HELD, NOD, START, Plan


def test_on_a_single_chain_every_phase_stretches_alike() -> None:
    plan = Plan(
        {"a": BEAT, "b": NOD, "c": BEAT},
        at("a:start", START), at("b:start", "a:end"), at("c:start", "b:end"), at("c:end", START, 1.5 * 3.4),
    )  # fmt: skip
    for id_, timing in {"a": BEAT, "b": NOD, "c": BEAT}.items():
        assert plan.lengths(id_) == pytest.approx([1.5 * phase.duration for phase in timing.phases])


@given(st.lists(st.floats(0.05, 3.0), min_size=1, max_size=12), st.floats(0.05, 8.0))
def test_whatever_the_chain_and_the_stretch(durations: list[float], factor: float) -> None:
    items = {f"b{i}": timing_at({"start": 0.0, "end": d}) for i, d in enumerate(durations)}
    ties = [at(f"b{i}:start", f"b{i - 1}:end") for i in range(1, len(items))]
    ends = at("b0:start", START), at(f"b{len(items) - 1}:end", START, factor * sum(durations))
    plan = Plan(items, *ties, *ends)
    for i, duration in enumerate(durations):
        assert plan.lengths(f"b{i}") == pytest.approx([factor * duration], rel=1e-5)


def test_rigid_phases_keep_their_length_and_the_elastic_ones_of_the_same_behavior_do_the_rest() -> None:
    mixed = Timing(("start", "ready", "stroke", "end"), (Phase(0.5), Phase(1.0, PhaseKind.RIGID), Phase(0.5)))
    plan = Plan({"g": mixed}, at("g:start", START), at("g:end", START, 4.0))
    assert plan.lengths("g") == pytest.approx([1.5, 1.0, 1.5])


@given(st.floats(2.0, 60.0))
def test_holds_take_time_before_elastic_phases_which_stretch_by_a_twentieth_at_most(end: float) -> None:
    plan = Plan({"g": HELD}, at("g:start", START), at("g:end", START, end))
    attack, hold, decay = plan.lengths("g")
    assert attack == pytest.approx(decay)
    assert 0.5 <= attack <= 0.5 * 1.053
    assert hold >= end - 1.06


def test_a_hold_gives_all_its_time_before_elastic_phases_give_a_tenth_of_theirs() -> None:
    plan = Plan({"g": HELD}, at("g:start", START), at("g:end", START, 1.0))
    attack, hold, decay = plan.lengths("g")
    assert (attack, hold, decay) == pytest.approx((0.5, 0.0, 0.5), abs=0.06)


@given(problems())
def test_no_elastic_phase_is_pressed_under_a_tenth_while_its_neighbors_could_give(asked: SchedulingProblem) -> None:
    solution = solve(ConvexStrategy(), asked)
    view = PlanView.of_solution(asked, solution)
    constraints: tuple[Tie | Precedence, ...] = (*asked.ties, *asked.orders)
    named = {node for each in constraints for node in each.nodes}
    times = {point: time for point, time in view.times.items() if time is not None}
    if len(times) < len(view.times):
        return
    for each in (each for each in asked.items if each.behavior.id in solution.behaviors):
        points = [Point(each.behavior.id, sync) for sync in each.timing.points]
        for k, phase in enumerate(each.timing.phases):
            inside = {points[k], points[k + 1]}.isdisjoint(named)
            if phase.kind is PhaseKind.ELASTIC and inside and 0 < k < len(points) - 2:
                ratio = (times[points[k + 1]] - times[points[k]]) / phase.duration
                neighbors = [(k + step, each.timing.phases[k + step]) for step in (-1, 1)]
                rest = [times[points[n + 1]] - times[points[n]] for n, p in neighbors if p.kind is PhaseKind.HOLD]
                assert ratio > 0.1 or all(length < 0.1 for length in rest), each


def test_outside_of_two_ties_the_stretch_of_the_nearest_phase_goes_on() -> None:
    plan = Plan({"g": BEAT}, at("g:ready", START, 1.0), at("g:relax", START, 2.0))
    assert plan.lengths("g") == pytest.approx([0.6, 0.4, 0.6, 0.8])


def test_authored_limits_are_kept_against_the_wish_for_natural_durations_and_given_up_for_constraints() -> None:
    limited = Timing(("start", "end"), (Phase(1.0, PhaseKind.ELASTIC, 0.5, 1.5),))
    plan = Plan({"a": limited, "b": NOD}, at("b:start", "a:end"), at("a:start", START), at("b:end", START, 4.0))
    assert plan.lengths("a") == pytest.approx([1.5])
    plan = Plan({"a": limited}, at("a:start", START), at("a:end", START, 4.0))
    assert (plan.losses, plan.lengths("a")) == ([], [4.0])


def test_where_one_is_as_long_as_it_may_be_the_others_give_all_that_is_missing() -> None:
    short = Timing(("start", "stroke", "end"), (Phase(0.35, maximum=0.8), Phase(0.35)))
    plan = Plan({"g": BEAT, "n": short}, at("n:start", "g:start"), at("n:stroke", "g:end", 0.3))
    assert plan.losses == []
    assert plan["n:stroke"] == pytest.approx(0.8)
    assert plan["g:end"] == pytest.approx(0.5)


def test_a_phase_may_vanish_where_constraints_leave_it_no_time_as_long_as_the_behavior_has_some() -> None:
    plan = Plan({"n": NOD}, at("n:stroke", START))
    assert plan.losses == []
    assert plan.times("n") == pytest.approx([0.0, 0.0, 0.6])
