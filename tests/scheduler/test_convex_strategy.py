"""The strategy `convex`: least cost, earliest starts, pegs that live, and what is given up (docs/semantics.md)."""

import random
from dataclasses import replace
from itertools import pairwise

import daqp
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive_realizer.planunit.timing import Phase, PhaseKind, Timing, timing_at
from reactive_realizer.scheduler.convex.convex_strategy import ConvexStrategy
from reactive_realizer.scheduler.plan_view import PlanView
from reactive_realizer.scheduler.problem import Origin, Point, Problem
from reactive_realizer.testing.problems import TIMINGS, after, at, feasible_problems, item, outer, problem, problems
from reactive_realizer.testing.strategy_contract import violations

START = Origin.BLOCK_START
NOD = timing_at({"start": 0.0, "stroke": 0.4, "end": 1.0})
BEAT = timing_at({"start": 0.0, "ready": 0.3, "stroke": 0.5, "relax": 0.8, "end": 1.2})
SPEECH = timing_at({"start": 0.0, "sync1": 0.5, "end": 2.0}, PhaseKind.RIGID)
HELD = Timing(("start", "ready", "relax", "end"), (Phase(0.5), Phase(1.0, PhaseKind.HOLD), Phase(0.5)))
CHANGE = timing_at({"start": 0.0, "end": 1.0}, PhaseKind.FREE)


class Plan:
    """What came out, as times that are computed anew from the pegs each time they are asked for."""

    def __init__(self, items, *constraints) -> None:
        self.asked = problem([item(id_, timing) for id_, timing in items.items()], *constraints)
        self.solution = ConvexStrategy().solve(self.asked)

    def __getitem__(self, point):
        behavior, sync = point.split(":")
        return self._view.times[Point(behavior, sync)]

    def times(self, behavior):
        return [self._view.times[Point(behavior, sync)] for sync in self.solution.pegs[behavior]]

    def lengths(self, behavior):
        return [after - before for before, after in pairwise(self.times(behavior))]

    @property
    def losses(self):
        return [(loss.behavior, loss.fault.code, loss.dropped) for loss in self.solution.losses]

    @property
    def lost(self):
        return [loss.constraint.text for loss in self.solution.losses if loss.constraint]

    @property
    def _view(self):
        times = {cell: cell.value for cell in self.asked.times}
        return PlanView.of_solution(replace(self.asked, times=times), self.solution)


def move(cell, time):
    with cell.graph.transaction("test"):
        cell.set(time)


# --- durations


def test_on_a_single_chain_every_phase_stretches_alike() -> None:
    plan = Plan(
        {"a": BEAT, "b": NOD, "c": BEAT},
        at("a:start", START), at("b:start", "a:end"), at("c:start", "b:end"), at("c:end", START, 1.5 * 3.4),
    )  # fmt: skip
    for id_, timing in {"a": BEAT, "b": NOD, "c": BEAT}.items():
        assert plan.lengths(id_) == pytest.approx([1.5 * phase.duration for phase in timing.phases])


@given(st.lists(st.floats(0.05, 3.0), min_size=1, max_size=12), st.floats(0.05, 8.0))
def test_whatever_the_chain_and_the_stretch(durations, factor) -> None:
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
def test_holds_take_time_before_elastic_phases_which_stretch_by_a_twentieth_at_most(end) -> None:
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
def test_no_elastic_phase_is_pressed_under_a_tenth_while_its_neighbors_could_give(asked: Problem) -> None:
    solution = ConvexStrategy().solve(asked)
    view = PlanView.of_solution(asked, solution)
    named = {node for each in (*asked.ties, *asked.orders) for node in each.nodes}
    for each in (each for each in asked.items if each.behavior.id in solution.pegs):
        points = [Point(each.behavior.id, sync) for sync in each.timing.points]
        for k, phase in enumerate(each.timing.phases):
            inside = {points[k], points[k + 1]}.isdisjoint(named)
            if (
                phase.kind is PhaseKind.ELASTIC
                and inside
                and 0 < k < len(points) - 2
                and None not in view.times.values()
            ):
                ratio = (view.times[points[k + 1]] - view.times[points[k]]) / phase.duration
                neighbors = [(k + step, each.timing.phases[k + step]) for step in (-1, 1)]
                rest = [
                    view.times[points[n + 1]] - view.times[points[n]] for n, p in neighbors if p.kind is PhaseKind.HOLD
                ]
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


def test_a_phase_may_vanish_where_constraints_leave_it_no_time_as_long_as_the_behavior_has_some() -> None:
    plan = Plan({"n": NOD}, at("n:stroke", START))
    assert plan.losses == []
    assert plan.times("n") == pytest.approx([0.0, 0.0, 0.6])


# --- starts


def test_example_26_starts_with_the_after_that_lets_it_start_last() -> None:
    items = {"speech": SPEECH, "point": BEAT, "walk": timing_at({"start": 0.0, "relax": 3.0, "end": 3.5})}
    ties = at("point:stroke", "speech:sync1"), after("point:start", "walk:relax"), after("speech:start", START, 2.0)
    plan = Plan(items, *ties)
    assert plan.losses == []
    assert plan["point:start"] == pytest.approx(3.0)
    assert plan["speech:start"] == pytest.approx(3.0)
    assert plan["walk:start"] == 0.0


def test_before_squeezes_what_cannot_start_earlier() -> None:
    plan = Plan({"n": NOD}, after(START, "n:end", -0.5))
    assert plan.times("n") == pytest.approx([0.0, 0.2, 0.5])


def test_a_cluster_is_as_early_as_allowed_also_after_what_it_waits_for_was_moved() -> None:
    hit = outer("hit", 2.0)
    plan = Plan({"n": NOD, "g": BEAT}, after("n:start", hit, 0.5), at("g:start", "n:end"))
    assert plan["n:start"] == pytest.approx(2.5)
    move(hit, 1.0)
    assert (plan["n:start"], plan["g:start"]) == pytest.approx((1.5, 2.5))
    move(hit, -3.0)
    assert (plan["n:start"], plan["g:start"]) == pytest.approx((0.0, 1.0))


@given(feasible_problems(), st.floats(0.0, 6.0))
def test_also_after_any_move_no_cluster_could_start_earlier(asked: Problem, time: float) -> None:
    # Nothing of the clusters is tied to the outside, so that whatever moves can be followed.
    ties = [tie for tie in asked.ties if all(isinstance(node, Point) for node in tie.nodes)]
    hit = outer("hit", 3.0)
    orders = [after(Point(each.behavior.id, each.timing.points[0]), hit) for each in asked.items[:1]]
    free = problem(asked.items, *ties, *orders)
    solution = ConvexStrategy().solve(free)
    move(hit, time)
    moved = Problem(free.items, free.ties, {hit: time}, free.orders)
    assert [v for v in violations(moved, solution) if v.equation == "7.24"] == []
    assert [v for v in violations(moved, solution) if v.equation in ("7.9", "7.33")] == []


# --- pegs that live


def test_between_two_outer_times_everything_stretches_with_them() -> None:
    one, two = outer("one", 1.0), outer("two", 5.4)
    plan = Plan({"a": BEAT, "b": NOD}, at("a:start", one), at("b:start", "a:end"), at("b:end", two))
    assert plan.lengths("a") == pytest.approx([0.6, 0.4, 0.6, 0.8])
    move(two, 1.0 + 2.2)
    assert plan.lengths("a") == pytest.approx([0.3, 0.2, 0.3, 0.4])
    assert plan.lengths("b") == pytest.approx([0.4, 0.6])


def test_what_lies_between_ties_with_offsets_stretches_and_the_offsets_do_not() -> None:
    hit = outer("hit", 5.0)
    plan = Plan({"a": NOD, "b": NOD}, at("a:start", START, 1.0), at("b:start", "a:end", 1.0), at("b:end", hit, -1.0))
    assert plan.lengths("a") == plan.lengths("b") == pytest.approx([0.4, 0.6])
    move(hit, 7.0)
    assert plan["b:start"] - plan["a:end"] == pytest.approx(1.0)
    assert plan.lengths("a") == plan.lengths("b") == pytest.approx([0.8, 1.2])


def test_outside_of_outer_times_distances_stay() -> None:
    hit = outer("hit", 3.0)
    plan = Plan({"g": BEAT, "n": NOD}, at("g:stroke", hit), at("n:start", "g:end"))
    move(hit, 4.0)
    assert plan.times("g") == pytest.approx([3.5, 3.8, 4.0, 4.3, 4.7])
    assert plan["n:end"] == pytest.approx(5.7)


def test_an_after_pushes_what_comes_after_and_all_that_follows_it() -> None:
    hit = outer("hit", 1.0)
    plan = Plan({"g": BEAT, "n": NOD}, at("g:start", START), after("g:relax", hit), at("n:start", "g:end"))
    assert plan["g:relax"] == pytest.approx(1.0)
    move(hit, 3.0)
    assert plan["g:relax"] == 3.0
    assert plan["n:start"] == plan["g:end"] == pytest.approx(3.4)
    assert plan["g:start"] == 0.0


def test_a_before_pulls_what_comes_before() -> None:
    hit = outer("hit", 4.0)
    plan = Plan({"n": NOD}, after(hit, "n:end"))
    assert plan.times("n") == pytest.approx([0.0, 0.4, 1.0])
    move(hit, 0.5)
    assert plan.times("n") == pytest.approx([0.0, 0.2, 0.5])


def test_a_before_pulls_no_further_than_the_start_of_the_block() -> None:
    hit = outer("hit", 4.0)
    plan = Plan({"n": NOD}, after(hit, "n:start", 0.5))
    move(hit, -2.0)
    assert plan["n:start"] == 0.0


def test_a_before_does_not_pull_what_hangs_on_another_time_from_outside() -> None:
    go, hit = outer("go", 1.0), outer("hit", 4.0)
    plan = Plan({"s": SPEECH}, at("s:start", go), after(hit, "s:end"))
    move(hit, 2.0)
    assert plan.times("s") == pytest.approx([1.0, 1.5, 3.0])


def test_who_is_tied_to_a_behavior_hangs_on_that_and_not_on_what_that_is_tied_to() -> None:
    hit = outer("hit", 1.0)
    pegs = Plan({"a": NOD, "b": NOD}, at("a:start", hit), at("b:start", "a:start", 1.0)).solution.pegs
    assert pegs["b"]["start"].link is pegs["a"]["start"]


def test_an_order_within_a_cluster_does_not_keep_it_from_beginning_earlier() -> None:
    hit = outer("hit", 4.0)
    ties = at("g:start", "s:end", -0.3), after("s:end", "g:stroke"), after("g:ready", hit)
    plan = Plan({"s": SPEECH, "g": BEAT}, *ties)
    move(hit, 3.0)
    assert plan["g:ready"] == pytest.approx(3.0)


def test_an_order_between_two_that_hang_on_different_outer_times_is_kept() -> None:
    one, two = outer("one", 1.0), outer("two", 5.0)
    plan = Plan({"a": NOD, "b": NOD}, at("a:start", one), at("b:start", two), after("b:start", "a:end"))
    move(one, 4.5)
    assert plan["b:start"] == plan["a:end"] == pytest.approx(5.0)  # the first is hurried
    move(one, 5.5)
    assert plan["b:start"] == plan["a:end"] == pytest.approx(6.5)  # no more: the second is held back


def test_a_predicted_time_is_never_pushed_by_what_is_to_come_before_it() -> None:
    hit = outer("hit", 4.0)
    plan = Plan({"g": HELD}, after("g:end", hit, -2.0), after(hit, "g:ready", 1.0))
    move(hit, 8.0)
    assert plan["g:end"] == 6.0
    move(hit, 1.2)
    assert plan["g:ready"] == pytest.approx(0.2)


def test_orders_in_a_circle_of_clusters_are_kept_and_make_no_circle_of_pegs() -> None:
    plan = Plan({"a": NOD, "b": NOD}, after("a:start", "b:start", -0.2), after("b:start", "a:start", 0.1))
    assert plan.losses == []
    assert plan["b:start"] - plan["a:start"] == pytest.approx(0.1)
    assert plan["a:start"] == pytest.approx(0.0)


def test_what_is_after_an_unknown_time_waits_and_what_is_before_it_is_not_bound() -> None:
    hit = outer("hit", None)
    plan = Plan({"a": NOD, "b": NOD, "c": NOD}, after("a:start", hit), after(hit, "b:end"), at("c:start", "a:end"))
    assert plan.times("a") == plan.times("c") == [None] * 3
    assert plan.times("b") == pytest.approx([0.0, 0.4, 1.0])
    move(hit, 2.0)
    assert plan.times("a") == pytest.approx([2.0, 2.4, 3.0])


# --- free behaviors


@given(feasible_problems())
def test_free_behaviors_move_nothing(asked: Problem) -> None:
    points = [Point(each.behavior.id, sync) for each in asked.items for sync in each.timing.points]
    ends = random.Random(len(points)).choices(points, k=2)
    ties = at("free:start", ends[0]), at("free:end", ends[1])
    more = Problem((*asked.items, item("free", CHANGE)), (*asked.ties, *ties), asked.times, asked.orders)
    with_it, without = ConvexStrategy().solve(more), ConvexStrategy().solve(asked)
    times = PlanView.of_solution(more, with_it).times
    assert {point: times[point] for point in points} == PlanView.of_solution(asked, without).times


def test_a_free_behavior_ties_nothing_together() -> None:
    ties = at("free:start", "a:end"), at("free:end", "b:start", 5.0)
    plan = Plan({"a": NOD, "b": NOD, "free": CHANGE}, *ties)
    assert plan.losses == []
    assert (plan["a:start"], plan["b:start"]) == (0.0, 0.0)
    assert plan.times("free") == pytest.approx([1.0, 5.0])


# --- any order


@given(problems(), st.randoms(use_true_random=False))
def test_the_plan_is_the_same_bit_for_bit_in_any_order(asked: Problem, chance: random.Random) -> None:
    def shuffled(things):
        return tuple(chance.sample(things, len(things)))

    turned = Problem(shuffled(asked.items), shuffled(asked.ties), asked.times, shuffled(asked.orders))
    one, two = ConvexStrategy().solve(asked), ConvexStrategy().solve(turned)
    assert PlanView.of_solution(asked, one).times == PlanView.of_solution(turned, two).times
    assert [str(loss.fault) for loss in one.losses] == [str(loss.fault) for loss in two.losses]


# --- what cannot be


def test_limits_go_first_and_silently_then_orders_then_ties() -> None:
    limited = Timing(("start", "end"), (Phase(1.0, PhaseKind.RIGID),))
    ties = at("a:start", START, 1.0), after(START, "a:end", -1.5), at("b:start", "a:end")
    plan = Plan({"a": limited, "b": NOD}, *ties)
    assert plan.lost == [ties[1].text]
    assert plan.solution.losses[0].fault.code == "clash"
    assert plan.solution.losses[0].fault.details["gap"] == pytest.approx(0.5)
    assert (plan["a:start"], plan["b:start"]) == (1.0, 2.0)


def test_of_several_ties_the_last_one_goes_and_it_is_said_what_it_clashes_with() -> None:
    ties = at("b:start", "a:end", 1.0), at("a:start", START), at("b:start", START, 0.5)
    plan = Plan({"a": NOD, "b": NOD}, *ties)
    assert plan.lost == [ties[2].text]
    assert all(tie.text in plan.solution.losses[0].fault.sentence for tie in ties)
    assert plan["b:start"] == pytest.approx(2.0)


def test_an_order_is_given_up_before_a_tie_whatever_was_written_first() -> None:
    plan = Plan({"n": NOD}, after("n:end", START, 3.0), at("n:start", START), at("n:end", START, 2.0))
    assert [loss.behavior for loss in plan.solution.losses] == [None]
    assert plan["n:end"] == 2.0


def test_required_constraints_are_kept_before_others() -> None:
    plan = Plan({"n": NOD}, after("n:end", START, 3.0, required=True), at("n:start", START), at("n:end", START, 2.0))
    assert plan.losses == [("n", "clash", False)]
    assert plan["n:end"] >= 3.0 - 1e-9


def test_a_loss_of_what_is_required_fails_the_block() -> None:
    plan = Plan({"n": NOD}, at("n:end", START, 3.0, required=True), at("n:end", START, 2.0, required=True))
    assert [(loss.fault.code, loss.required) for loss in plan.solution.losses] == [("contradictory-tie", True)]


def test_a_required_constraint_on_a_dropped_behavior_fails_the_block_too() -> None:
    items = [item("a", NOD), item("b", NOD)]
    ties = at("a:start", START, 1.0), at("a:end", START, 1.0), at("b:start", "a:end", required=True)
    losses = ConvexStrategy().solve(problem(items, *ties)).losses
    assert {(loss.fault.code, loss.required) for loss in losses} == {("too-short", False), ("names-dropped", True)}


def test_rigid_wins_over_a_second_tie_and_the_amount_is_named() -> None:
    plan = Plan({"s": SPEECH}, at("s:start", START, 1.0), at("s:end", START, 4.0))
    assert plan.losses == [("s", "rigid", False)]
    assert plan.solution.losses[0].fault.details == {"point": "s:end", "gap": pytest.approx(1.0)}
    assert plan.times("s") == [1.0, 1.5, 3.0]


def test_two_times_of_the_outside_cannot_be_made_one() -> None:
    plan = Plan({"n": NOD}, at("n:start", outer("one", 1.0)), at("n:start", outer("two", 1.0)))
    assert plan.losses == [("n", "outer-tie", False)]
    assert plan["n:start"] == 1.0


def test_a_behavior_without_any_time_is_dropped_and_the_others_are_not() -> None:
    plan = Plan({"a": NOD, "b": NOD}, at("a:start", START, 1.0), at("a:end", START, 1.0))
    assert plan.losses == [("a", "too-short", True)]
    assert set(plan.solution.pegs) == {"b"}


def test_what_hangs_on_a_point_that_has_passed_joins_late_unless_it_is_over() -> None:
    assert Plan({"n": NOD}, at("n:start", outer("hit", -0.5))).times("n") == pytest.approx([-0.5, -0.1, 0.5])
    plan = Plan({"n": NOD}, at("n:start", outer("hit", -1.5)))
    assert plan.losses == [("n", "all-past", True)]
    assert plan.solution.losses[0].fault.details["late"] == pytest.approx(0.5)


def test_contradictions_that_have_nothing_to_do_with_each_other_are_all_told() -> None:
    ties = [each for id_ in "abc" for each in (at(f"{id_}:start", START, 1.0), at(f"{id_}:start", START, 2.0))]
    plan = Plan(dict.fromkeys("abc", NOD), *ties)
    assert plan.losses == [(id_, "contradictory-tie", False) for id_ in "abc"]
    assert [plan[f"{id_}:start"] for id_ in "abc"] == [1.0] * 3


@given(problems(most=12))
def test_all_that_is_kept_holds_after_whatever_was_dropped(asked: Problem) -> None:
    assert violations(asked, ConvexStrategy().solve(asked)) == []


@given(feasible_problems())
def test_a_plan_is_found_also_where_the_solver_finds_none(asked: Problem) -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(daqp, "solve", lambda *_, **__: (None, 0.0, -1, {}))
        solution = ConvexStrategy().solve(asked)
    assert solution.losses == ()
    assert violations(asked, solution) == []


def test_a_long_chain_of_afters_is_planned() -> None:
    items = {f"n{i}": TIMINGS["nod"] for i in range(300)}
    plan = Plan(items, *(after(f"n{i}:start", f"n{i - 1}:end") for i in range(1, 300)))
    assert plan["n299:start"] == pytest.approx(299.0)
