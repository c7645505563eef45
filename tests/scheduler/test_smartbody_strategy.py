"""SmartBody's scheduling with Elckerlyc's sorting: a problem in, pegs out (thesis 7.2.2, 7.3.5, 8.7.3)."""

import math
from collections.abc import Set as AbstractSet
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.names import BML, Location
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.pegboard.time_peg import AnticipatorPeg, TimeCell
from reactive_realizer.planunit.timing import Phase, PhaseKind, Timing, timing_at
from reactive_realizer.reactive.cell import Source
from reactive_realizer.reactive.graph import Graph
from reactive_realizer.scheduler.peg_layout.peg_layout import PegLayout
from reactive_realizer.scheduler.problem import Item, Node, Origin, Point, SchedulingProblem, Tie
from reactive_realizer.scheduler.smartbody.smartbody_strategy import SmartBodyStrategy

LINE = Location(7, 3)
START = Origin.BLOCK_START
GRAPH = Graph()
NOD = {"start": 0.0, "stroke": 0.4, "end": 1.0}
BEAT = {"start": 0.0, "ready": 0.3, "stroke": 0.5, "relax": 0.8, "end": 1.2}
SPEECH = {"start": 0.0, "sync1": 0.5, "end": 2.0}


def item(id_: str, offsets: dict[str, float], kind: PhaseKind = PhaseKind.ELASTIC) -> Item:
    behavior = Behavior(id=id_, namespace=BML, name="test", location=LINE, order=0)
    return Item(behavior, timing_at(offsets, kind))


def speech(id_: str = "speech1") -> Item:
    return item(id_, SPEECH, PhaseKind.RIGID)


def node(text: str | Node) -> Node:
    return Point(*text.split(":")) if isinstance(text, str) else text


def tie(
    left: str | Point,
    right: str | Node,
    offset: float = 0.0,
    owner: str | None = None,
    required: bool = False,
) -> Tie:
    """``left`` is ``right + offset``; points as ``behavior:sync``."""
    point = Point(*left.split(":")) if isinstance(left, str) else left
    return Tie(point, node(right), offset, owner or point.behavior, LINE, f"{point} = {right} + {offset}", required)


def outer(time: float | None) -> AnticipatorPeg:
    return AnticipatorPeg(GRAPH, "outer", None if time is None else GlobalTime(time))


class Plan:
    """The solution of a problem, as times."""

    def __init__(self, items: list[Item], *ties: Tie) -> None:
        cells = {n for t in ties for n in (t.left, t.right) if isinstance(n, AnticipatorPeg)}
        self.problem = SchedulingProblem(tuple(items), ties, {cell: cell.value for cell in cells})
        self.solution = SmartBodyStrategy().solve(self.problem)
        start: TimeCell = Source(GRAPH, "start", GlobalTime(0.0))
        self.pegs = PegLayout(self.problem, self.solution).build(GRAPH, "b", start).pegs

    def __getitem__(self, point: str) -> float:
        time = self.pegs[Point(*point.split(":"))].value
        assert time is not None
        return time

    @property
    def kept(self) -> AbstractSet[str]:
        return self.solution.behaviors

    @property
    def losses(self) -> list[tuple[str | None, str, bool]]:
        return [(loss.behavior, loss.fault.code, loss.dropped) for loss in self.solution.losses]

    def times(self, behavior: str) -> list[float | None]:
        return [peg.value for point, peg in self.pegs.items() if point.behavior == behavior]


# --- the thesis's examples


@pytest.mark.parametrize("order", [1, -1], ids=["27a", "27b"])
def test_27_a_nod_stretches_to_the_words_in_either_order_because_rigid_behaviors_of_a_cycle_come_first(
    order: int,
) -> None:
    items = [speech(), item("nod1", NOD)][::order]
    plan = Plan(items, tie("nod1:start", "speech1:start"), tie("nod1:end", "speech1:sync1"))
    assert plan.losses == []
    assert plan.times("speech1") == [0.0, 0.5, 2.0]
    assert plan.times("nod1") == pytest.approx([0.0, 0.2, 0.5])


EXAMPLE_28 = (
    tie("nod1:start", START, 3.0),
    tie("nod1:end", START, 5.0),
    tie("beat1:stroke", "nod1:stroke"),
)


def test_28a_a_beat_follows_the_stroke_of_a_nod_between_two_times() -> None:
    plan = Plan([item("nod1", NOD), item("beat1", BEAT)], *EXAMPLE_28)
    assert plan.losses == []
    assert plan.times("nod1") == pytest.approx([3.0, 3.8, 5.0])
    assert plan["beat1:stroke"] == pytest.approx(3.8)
    assert plan["beat1:start"] == pytest.approx(3.3)


def test_28b_in_the_other_order_the_tie_between_them_is_given_up() -> None:
    plan = Plan([item("beat1", BEAT), item("nod1", NOD)], *EXAMPLE_28)
    assert plan.losses == [("beat1", "contradictory-tie", False)]
    assert plan.times("beat1") == pytest.approx(list(BEAT.values()))
    assert plan.times("nod1") == pytest.approx([3.0, 3.8, 5.0])


EXAMPLE_29 = (
    tie("g2:start", "g1:end"),
    tie("nod1:start", "g1:start", -2.0),
    tie("nod1:end", "g2:end", 3.0),
)


def test_29a_a_cycle_of_ties_with_offsets_is_met_if_the_nod_comes_last() -> None:
    plan = Plan([item("g1", BEAT), item("g2", BEAT), item("nod1", NOD)], *EXAMPLE_29)
    assert plan.losses == []
    assert (plan["nod1:start"], plan["g1:start"]) == pytest.approx((0.0, 2.0))
    assert plan["g2:start"] == pytest.approx(plan["g1:end"])
    assert plan["nod1:end"] == pytest.approx(plan["g2:end"] + 3.0)


def test_29b_a_tie_is_given_up_if_the_nod_comes_first() -> None:
    plan = Plan([item("nod1", NOD), item("g1", BEAT), item("g2", BEAT)], *EXAMPLE_29)
    assert plan.losses == [("nod1", "contradictory-tie", False)]
    assert (plan["nod1:start"], plan["g1:start"]) == pytest.approx((0.0, 2.0))
    assert plan["g2:start"] == pytest.approx(plan["g1:end"])


# --- times of points


def test_a_behavior_without_ties_starts_with_its_block_and_has_its_preferred_duration() -> None:
    assert Plan([item("g", BEAT)]).times("g") == list(BEAT.values())


def test_phases_between_two_ties_stretch_by_the_same_factor() -> None:
    plan = Plan([item("g", BEAT)], tie("g:start", START, 1.0), tie("g:end", START, 1.0 + 2 * 1.2))
    assert plan.times("g") == pytest.approx([1.0 + 2 * time for time in BEAT.values()])


def test_phases_outside_of_two_ties_stretch_by_the_average_factor() -> None:
    plan = Plan([item("g", BEAT)], tie("g:ready", START, 1.0), tie("g:relax", START, 2.0))
    assert plan.times("g") == pytest.approx([1 - 0.3 * 2, 1.0, 1.4, 2.0, 2.0 + 0.4 * 2])


def test_rigid_phases_outside_of_two_ties_keep_their_durations() -> None:
    phases = Phase(0.5, PhaseKind.RIGID), Phase(1.0), Phase(0.5, PhaseKind.RIGID)
    loose = Item(item("s", NOD).behavior, Timing(("start", "word1", "word2", "end"), phases))
    plan = Plan([loose], tie("s:word1", START, 1.0), tie("s:word2", START, 2.2))
    assert plan.times("s") == pytest.approx([0.5, 1.0, 2.2, 2.7])


def test_each_part_between_three_ties_has_its_own_factor_and_phases_outside_have_the_average() -> None:
    plan = Plan(
        [item("g", BEAT)],
        tie("g:ready", START, 1.0),
        tie("g:stroke", START, 1.1),
        tie("g:relax", START, 2.0),
    )
    assert plan.times("g") == pytest.approx([0.4, 1.0, 1.1, 2.0, 2.8])


def test_one_tie_moves_a_behavior_as_a_whole() -> None:
    plan = Plan([item("g", BEAT)], tie("g:stroke", START, 2.0))
    assert plan.times("g") == pytest.approx([1.5 + time for time in BEAT.values()])


def test_an_offset_is_the_distance_from_the_other_point() -> None:
    plan = Plan([item("a", NOD), item("b", NOD)], tie("b:start", "a:end", 0.25))
    assert plan["b:start"] == plan["a:end"] + 0.25


def test_points_of_one_behavior_may_be_tied_to_each_other() -> None:
    plan = Plan([item("a", BEAT)], tie("a:end", "a:start", 2.4))
    assert plan.times("a") == pytest.approx([2 * time for time in BEAT.values()])


def test_each_cluster_starts_with_the_block() -> None:
    ties = tie("b:end", "a:start"), tie("c:start", "d:end", 1.0)
    plan = Plan([item(name, NOD) for name in "abcd"], *ties)
    assert (plan["b:start"], plan["a:start"]) == pytest.approx((0.0, 1.0))
    assert (plan["d:start"], plan["c:start"]) == pytest.approx((0.0, 2.0))


def test_a_cluster_with_a_given_time_is_not_moved() -> None:
    plan = Plan([item("a", NOD), item("b", NOD)], tie("b:start", "a:end"), tie("b:end", START, 10.0))
    assert (plan["a:start"], plan["b:start"], plan["b:end"]) == pytest.approx((0.0, 1.0, 10.0))


def test_a_behavior_that_would_start_before_its_block_is_shortened() -> None:
    plan = Plan([item("g", BEAT)], tie("g:stroke", START, 0.25))
    assert plan.times("g") == pytest.approx([time / 2 for time in BEAT.values()])


def test_a_speech_that_would_start_before_its_block_loses_its_tie() -> None:
    plan = Plan([speech()], tie("speech1:sync1", START, 0.25))
    assert plan.losses == [("speech1", "too-hurried", False)]
    assert plan.times("speech1") == [0.0, 0.5, 2.0]


def test_a_speech_without_a_given_time_waits_for_a_gesture_that_starts_later() -> None:
    plan = Plan([speech(), item("g", BEAT)], tie("g:start", START, 0.2), tie("g:stroke", "speech1:start"))
    assert plan.losses == []
    assert plan.times("g") == pytest.approx([0.2 + time for time in BEAT.values()])
    assert plan["speech1:start"] == pytest.approx(plan["g:stroke"])


def test_a_behavior_keeps_its_tie_to_one_that_loses_a_tie() -> None:
    ties = tie("speech1:start", START), tie("g:start", START, 0.2), tie("g:stroke", "speech1:start")
    plan = Plan([speech(), item("g", BEAT), item("n", NOD)], *ties, tie("n:stroke", "g:stroke"))
    assert plan.losses == [("g", "contradictory-tie", False)]
    assert plan["n:stroke"] == plan["g:stroke"] == pytest.approx(0.7)


def test_a_tie_that_is_not_required_is_given_up_before_one_that_is() -> None:
    ties = tie("g:start", START, 3.0), tie("g:end", START, 2.0, required=True)
    plan = Plan([item("g", BEAT)], *ties)
    assert plan.losses == [("g", "contradictory-tie", False)]
    assert plan["g:end"] == 2.0


def test_points_that_depend_on_an_unknown_time_are_unknown() -> None:
    hit = outer(None)
    plan = Plan([item("g", BEAT), item("h", NOD)], tie("g:stroke", hit), tie("h:start", "g:end"))
    assert plan.losses == []
    assert plan.times("g") == [None] * len(BEAT)
    assert plan.times("h") == [None] * len(NOD)


def test_a_free_behavior_that_ends_with_an_unknown_time_does_not_start_before_its_block() -> None:
    go, hit = outer(None), outer(0.75)
    nod, free = item("nod", {"start": 0.0, "end": 0.5}), item("free", {"start": 0.0, "end": 0.5}, PhaseKind.FREE)
    plan = Plan([nod, free], tie("nod:end", hit), tie("nod:start", go), tie("free:end", go, -0.2))
    assert plan.losses == []
    assert plan["free:start"] == 0.0


def test_a_behavior_tied_to_an_outer_time_follows_it() -> None:
    hit = outer(2.0)
    plan = Plan([item("g", BEAT)], tie("g:stroke", hit, 0.5))
    assert plan["g:start"] == 2.0
    with GRAPH.transaction("test"):
        hit.set(GlobalTime(3.0))
    assert plan["g:start"] == 3.0


def test_a_tie_to_a_past_point_is_given_up() -> None:
    plan = Plan([item("g", NOD)], tie("g:start", outer(-1.5)))
    assert plan.losses == [("g", "clash", False)]
    assert plan["g:start"] == 0.0


# --- conflicts


def test_a_cycle_of_consistent_ties_is_legal() -> None:
    ties = (
        tie("b:start", "a:end"),
        tie("a:end", "b:start"),
        tie("b:start", "a:start", 1.0),
        tie("a:end", "a:start", 1.0),
    )
    plan = Plan([item("a", NOD), item("b", NOD)], *ties)
    assert plan.losses == []
    assert plan["b:start"] == pytest.approx(plan["a:end"])


def test_a_contradictory_tie_is_dropped_and_reported_and_the_others_hold() -> None:
    ties = tie("b:start", "a:end"), tie("a:end", "b:start", 0.5, owner="a", required=True)
    plan = Plan([item("a", NOD), item("b", NOD)], *ties)
    assert plan.losses == [("a", "contradictory-tie", False)]
    (loss,) = plan.solution.losses
    assert loss.required
    assert loss.fault.details["gap"] == pytest.approx(0.5)
    assert plan["b:start"] == pytest.approx(plan["a:end"])


def test_a_point_cannot_be_tied_to_two_outer_times() -> None:
    one, two = outer(1.0), outer(2.0)
    plan = Plan([item("a", NOD)], tie("a:start", one), tie("a:start", two))
    assert plan.losses == [("a", "outer-tie", False)]
    assert plan["a:start"] == 1.0


def test_a_tie_that_a_rigid_behavior_cannot_meet_is_dropped_and_the_loss_has_the_gap() -> None:
    plan = Plan([speech()], tie("speech1:start", START, 1.0), tie("speech1:end", START, 4.0))
    assert plan.losses == [("speech1", "rigid", False)]
    assert plan.solution.losses[0].fault.details["gap"] == pytest.approx(1.0)
    assert plan.times("speech1") == [1.0, 1.5, 3.0]


def test_ties_of_a_rigid_behavior_hold_when_clusters_are_moved() -> None:
    ties = tie("nod:end", "speech1:end", -0.5), tie("speech1:sync1", "beat:start")
    plan = Plan([item("nod", NOD), item("beat", BEAT), speech()], *ties)
    assert plan.losses == []
    assert plan["nod:end"] == pytest.approx(plan["speech1:end"] - 0.5)
    assert plan["speech1:sync1"] == pytest.approx(plan["beat:start"])


def test_a_rigid_behavior_cannot_be_tied_to_two_times_if_one_is_unknown() -> None:
    plan = Plan([speech()], tie("speech1:start", outer(None)), tie("speech1:end", START, 9.0))
    assert plan.losses == [("speech1", "outer-tie", False)]
    hit = outer(None)
    plan = Plan([speech()], tie("speech1:start", hit), tie("speech1:end", hit, 2.0))
    assert plan.losses == []


def test_a_behavior_with_points_out_of_order_loses_the_tie_of_the_later_one() -> None:
    plan = Plan([item("g", BEAT), item("h", NOD)], tie("g:start", START, 3.0), tie("g:end", START, 2.0))
    assert plan.losses == [("g", "contradictory-tie", False)]
    assert plan.solution.losses[0].fault.details["gap"] == pytest.approx(1.0)
    assert plan["g:start"] == 3.0


def test_a_behavior_without_a_duration_is_dropped() -> None:
    assert Plan([item("g", BEAT)], tie("g:start", START, 3.0), tie("g:end", START, 3.0)).losses == [
        ("g", "too-short", True)
    ]


def test_a_tie_to_a_time_before_the_block_is_given_up() -> None:
    plan = Plan([item("g", BEAT)], tie("g:start", START, -1.0))
    assert plan.losses == [("g", "clash", False)]
    assert plan.solution.losses[0].fault.details["gap"] == pytest.approx(1.0)
    assert plan["g:start"] == 0.0


# --- any problem


_SYNCS = {"nod": list(NOD), "beat": list(BEAT), "speech": list(SPEECH)}
_OFFSETS = {"nod": NOD, "beat": BEAT, "speech": SPEECH}


@st.composite
def problems(draw: st.DrawFn) -> tuple[list[Item], list[Tie]]:
    """Up to seven behaviors with ties to each other, the start of the block and outer times, usually in conflict."""
    kinds = draw(st.lists(st.sampled_from(sorted(_OFFSETS)), min_size=1, max_size=7))
    items = [
        item(f"{kind}{i}", _OFFSETS[kind], PhaseKind.RIGID if kind == "speech" else PhaseKind.ELASTIC)
        for i, kind in enumerate(kinds)
    ]
    points = [Point(each.behavior.id, sync) for each in items for sync in each.timing.points]
    outside = [outer(draw(st.sampled_from([None, -0.5, 0.0, 1.0, 4.0]))) for _ in range(2)]
    nodes: list[Node] = [*points, START, *outside]
    rights = st.sampled_from(nodes)
    offsets = st.sampled_from([0.0, 0.0, 0.5, 1.0, -0.5, 3.0])
    drawn = draw(st.lists(st.tuples(st.sampled_from(points), rights, offsets), max_size=8))
    return items, [tie(left, right, offset) for left, right, offset in drawn]


@given(problems())
def test_kept_behaviors_have_their_points_in_order_keep_their_ties_and_start_within_the_block(
    drawn: tuple[list[Item], list[Tie]],
) -> None:
    items, ties = drawn
    plan = Plan(items, *ties)
    assert {(loss.fault.line, loss.fault.column) for loss in plan.solution.losses} <= {(7, 3)}
    lost = {loss for loss, _, dropped in plan.losses if dropped}
    assert plan.kept == {each.behavior.id for each in items} - lost
    forgiven = {loss.behavior for loss in plan.solution.losses if not loss.dropped}
    hanging = hanging_on_outside(ties)
    for id_ in plan.kept:
        known = [time for time in plan.times(id_) if time is not None]
        assert all(a <= b + 1e-5 for a, b in pairwise(known)), "thesis 7.15"
        assert id_ in hanging or not known or known[0] >= -2e-5, "before its block"
    for each in ties:
        sides = [side for side in (each.left, each.right) if isinstance(side, Point)]
        if any(side.behavior not in plan.kept or side.behavior in forgiven for side in sides):
            continue
        left, right = value(plan, each.left), value(plan, each.right)
        if left is not None and right is not None:
            assert math.isclose(left, right + each.offset, abs_tol=1e-6), each.text


def value(plan: Plan, side: Node) -> float | None:
    if isinstance(side, Point):
        return plan.pegs[side].value
    return 0.0 if isinstance(side, Origin) else side.value


def hanging_on_outside(ties: list[Tie]) -> set[str]:
    """Behaviors that outer times may move before the start of their block."""
    hanging: set[str] = set()
    for _ in ties:
        for each in ties:
            sides = [side.behavior for side in (each.left, each.right) if isinstance(side, Point)]
            if isinstance(each.right, AnticipatorPeg) or hanging & set(sides):
                hanging |= set(sides)
    return hanging


@pytest.mark.no_cover  # others cover the same lines, and tracing so many cases takes long
@given(problems())
def test_the_same_problem_has_the_same_plan(drawn: tuple[list[Item], list[Tie]]) -> None:
    items, ties = drawn
    one, two = Plan(items, *ties), Plan(items, *ties)
    assert {id_: one.times(id_) for id_ in one.kept} == {id_: two.times(id_) for id_ in two.kept}
