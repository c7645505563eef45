"""EMBR's scheduling: the least sum of deviations in seconds under before/after constraints (thesis 7.2.3)."""

from itertools import pairwise

import pytest

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.pegboard.time_peg import AnticipatorPeg
from reactive_realizer.planunit.timing import Phase, PhaseKind, Timing, timing_at
from reactive_realizer.scheduler.embr.differences import Differences, Row, Unmet
from reactive_realizer.scheduler.embr.embr_strategy import EmbrStrategy
from reactive_realizer.scheduler.plan_view import PlanView
from reactive_realizer.scheduler.problem import Origin, Point, Precedence, Tie
from reactive_realizer.scheduler.strategy import solve
from reactive_realizer.testing.problems import TIMINGS, after, at, item, outer, peg_times, pegs_of, problem
from reactive_realizer.testing.strategy_contract import violations

START = Origin.BLOCK_START
NOD, BEAT, SPEECH, CHANGE = TIMINGS["nod"], TIMINGS["beat"], TIMINGS["speech"], TIMINGS["change"]


class Plan:
    """The solution of a problem as times, checked against the equations of the thesis."""

    def __init__(self, items: dict[str, Timing], *constraints: Tie | Precedence) -> None:
        asked = problem([item(id_, timing) for id_, timing in items.items()], *constraints)
        self.solution = solve(EmbrStrategy(), asked)
        self.view = PlanView.of_solution(asked, self.solution)
        self.timings = items
        assert violations(asked, self.solution) == []

    def __getitem__(self, point: str) -> float:
        time = self.view.times[Point(*point.split(":"))]
        assert time is not None
        return time

    def times(self, behavior: str) -> list[float]:
        return [self[f"{behavior}:{sync}"] for sync in self.timings[behavior].points]

    @property
    def losses(self) -> list[tuple[str | None, str]]:
        return [(loss.behavior, loss.fault.code) for loss in self.solution.losses]

    @property
    def deviation(self) -> float:
        """The sum of the deviations from preferred durations, s."""
        total = 0.0
        for id_, timing in self.timings.items():
            times = self.times(id_)
            durations = [b - a for a, b in pairwise(times)]
            total += sum(abs(d - phase.duration) for d, phase in zip(durations, timing.phases, strict=True))
        return total


# --- the program


def test_pegs_keep_the_duration_of_a_phase_that_prefers_none() -> None:
    """A nod without the time to move is played in `SHORTEST`, here between its start and its strokeStart."""
    names = ("start", "strokeStart", "stroke", "strokeEnd", "end")
    nod = timing_at(dict(zip(names, (0.0, 0.0, 0.35, 0.7, 0.7), strict=True)))
    squeezed = [at("n:strokeEnd", START, 0.3), at("s:stroke", START, 0.5), at("s:end", "n:strokeStart", 0.2)]
    asked = problem([item("n", nod), item("s", nod)], *squeezed)
    solution = solve(EmbrStrategy(), asked)
    pegs = peg_times(asked, solution)
    assert 0.0 < solution.times[Point("n", "strokeStart")] - solution.times[Point("n", "start")] < 1e-4
    assert pegs == {point: pytest.approx(time, abs=1e-7) for point, time in solution.times.items()}


def test_behaviors_have_their_preferred_durations_if_possible() -> None:
    plan = Plan({"g": BEAT, "n": NOD}, at("g:stroke", "n:stroke"), at("n:start", START, 2.0))
    assert plan.deviation == pytest.approx(0.0, abs=1e-9)


def test_the_total_deviation_is_the_least_possible() -> None:
    # One behavior may shrink by 1 s, or both by 1 s together.
    ties = at("b:start", "a:end"), at("a:start", START), at("b:end", START, 3.0)
    assert Plan({"a": NOD, "b": NOD}, *ties).deviation == pytest.approx(1.0)


def test_among_equally_good_plans_the_deviation_is_spread() -> None:
    long = timing_at({"start": 0.0, "end": 3.0})
    plan = Plan({"a": NOD, "b": long}, at("b:start", "a:end"), at("a:start", START), at("b:end", START, 6.0))
    assert plan["a:end"] == pytest.approx(1.5)
    assert plan["a:stroke"] == pytest.approx(0.6)


def test_among_equally_good_plans_stretching_is_preferred_to_shrinking_to_zero() -> None:
    ties = at("g2:start", "g1:end"), at("n:start", "g1:start", -2.0), at("n:end", "g2:end", 3.0)
    plan = Plan({"g1": BEAT, "g2": BEAT, "n": NOD}, *ties)
    assert plan.deviation == pytest.approx(5.0 + 2 * 1.1 - 1.0)
    assert plan["g1:end"] - plan["g1:start"] > 0.9


def test_extra_time_goes_where_it_causes_the_least_deviation() -> None:
    # Shrinking the one behavior costs its seconds once, stretching the other two costs them twice.
    ties = at("b:start", "a:start"), at("c:start", "a:start"), at("b:end", "c:end"), at("a:end", "b:end")
    assert Plan({"a": timing_at({"start": 0.0, "end": 2.0}), "b": NOD, "c": NOD}, *ties).deviation == pytest.approx(1.0)


def test_holds_are_as_stiff_as_strokes_and_limits_have_no_effect() -> None:
    limited = Timing(("start", "end"), (Phase(1.0, PhaseKind.ELASTIC, 0.9, 1.1),))
    plan = Plan({"a": limited}, at("a:start", START), at("a:end", START, 2.0))
    assert plan.losses == []
    plan = Plan({"g": TIMINGS["gaze"]}, at("g:start", START), at("g:end", START, 4.0))
    assert plan.times("g") == pytest.approx([0.0, 0.5, 3.5, 4.0])


# --- clusters


def test_clusters_without_a_given_time_start_with_the_block() -> None:
    plan = Plan({"a": NOD, "b": BEAT, "c": NOD}, at("c:start", "b:start", -0.5))
    assert (plan["a:start"], plan["c:start"], plan["b:start"]) == pytest.approx((0.0, 0.0, 0.5))


def test_clusters_with_after_constraints_start_as_early_as_possible() -> None:
    plan = Plan({"a": NOD, "b": BEAT}, after("b:stroke", "a:end", 0.5), after("a:start", START, 1.0))
    assert plan["a:start"] == pytest.approx(1.0)
    assert plan["b:stroke"] == pytest.approx(2.5)
    assert plan.deviation == pytest.approx(0.0, abs=1e-9)


def test_a_before_constraint_is_an_after_constraint_with_its_points_exchanged() -> None:
    plan = Plan({"a": NOD, "b": NOD}, after("b:start", "a:end"), after(START, "b:end", -1.5))
    assert plan.losses == []
    assert plan["b:end"] == pytest.approx(1.5)
    assert plan.deviation == pytest.approx(0.5)


def moved(
    point: str, hit: AnticipatorPeg, moves: tuple[float | None, ...], *constraints: Precedence | Tie
) -> list[float | None]:
    """The times of a point of a nod while an outer time moves; nothing is solved again."""
    asked = problem([item("n", NOD)], *constraints)
    solution = EmbrStrategy().solve(asked)
    assert solution.losses == ()
    peg = pegs_of(asked, solution)[Point(*point.split(":"))]
    times: list[float | None] = []
    for time in moves:
        with hit.graph.transaction("test"):
            hit.set(None if time is None else GlobalTime(time))
        times.append(peg.value)
    return times


def test_a_cluster_with_an_after_constraint_follows_an_outer_time() -> None:
    hit = outer("hit", 3.0)
    strokes = moved("n:stroke", hit, (0.0, 3.0, 5.0, None), after("n:stroke", hit))
    assert strokes == [pytest.approx(0.4), 3.0, 5.0, None]


def test_a_point_of_a_behavior_with_a_given_time_follows_an_outer_time_too() -> None:
    hit = outer("hit", 1.0)
    grounded = at("n:start", START, 1.0)
    assert moved("n:end", hit, (0.0, 3.0, 5.0, None), grounded, after("n:end", hit)) == [2.0, 3.0, 5.0, None]


def test_a_before_constraint_holds_until_its_bound_moves_before_a_fixed_point() -> None:
    for grounded in ([at("n:start", START, 1.0)], [after("n:start", START, 1.0)]):
        hit = outer("hit", 3.0)
        ends = moved("n:end", hit, (3.0, 1.5, None, 0.9, -1.0), *grounded, after(hit, "n:end"))
        assert ends == [2.0, 1.5, 2.0, 2.0, 2.0]


def test_clusters_that_wait_for_each_other_are_planned() -> None:
    plan = Plan({"a": NOD, "b": NOD}, after("a:end", "b:stroke"), after("b:end", "a:stroke", 0.5))
    assert plan.losses == []


# --- conflicts


def test_before_and_after_constraints_are_dropped_before_ties() -> None:
    plan = Plan({"a": NOD, "b": NOD}, after("a:start", "b:end"), at("b:start", "a:end"))
    assert plan.losses == [(None, "contradictory-tie")]
    (loss,) = plan.solution.losses
    assert loss.constraint
    assert loss.constraint.text == "a:start after b:end + 0"
    assert plan["b:start"] == plan["a:end"]


def test_required_constraints_are_dropped_last_and_among_them_the_last_by_name_first() -> None:
    ties = at("a:start", "b:end"), at("a:start", START, 0.5, required=True), at("b:start", START, 1.0)
    assert Plan({"a": NOD, "b": NOD}, *ties).losses == [("b", "contradictory-tie")]
    plan = Plan({"a": NOD, "b": NOD, "c": NOD}, at("a:end", "c:end"), at("b:end", "a:start"), at("c:end", "b:start"))
    assert plan.losses == [("c", "contradictory-tie")]


def test_a_clash_has_its_gap_in_seconds() -> None:
    plan = Plan({"s": SPEECH}, at("s:start", START, 1.0), at("s:end", START, 4.0))
    assert plan.losses == [("s", "contradictory-tie")]
    assert plan.times("s") == [2.0, 2.5, 3.25, 4.0]
    assert plan.solution.losses[0].fault.details["gap"] == pytest.approx(1.0)


def test_a_behavior_that_contradicts_itself_is_dropped_and_the_others_play() -> None:
    plan = Plan({"a": NOD, "b": NOD}, at("a:start", START, 3.0), at("a:end", START, 3.0), at("b:start", "a:end"))
    assert plan.losses == [("a", "self-contradictory")]
    assert plan.times("b") == pytest.approx([0.0, 0.4, 1.0])


def test_a_rigid_behavior_cannot_be_tied_to_two_outer_times() -> None:
    plan = Plan({"s": SPEECH}, at("s:start", outer("one", 1.0)), at("s:end", outer("two", 3.0)))
    assert plan.losses == [("s", "outer-tie")]


def test_a_behavior_tied_to_a_dropped_one_starts_as_early_as_possible() -> None:
    plan = Plan({"g": TIMINGS["gaze"], "n": NOD}, at("g:relax", outer("hit", -0.5)), at("n:start", "g:start", 3.0))
    assert plan.losses == [("g", "self-contradictory")]
    assert plan["n:start"] == 0.0


def test_a_behavior_without_a_duration_is_dropped_unless_it_is_an_event() -> None:
    nothing = Timing(("start", "end"), (Phase(0.0, PhaseKind.RIGID),))
    plan = Plan({"w": nothing, "e": TIMINGS["event"], "n": NOD}, at("n:start", "w:end"), at("n:end", "e:start"))
    assert plan.losses == [("w", "too-short")]
    assert plan["e:start"] == plan["e:end"] == plan["n:end"] == 1.0


# --- free behaviors


def test_a_free_behavior_fills_the_time_between_others_without_moving_them() -> None:
    items = {"a": NOD, "b": NOD, "c": CHANGE}
    plan = Plan(
        items, at("a:start", START, 1.0), at("b:start", START, 5.0), at("c:start", "a:end"), at("c:end", "b:start")
    )
    assert plan.times("c") == pytest.approx([2.0, 5.0])
    plan = Plan({"a": NOD, "b": NOD, "c": CHANGE}, at("c:start", "a:end"), at("c:end", "b:start"))
    assert plan["b:start"] == 0.0
    assert plan.losses == [("c", "self-contradictory")]


# --- the system of rows


def test_adding_contradictory_rows_changes_nothing_and_gives_the_rows_that_contradict_each_other() -> None:
    system = Differences({"start": 0.0, "a": 0.0, "b": 0.0}, ["start"])
    assert system.add(Row("a", "start", 1.0), Row("b", "a", 2.0)) is None
    assert (system["a"], system["b"]) == (1.0, 3.0)
    rows = Row("b", "a", 4.0), Row("a", "b", -3.0)
    assert system.add(*rows) == Unmet(rows, 1.0)
    assert (system["a"], system["b"]) == (1.0, 3.0)
    chain = Row("start", "b", -2.5), Row("b", "a", 2.0), Row("a", "start", 1.0)
    assert system.add(chain[0]) == Unmet(chain, 0.5)
    assert system.add(Row("a", "b", -3.0)) is None
