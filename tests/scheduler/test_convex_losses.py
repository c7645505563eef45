"""The strategy `convex`: the losses if not all constraints can be kept (docs/semantics.md, scheduling)."""

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


def test_limits_are_dropped_first_without_a_loss_then_orders_then_ties() -> None:
    limited = Timing(("start", "end"), (Phase(1.0, PhaseKind.RIGID),))
    ties = at("a:start", START, 1.0), after(START, "a:end", -1.5), at("b:start", "a:end")
    plan = Plan({"a": limited, "b": NOD}, *ties)
    assert plan.lost == [ties[1].text]
    assert plan.solution.losses[0].fault.code == "clash"
    assert plan.solution.losses[0].fault.details["gap"] == pytest.approx(0.5)
    assert (plan["a:start"], plan["b:start"]) == (1.0, 2.0)


def test_the_last_of_several_conflicting_ties_is_dropped_and_the_loss_names_the_others() -> None:
    ties = at("b:start", "a:end", 1.0), at("a:start", START), at("b:start", START, 0.5)
    plan = Plan({"a": NOD, "b": NOD}, *ties)
    assert plan.lost == [ties[2].text]
    assert all(tie.text in plan.solution.losses[0].fault.sentence for tie in ties)
    assert plan["b:start"] == pytest.approx(2.0)


def test_an_order_is_dropped_before_a_tie_also_if_it_was_written_first() -> None:
    plan = Plan({"n": NOD}, after("n:end", START, 3.0), at("n:start", START), at("n:end", START, 2.0))
    assert [loss.behavior for loss in plan.solution.losses] == [None]
    assert plan["n:end"] == 2.0


def test_required_constraints_are_kept_before_others() -> None:
    plan = Plan({"n": NOD}, after("n:end", START, 3.0, required=True), at("n:start", START), at("n:end", START, 2.0))
    assert plan.losses == [("n", "clash", False)]
    assert plan["n:end"] >= 3.0 - 1e-9


def test_the_loss_of_a_required_constraint_fails_the_block() -> None:
    plan = Plan({"n": NOD}, at("n:end", START, 3.0, required=True), at("n:end", START, 2.0, required=True))
    assert [(loss.fault.code, loss.required) for loss in plan.solution.losses] == [("contradictory-tie", True)]


def test_a_required_constraint_on_a_dropped_behavior_fails_the_block_too() -> None:
    items = [item("a", NOD), item("b", NOD)]
    ties = at("a:start", START, 1.0), at("a:end", START, 1.0), at("b:start", "a:end", required=True)
    losses = ConvexStrategy().solve(problem(items, *ties)).losses
    assert {(loss.fault.code, loss.required) for loss in losses} == {("too-short", False), ("names-dropped", True)}


def test_a_conflict_of_required_constraints_fails_the_block_although_its_behavior_is_not_required() -> None:
    plan = Plan({"s": SPEECH}, at("s:start", START, 1.0, required=True), at("s:end", START, 4.0, required=True))
    assert [(loss.fault.code, loss.required) for loss in plan.solution.losses] == [("rigid", True)]


def test_a_second_tie_of_a_rigid_behavior_is_dropped_and_the_loss_has_the_gap() -> None:
    plan = Plan({"s": SPEECH}, at("s:start", START, 1.0), at("s:end", START, 4.0))
    assert plan.losses == [("s", "rigid", False)]
    assert plan.solution.losses[0].fault.details["gap"] == pytest.approx(1.0)
    assert plan.times("s") == [1.0, 1.5, 3.0]


def test_a_point_cannot_be_tied_to_two_outer_times() -> None:
    plan = Plan({"n": NOD}, at("n:start", outer("one", 1.0)), at("n:start", outer("two", 1.0)))
    assert plan.losses == [("n", "outer-tie", False)]
    assert plan["n:start"] == 1.0


def test_a_behavior_without_a_duration_is_dropped_alone() -> None:
    plan = Plan({"a": NOD, "b": NOD}, at("a:start", START, 1.0), at("a:end", START, 1.0))
    assert plan.losses == [("a", "too-short", True)]
    assert plan.solution.behaviors == {"b"}


def test_a_tie_to_a_time_before_the_block_is_dropped() -> None:
    plan = Plan({"n": NOD}, at("n:start", outer("hit", -0.5)))
    assert plan.times("n") == pytest.approx([0.0, 0.4, 1.0])
    assert plan.losses == [("n", "clash", False)]
    assert "the start of the block by 0.50 s" in plan.solution.losses[0].fault.sentence


def test_independent_contradictions_are_all_reported() -> None:
    ties = [each for id_ in "abc" for each in (at(f"{id_}:start", START, 1.0), at(f"{id_}:start", START, 2.0))]
    plan = Plan(dict.fromkeys("abc", NOD), *ties)
    assert plan.losses == [(id_, "contradictory-tie", False) for id_ in "abc"]
    assert [plan[f"{id_}:start"] for id_ in "abc"] == [1.0] * 3


@pytest.mark.no_cover  # others cover the same lines, and tracing so many cases takes long
@given(problems(most=12))
def test_the_constraints_that_are_kept_hold_in_any_problem(asked: SchedulingProblem) -> None:
    assert violations(asked, solve(ConvexStrategy(), asked)) == []


@given(feasible_problems())
def test_a_plan_is_found_even_if_the_solver_fails(asked: SchedulingProblem) -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(daqp, "solve", lambda *_, **__: (None, 0.0, -1, {}))
        solution = solve(ConvexStrategy(), asked)
    assert solution.losses == ()
    assert violations(asked, solution) == []


def test_a_long_chain_of_after_constraints_is_planned() -> None:
    items = {f"n{i}": TIMINGS["nod"] for i in range(300)}
    plan = Plan(items, *(after(f"n{i}:start", f"n{i - 1}:end") for i in range(1, 300)))
    assert plan["n299:start"] == pytest.approx(299.0)
