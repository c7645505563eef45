"""The contract of scheduling strategies: pytest classes to inherit from; needs pytest and Hypothesis."""

from collections.abc import Callable
from math import isfinite
from typing import ClassVar

import pytest
from hypothesis import given

from reactive_realizer.scheduler.plan_view import PlanView
from reactive_realizer.scheduler.problem import Origin, Point, SchedulingProblem
from reactive_realizer.scheduler.solution import Solution
from reactive_realizer.scheduler.strategy import SchedulingStrategy, solve
from reactive_realizer.scheduler.verify import Violation, verify
from reactive_realizer.testing.contract_settings import inherited
from reactive_realizer.testing.problems import (
    TIMINGS,
    after,
    at,
    feasible_problems,
    item,
    outer,
    peg_times,
    problem,
    problems,
)

_MANY = 1_000
_OF_CONSTRAINTS = ("contradictory-tie", "outer-tie", "rigid", "no-order", "names-dropped")
"""Codes of losses of constraints; none of them may report the loss of a behavior."""


def violations(asked: SchedulingProblem, solution: Solution) -> list[Violation]:
    """The equations that a solution violates."""
    return verify(PlanView.of_solution(asked, solution))


def _what_it_kept_holds(asked: SchedulingProblem, solution: Solution) -> None:
    assert violations(asked, solution) == []


def _every_behavior_is_kept_with_all_its_points_or_lost(asked: SchedulingProblem, solution: Solution) -> None:
    dropped = [loss.behavior or "" for loss in solution.losses if loss.dropped]
    assert sorted([*dropped, *solution.behaviors]) == sorted(each.behavior.id for each in asked.items)
    for each in asked.items:
        points = tuple(point.sync for point in solution.times if point.behavior == each.behavior.id)
        assert points in ((), each.timing.points)


def _losing_what_is_required_is_marked(asked: SchedulingProblem, solution: Solution) -> None:
    required = {each.behavior.id for each in asked.items if each.behavior.required}
    for loss in solution.losses:
        needed = loss.behavior in required if loss.constraint is None else loss.constraint.required
        assert loss.required or not needed, loss


def _every_loss_has_a_reason_and_a_place(asked: SchedulingProblem, solution: Solution) -> None:
    for loss in solution.losses:
        assert loss.fault.sentence
        assert loss.fault.line == 1


def _a_lost_behavior_is_not_reported_as_a_lost_constraint(asked: SchedulingProblem, solution: Solution) -> None:
    for loss in solution.losses:
        assert not loss.dropped or (loss.constraint is None and loss.fault.code not in _OF_CONSTRAINTS), loss


def _every_time_is_a_number(asked: SchedulingProblem, solution: Solution) -> None:
    assert all(map(isfinite, solution.times.values()))


def _pegs_lie_at_the_times_of_the_plan(asked: SchedulingProblem, solution: Solution) -> None:
    """They are unknown where the plan waits."""
    view = PlanView.of_solution(asked, solution)
    assert peg_times(asked, solution) == {
        point: None if time is None else pytest.approx(time, abs=1e-6) for point, time in view.times.items()
    }


_LAWS: tuple[Callable[[SchedulingProblem, Solution], None], ...] = (
    _what_it_kept_holds,
    _every_behavior_is_kept_with_all_its_points_or_lost,
    _losing_what_is_required_is_marked,
    _every_loss_has_a_reason_and_a_place,
    _a_lost_behavior_is_not_reported_as_a_lost_constraint,
    _every_time_is_a_number,
    _pegs_lie_at_the_times_of_the_plan,
)
"""Of a plan of any problem, whether or not all of it can be kept."""


class StrategyContract:
    """Tests of any strategy: every loss is reported, and all constraints that are not reported as lost hold.

    Attributes:
        strategy: under test; set by the inheriting class.
    """

    strategy: ClassVar[SchedulingStrategy]

    @inherited
    @given(feasible_problems())
    def test_what_it_says_it_kept_of_what_can_be_kept_holds(self, asked: SchedulingProblem) -> None:
        assert violations(asked, solve(self.strategy, asked)) == []

    @inherited
    @given(problems())
    def test_a_plan_of_any_problem_keeps_every_law(self, asked: SchedulingProblem) -> None:
        solution = solve(self.strategy, asked)
        for law in _LAWS:
            law(asked, solution)
        assert solve(self.strategy, asked) == solution, "the same problem has the same plan"

    def test_a_behavior_that_contradicts_itself_loses_one_constraint_or_is_lost(self) -> None:
        start = Origin.BLOCK_START
        asked = problem([item("n", TIMINGS["nod"])], at("n:start", start, 1.0), at("n:end", start, 0.2))
        solution = solve(self.strategy, asked)
        (loss,) = solution.losses
        assert loss.behavior == "n"
        assert loss.dropped is ("n" not in solution.behaviors)

    def test_an_empty_block_is_planned(self) -> None:
        assert solve(self.strategy, problem([])) == Solution({}, ())

    def test_what_is_tied_to_nothing_starts_with_its_block_and_takes_the_time_it_wants(self) -> None:
        asked = problem([item(kind, timing) for kind, timing in TIMINGS.items()])
        times = solve(self.strategy, asked).times
        for kind, timing in TIMINGS.items():
            assert [times[Point(kind, sync)] for sync in timing.points] == pytest.approx(timing.offsets)

    def test_what_is_tied_to_an_unknown_time_waits_for_it(self) -> None:
        asked = problem([item("g", TIMINGS["beat"]), item("n", TIMINGS["nod"])], at("g:stroke", outer("hit", None)))
        times = PlanView.of_solution(asked, solve(self.strategy, asked)).times
        assert times[Point("g", "start")] is times[Point("g", "stroke")] is times[Point("g", "end")] is None
        assert times[Point("n", "start")] == 0.0

    def test_what_ends_with_the_start_of_a_waiting_behavior_starts_with_its_block(self) -> None:
        change, hit = TIMINGS["change"], outer("hit", None)
        asked = problem([item("c", change), item("d", change)], at("c:start", hit, -1.0), at("d:end", "c:start"))
        times = PlanView.of_solution(asked, solve(self.strategy, asked)).times
        assert times[Point("d", "start")] == 0.0

    def test_a_phase_from_a_waiting_behavior_to_a_known_time_is_as_long_as_the_body_needs(self) -> None:
        ties = at("n:end", outer("hit", None)), at("r:start", "n:start"), at("r:ready", Origin.BLOCK_START)
        asked = problem([item("n", TIMINGS["nod"]), item("r", TIMINGS["reach"])], *ties)
        assert violations(asked, solve(self.strategy, asked)) == []

    def test_many_behaviors_each_after_the_one_before_it_are_planned_in_any_order(self) -> None:
        items = [item(f"n{i}", TIMINGS["nod"]) for i in range(_MANY)]
        ties = [at(f"n{i}:start", f"n{i - 1}:end") for i in range(1, _MANY)]
        for asked in (problem(items, *ties), problem(items[::-1], *ties[::-1])):
            solution = solve(self.strategy, asked)
            assert solution.losses == ()
            assert violations(asked, solution) == []


class CompleteStrategyContract(StrategyContract):
    """Tests of a strategy that satisfies all feasible constraints, in whatever order a block is written."""

    @inherited
    @given(feasible_problems())
    def test_what_can_be_met_is_met(self, asked: SchedulingProblem) -> None:
        assert solve(self.strategy, asked).losses == ()

    @inherited
    @given(problems())
    def test_the_order_of_behaviors_and_constraints_changes_nothing(self, asked: SchedulingProblem) -> None:
        turned = SchedulingProblem(asked.items[::-1], asked.ties[::-1], asked.times, asked.orders[::-1])
        one, two = solve(self.strategy, asked), solve(self.strategy, turned)
        assert one.times == two.times
        assert sorted(str(loss.fault) for loss in one.losses) == sorted(str(loss.fault) for loss in two.losses)

    def test_what_is_after_an_unknown_time_waits_for_it(self) -> None:
        asked = problem([item("n", TIMINGS["nod"])], after("n:start", outer("hit", None)))
        assert PlanView.of_solution(asked, solve(self.strategy, asked)).times[Point("n", "start")] is None
