"""The strategy `convex`: earliest starts, free behaviors, and plans that do not depend on the order of the input."""

import random
from typing import TypeVar

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive_realizer.planunit.timing import timing_at
from reactive_realizer.scheduler.convex.convex_strategy import ConvexStrategy
from reactive_realizer.scheduler.problem import Point, SchedulingProblem
from reactive_realizer.scheduler.solution import Solution
from reactive_realizer.scheduler.strategy import solve
from reactive_realizer.testing.problems import after, at, feasible_problems, item, outer, peg_times, problem, problems
from reactive_realizer.testing.strategy_contract import violations

from .convex_plan import BEAT, CHANGE, NOD, SPEECH, START, Plan, move

T = TypeVar("T")

# --- starts


def test_example_26_starts_at_the_latest_of_its_after_constraints() -> None:
    items = {"speech": SPEECH, "point": BEAT, "walk": timing_at({"start": 0.0, "relax": 3.0, "end": 3.5})}
    orders = after("point:start", "walk:relax"), after("speech:start", START, 2.0)
    plan = Plan(items, at("point:stroke", "speech:sync1"), *orders)
    assert plan.losses == []
    assert plan["point:start"] == pytest.approx(3.0)
    assert plan["speech:start"] == pytest.approx(3.0)
    assert plan["walk:start"] == 0.0


def test_a_before_constraint_shortens_a_behavior_that_cannot_start_earlier() -> None:
    plan = Plan({"n": NOD}, after(START, "n:end", -0.5))
    assert plan.times("n") == pytest.approx([0.0, 0.2, 0.5])


def test_a_cluster_starts_as_early_as_possible_after_its_outer_time_moved() -> None:
    hit = outer("hit", 2.0)
    plan = Plan({"n": NOD, "g": BEAT}, after("n:start", hit, 0.5), at("g:start", "n:end"))
    assert plan["n:start"] == pytest.approx(2.5)
    move(hit, 1.0)
    assert (plan["n:start"], plan["g:start"]) == pytest.approx((1.5, 2.5))
    move(hit, -3.0)
    assert (plan["n:start"], plan["g:start"]) == pytest.approx((0.0, 1.0))


@pytest.mark.no_cover  # others cover the same lines, and tracing so many cases takes long
@given(feasible_problems(), st.floats(0.0, 6.0))
def test_all_clusters_start_as_early_as_possible_after_any_move(asked: SchedulingProblem, time: float) -> None:
    # No cluster is tied to an outer time, so the plan can follow any move.
    ties = [tie for tie in asked.ties if all(isinstance(node, Point) for node in tie.nodes)]
    hit = outer("hit", 3.0)
    orders = [after(Point(each.behavior.id, each.timing.points[0]), hit) for each in asked.items[:1]]
    free = problem(asked.items, *ties, *orders)
    solution = solve(ConvexStrategy(), free)
    move(hit, time)
    moved = SchedulingProblem(free.items, free.ties, {hit: time}, free.orders)
    times = {point: moment for point, moment in peg_times(free, solution).items() if moment is not None}
    broken = violations(moved, Solution(times, solution.losses))
    assert [v for v in broken if v.equation in ("7.24", "7.9", "7.33")] == []


# --- free behaviors


@pytest.mark.no_cover  # others cover the same lines, and tracing so many cases takes long
@given(feasible_problems())
def test_free_behaviors_do_not_move_others(asked: SchedulingProblem) -> None:
    points = [Point(each.behavior.id, sync) for each in asked.items for sync in each.timing.points]
    ends = random.Random(len(points)).choices(points, k=2)
    ties = at("free:start", ends[0]), at("free:end", ends[1])
    more = SchedulingProblem((*asked.items, item("free", CHANGE)), (*asked.ties, *ties), asked.times, asked.orders)
    with_it, without = solve(ConvexStrategy(), more), solve(ConvexStrategy(), asked)
    assert {point: with_it.times[point] for point in points} == without.times


def test_a_free_behavior_does_not_connect_the_behaviors_at_its_ends() -> None:
    ties = at("free:start", "a:end"), at("free:end", "b:start", 5.0)
    plan = Plan({"a": NOD, "b": NOD, "free": CHANGE}, *ties)
    assert plan.losses == []
    assert (plan["a:start"], plan["b:start"]) == (0.0, 0.0)
    assert plan.times("free") == pytest.approx([1.0, 5.0])


# --- order of the input


@pytest.mark.no_cover  # others cover the same lines, and tracing so many cases takes long
@given(problems(), st.randoms(use_true_random=False))
def test_the_plan_is_the_same_bit_for_bit_in_any_order(asked: SchedulingProblem, chance: random.Random) -> None:
    def shuffled(things: tuple[T, ...]) -> tuple[T, ...]:
        return tuple(chance.sample(things, len(things)))

    turned = SchedulingProblem(shuffled(asked.items), shuffled(asked.ties), asked.times, shuffled(asked.orders))
    one, two = solve(ConvexStrategy(), asked), solve(ConvexStrategy(), turned)
    assert one.times == two.times
    assert [str(loss.fault) for loss in one.losses] == [str(loss.fault) for loss in two.losses]
