"""SmartBody's scheduling of behaviors that come after others, and of before/after constraints that it does not keep."""

import pytest

from reactive_realizer.scheduler.plan_view import PlanView
from reactive_realizer.scheduler.problem import Origin, Precedence, SchedulingProblem, Tie
from reactive_realizer.scheduler.smartbody.smartbody_strategy import SmartBodyStrategy
from reactive_realizer.testing.problems import TIMINGS, after, at, item, outer, problem
from reactive_realizer.testing.strategy_contract import violations

START = Origin.BLOCK_START
NOD = TIMINGS["nod"]
"""It lasts 1 s, and its stroke comes after 0.4 s."""


def nods(ids: str, *constraints: Tie | Precedence) -> SchedulingProblem:
    return problem([item(id_, NOD) for id_ in ids], *constraints)


def solved(asked: SchedulingProblem) -> tuple[dict[str, float | None], list[str]]:
    """The starts of the behaviors, and the codes of what is lost; what is kept holds."""
    solution = SmartBodyStrategy().solve(asked)
    assert violations(asked, solution) == []
    times = PlanView.of_solution(asked, solution).times
    starts = {point.behavior: time for point, time in times.items() if point.sync == "start"}
    return starts, [loss.fault.code for loss in solution.losses]


@pytest.mark.parametrize(("given", "start"), [(0.5, 1.0), (5.0, 5.0)])
def test_a_behavior_that_no_tie_names_begins_after_the_last_of_several(given: float, start: float) -> None:
    asked = nods("ab", after("b:start", "a:end"), after("b:start", START, given))
    assert solved(asked) == ({"a": 0.0, "b": start}, [])


def test_each_of_several_begins_after_the_one_before_it() -> None:
    asked = nods("abc", after("c:start", "b:end"), after("b:stroke", "a:end"))
    assert solved(asked) == ({"a": 0.0, "b": pytest.approx(0.6), "c": pytest.approx(1.6)}, [])


def test_it_begins_after_a_behavior_that_is_tied_to_others() -> None:
    asked = nods("abc", at("a:stroke", "b:end"), after("c:start", "a:end"))
    starts, losses = solved(asked)
    assert losses == []
    assert starts == {"a": pytest.approx(0.6), "b": 0.0, "c": pytest.approx(1.6)}


def test_it_waits_for_a_time_that_is_not_known() -> None:
    asked = nods("ab", after("b:start", outer("hit", None)), after("b:start", "a:end"))
    assert solved(asked) == ({"a": 0.0, "b": None}, [])


@pytest.mark.parametrize(
    "constraint",
    [after("b:start", "a:end"), after("c:start", "d:end"), after("c:end", "c:start", 3.0)],
    ids=["tied", "behind it", "itself"],
)
def test_other_before_and_after_constraints_are_lost(constraint: Precedence) -> None:
    asked = nods("abcd", at("b:start", START, 0.5), after("d:start", "a:end"), constraint)
    starts, losses = solved(asked)
    assert losses == ["no-order"]
    assert starts == {"a": 0.0, "b": 0.5, "c": 0.0, "d": 1.0}


def test_what_comes_after_a_behavior_that_is_dropped_starts_with_its_block() -> None:
    ties = at("a:start", START, 3.0), at("a:end", START, 3.0)
    asked = nods("ab", *ties, after("b:start", "a:end"))
    assert solved(asked) == ({"b": 0.0}, ["too-short"])
