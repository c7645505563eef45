"""The strategy `convex`: what is given up where not all can be kept (docs/semantics.md, scheduling)."""

import daqp
import pytest
from hypothesis import given

from reactive_realizer.planunit.timing import Phase, PhaseKind, Timing
from reactive_realizer.scheduler.convex.convex_strategy import ConvexStrategy
from reactive_realizer.scheduler.problem import SchedulingProblem
from reactive_realizer.scheduler.strategy import solve
from reactive_realizer.testing.problems import TIMINGS, after, at, feasible_problems, item, outer, problem, problems
from reactive_realizer.testing.strategy_contract import violations

from .convex_plan import NOD, SPEECH, START, Plan


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


def test_where_only_what_is_required_is_left_it_is_told_by_what_it_says_and_not_by_the_behavior() -> None:
    plan = Plan({"s": SPEECH}, at("s:start", START, 1.0, required=True), at("s:end", START, 4.0, required=True))
    assert [(loss.fault.code, loss.required) for loss in plan.solution.losses] == [("rigid", True)]


def test_rigid_wins_over_a_second_tie_and_the_amount_is_named() -> None:
    plan = Plan({"s": SPEECH}, at("s:start", START, 1.0), at("s:end", START, 4.0))
    assert plan.losses == [("s", "rigid", False)]
    assert plan.solution.losses[0].fault.details["gap"] == pytest.approx(1.0)
    assert plan.times("s") == [1.0, 1.5, 3.0]


def test_two_times_of_the_outside_cannot_be_made_one() -> None:
    plan = Plan({"n": NOD}, at("n:start", outer("one", 1.0)), at("n:start", outer("two", 1.0)))
    assert plan.losses == [("n", "outer-tie", False)]
    assert plan["n:start"] == 1.0


def test_a_behavior_without_any_time_is_dropped_and_the_others_are_not() -> None:
    plan = Plan({"a": NOD, "b": NOD}, at("a:start", START, 1.0), at("a:end", START, 1.0))
    assert plan.losses == [("a", "too-short", True)]
    assert plan.solution.behaviors == {"b"}


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
def test_all_that_is_kept_holds_after_whatever_was_dropped(asked: SchedulingProblem) -> None:
    assert violations(asked, solve(ConvexStrategy(), asked)) == []


@given(feasible_problems())
def test_a_plan_is_found_also_where_the_solver_finds_none(asked: SchedulingProblem) -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(daqp, "solve", lambda *_, **__: (None, 0.0, -1, {}))
        solution = solve(ConvexStrategy(), asked)
    assert solution.losses == ()
    assert violations(asked, solution) == []


def test_a_long_chain_of_afters_is_planned() -> None:
    items = {f"n{i}": TIMINGS["nod"] for i in range(300)}
    plan = Plan(items, *(after(f"n{i}:start", f"n{i - 1}:end") for i in range(1, 300)))
    assert plan["n299:start"] == pytest.approx(299.0)
