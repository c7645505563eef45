"""The strategy `convex`: the pegs of a plan keep its constraints while outer times move (docs/time.md)."""

import pytest

from reactive_realizer.scheduler.problem import Point
from reactive_realizer.testing.problems import after, at, outer

from .convex_plan import BEAT, HELD, NOD, SPEECH, START, Plan, move


def test_phases_between_two_outer_times_stretch_with_them() -> None:
    one, two = outer("one", 1.0), outer("two", 5.4)
    plan = Plan({"a": BEAT, "b": NOD}, at("a:start", one), at("b:start", "a:end"), at("b:end", two))
    assert plan.lengths("a") == pytest.approx([0.6, 0.4, 0.6, 0.8])
    move(two, 1.0 + 2.2)
    assert plan.lengths("a") == pytest.approx([0.3, 0.2, 0.3, 0.4])
    assert plan.lengths("b") == pytest.approx([0.4, 0.6])


def test_phases_between_ties_with_offsets_stretch_and_the_offsets_do_not() -> None:
    hit = outer("hit", 5.0)
    plan = Plan({"a": NOD, "b": NOD}, at("a:start", START, 1.0), at("b:start", "a:end", 1.0), at("b:end", hit, -1.0))
    assert plan.lengths("a") == plan.lengths("b") == pytest.approx([0.4, 0.6])
    move(hit, 7.0)
    assert plan["b:start"] - plan["a:end"] == pytest.approx(1.0)
    assert plan.lengths("a") == plan.lengths("b") == pytest.approx([0.8, 1.2])


def test_distances_outside_of_outer_times_do_not_change() -> None:
    hit = outer("hit", 3.0)
    plan = Plan({"g": BEAT, "n": NOD}, at("g:stroke", hit), at("n:start", "g:end"))
    move(hit, 4.0)
    assert plan.times("g") == pytest.approx([3.5, 3.8, 4.0, 4.3, 4.7])
    assert plan["n:end"] == pytest.approx(5.7)


def test_an_after_constraint_moves_its_point_and_all_points_that_depend_on_it() -> None:
    hit = outer("hit", 1.0)
    plan = Plan({"g": BEAT, "n": NOD}, at("g:start", START), after("g:relax", hit), at("n:start", "g:end"))
    assert plan["g:relax"] == pytest.approx(1.0)
    move(hit, 3.0)
    assert plan["g:relax"] == 3.0
    assert plan["n:start"] == plan["g:end"] == pytest.approx(3.4)
    assert plan["g:start"] == 0.0


def test_an_after_constraint_does_not_push_its_point_past_a_fixed_later_one() -> None:
    hit = outer("hit", 0.5)
    plan = Plan({"n": NOD}, at("n:end", START, 2.0), after("n:start", hit))
    assert plan["n:start"] == 1.0
    move(hit, 1.5)
    assert plan["n:start"] == 1.5
    move(hit, 2.0)
    assert plan["n:start"] == 1.0


def test_a_before_constraint_moves_the_earlier_point() -> None:
    hit = outer("hit", 4.0)
    plan = Plan({"n": NOD}, after(hit, "n:end"))
    assert plan.times("n") == pytest.approx([0.0, 0.4, 1.0])
    move(hit, 0.5)
    assert plan.times("n") == pytest.approx([0.0, 0.2, 0.5])


def test_a_before_constraint_does_not_pull_a_point_before_the_start_of_the_block() -> None:
    hit = outer("hit", 4.0)
    plan = Plan({"n": NOD}, after(hit, "n:start", 0.5))
    move(hit, -2.0)
    assert plan["n:start"] == 0.0


def test_a_before_constraint_does_not_move_a_behavior_that_is_tied_to_another_outer_time() -> None:
    go, hit = outer("go", 1.0), outer("hit", 4.0)
    plan = Plan({"s": SPEECH}, at("s:start", go), after(hit, "s:end"))
    move(hit, 2.0)
    assert plan.times("s") == pytest.approx([1.0, 1.5, 3.0])


def test_a_tied_point_depends_on_the_point_that_it_names_and_not_on_the_root_of_the_chain() -> None:
    hit = outer("hit", 1.0)
    pegs = Plan({"a": NOD, "b": NOD}, at("a:start", hit), at("b:start", "a:start", 1.0)).pegs
    assert pegs[Point("b", "start")].dependencies == (pegs[Point("a", "start")],)


def test_an_order_within_a_cluster_does_not_delay_the_cluster() -> None:
    hit = outer("hit", 4.0)
    ties = at("g:start", "s:end", -0.3), after("s:end", "g:stroke"), after("g:ready", hit)
    plan = Plan({"s": SPEECH, "g": BEAT}, *ties)
    move(hit, 3.0)
    assert plan["g:ready"] == pytest.approx(3.0)


def test_an_order_between_behaviors_at_different_outer_times_is_kept() -> None:
    one, two = outer("one", 1.0), outer("two", 5.0)
    plan = Plan({"a": NOD, "b": NOD}, at("a:start", one), at("b:start", two), after("b:start", "a:end"))
    move(one, 4.5)
    assert plan["b:start"] == plan["a:end"] == pytest.approx(5.0)  # the first is shortened
    move(one, 5.5)
    assert plan["b:start"] == plan["a:end"] == pytest.approx(6.5)  # it cannot shrink further, so the second moves


def test_a_before_constraint_never_moves_a_predicted_time() -> None:
    hit = outer("hit", 4.0)
    plan = Plan({"g": HELD}, after("g:end", hit, -2.0), after(hit, "g:ready", 1.0))
    move(hit, 8.0)
    assert plan["g:end"] == 6.0
    move(hit, 1.2)
    assert plan["g:ready"] == pytest.approx(0.2)


def test_orders_between_clusters_in_a_circle_are_kept_without_a_cycle_of_pegs() -> None:
    plan = Plan({"a": NOD, "b": NOD}, after("a:start", "b:start", -0.2), after("b:start", "a:start", 0.1))
    assert plan.losses == []
    assert plan["b:start"] - plan["a:start"] == pytest.approx(0.1)
    assert plan["a:start"] == pytest.approx(0.0)


def test_an_after_constraint_on_an_unknown_time_waits_and_a_before_constraint_has_no_effect() -> None:
    hit = outer("hit", None)
    plan = Plan({"a": NOD, "b": NOD, "c": NOD}, after("a:start", hit), after(hit, "b:end"), at("c:start", "a:end"))
    assert plan.times("a") == plan.times("c") == [None] * 3
    assert plan.times("b") == pytest.approx([0.0, 0.4, 1.0])
    move(hit, 2.0)
    assert plan.times("a") == pytest.approx([2.0, 2.4, 3.0])
