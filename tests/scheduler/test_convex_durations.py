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


def test_all_phases_of_a_chain_stretch_by_the_same_factor() -> None:
    plan = Plan(
        {"a": BEAT, "b": NOD, "c": BEAT},
        at("a:start", START), at("b:start", "a:end"), at("c:start", "b:end"), at("c:end", START, 1.5 * 3.4),
    )  # fmt: skip
    for id_, timing in {"a": BEAT, "b": NOD, "c": BEAT}.items():
        assert plan.lengths(id_) == pytest.approx([1.5 * phase.duration for phase in timing.phases])


@given(st.lists(st.floats(0.05, 3.0), min_size=1, max_size=12), st.floats(0.05, 8.0))
def test_the_behaviors_of_any_chain_stretch_by_the_same_factor(durations: list[float], factor: float) -> None:
    items = {f"b{i}": timing_at({"start": 0.0, "end": d}) for i, d in enumerate(durations)}
    ties = [at(f"b{i}:start", f"b{i - 1}:end") for i in range(1, len(items))]
    ends = at("b0:start", START), at(f"b{len(items) - 1}:end", START, factor * sum(durations))
    plan = Plan(items, *ties, *ends)
    for i, duration in enumerate(durations):
        assert plan.lengths(f"b{i}") == pytest.approx([factor * duration], rel=1e-5)


def test_rigid_phases_keep_their_durations_and_the_elastic_phases_stretch() -> None:
    mixed = Timing(("start", "ready", "stroke", "end"), (Phase(0.5), Phase(1.0, PhaseKind.RIGID), Phase(0.5)))
    plan = Plan({"g": mixed}, at("g:start", START), at("g:end", START, 4.0))
    assert plan.lengths("g") == pytest.approx([1.5, 1.0, 1.5])


@given(st.floats(2.0, 60.0))
def test_holds_absorb_extra_time_and_elastic_phases_stretch_by_a_twentieth_at_most(end: float) -> None:
    plan = Plan({"g": HELD}, at("g:start", START), at("g:end", START, end))
    attack, hold, decay = plan.lengths("g")
    assert attack == pytest.approx(decay)
    assert 0.5 <= attack <= 0.5 * 1.053
    assert hold >= end - 1.06


def test_a_hold_shrinks_to_zero_before_elastic_phases_shrink_by_a_tenth() -> None:
    plan = Plan({"g": HELD}, at("g:start", START), at("g:end", START, 1.0))
    attack, hold, decay = plan.lengths("g")
    assert (attack, hold, decay) == pytest.approx((0.5, 0.0, 0.5), abs=0.06)


@given(problems())
def test_no_elastic_phase_shrinks_below_a_tenth_while_a_neighboring_hold_can_shrink(asked: SchedulingProblem) -> None:
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


def test_phases_outside_of_two_ties_stretch_like_the_nearest_phase_between_them() -> None:
    plan = Plan({"g": BEAT}, at("g:ready", START, 1.0), at("g:relax", START, 2.0))
    assert plan.lengths("g") == pytest.approx([0.6, 0.4, 0.6, 0.8])


def test_authored_limits_take_precedence_over_preferred_durations_but_not_over_constraints() -> None:
    limited = Timing(("start", "end"), (Phase(1.0, PhaseKind.ELASTIC, 0.5, 1.5),))
    plan = Plan({"a": limited, "b": NOD}, at("b:start", "a:end"), at("a:start", START), at("b:end", START, 4.0))
    assert plan.lengths("a") == pytest.approx([1.5])
    plan = Plan({"a": limited}, at("a:start", START), at("a:end", START, 4.0))
    assert (plan.losses, plan.lengths("a")) == ([], [4.0])


def test_other_phases_stretch_more_when_one_is_at_its_limit() -> None:
    short = Timing(("start", "stroke", "end"), (Phase(0.35, maximum=0.8), Phase(0.35)))
    plan = Plan({"g": BEAT, "n": short}, at("n:start", "g:start"), at("n:stroke", "g:end", 0.3))
    assert plan.losses == []
    assert plan["n:stroke"] == pytest.approx(0.8)
    assert plan["g:end"] == pytest.approx(0.5)


def test_a_phase_may_shrink_to_zero_if_its_behavior_does_not() -> None:
    plan = Plan({"n": NOD}, at("n:stroke", START))
    assert plan.losses == []
    assert plan.times("n") == pytest.approx([0.0, 0.0, 0.6])
