"""Random scheduling problems for tests of strategies; needs Hypothesis."""

import itertools
from collections.abc import Mapping, Sequence
from types import MappingProxyType

from hypothesis import strategies as st

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.names import BML, Location
from reactive_realizer.clock.units import GlobalTime, Time
from reactive_realizer.pegboard.time_peg import AnticipatorPeg, TimeCell, TimePeg
from reactive_realizer.planunit.timing import Phase, PhaseKind, Timing, timing_at
from reactive_realizer.reactive.cell import Source
from reactive_realizer.reactive.graph import Graph
from reactive_realizer.scheduler.offset_union_find import TIE_TOLERANCE, OffsetUnionFind
from reactive_realizer.scheduler.peg_layout.peg_layout import PegLayout
from reactive_realizer.scheduler.problem import Item, Node, Origin, Point, Precedence, SchedulingProblem, Tie
from reactive_realizer.scheduler.solution import Solution

_PLACE = Location(1, 1)
_GRAPH = Graph()
_ELASTIC, _HOLD = PhaseKind.ELASTIC, PhaseKind.HOLD

TIMINGS: Mapping[str, Timing] = MappingProxyType(
    {
        "nod": timing_at({"start": 0.0, "stroke": 0.4, "end": 1.0}),
        "beat": Timing(
            ("start", "ready", "strokeStart", "stroke", "strokeEnd", "relax", "end"),
            (
                Phase(0.3),
                Phase(0.0, _HOLD),
                Phase(0.2),
                Phase(0.1),
                Phase(0.0, _HOLD),
                Phase(0.5, _ELASTIC, 0.25, 1.0),
            ),
        ),
        "gaze": Timing(("start", "ready", "relax", "end"), (Phase(0.25), Phase(1.5, _HOLD), Phase(0.25))),
        "reach": Timing(
            ("start", "ready", "stroke", "relax", "end"),
            (Phase(0.5, shortest=0.25), Phase(0.2, shortest=0.1), Phase(0.75, _HOLD), Phase(0.5)),
        ),
        "shake": timing_at({"start": 0.0, "strokeStart": 0.0, "stroke": 0.35, "strokeEnd": 0.7, "end": 0.7}),
        "speech": timing_at({"start": 0.0, "sync1": 0.5, "sync2": 1.25, "end": 2.0}, PhaseKind.RIGID),
        "change": timing_at({"start": 0.0, "end": 1.0}, PhaseKind.FREE),
        "event": Timing(("start", "end"), (Phase(0.0, PhaseKind.RIGID),), instant=True),
    }
)
"""Preferred timings by name: elastic, with holds, limits and shortest durations, rigid, free, instant."""


def item(id_: str, timing: Timing, *, required: bool = False) -> Item:
    """A behavior that prefers a timing."""
    return Item(Behavior(id=id_, namespace=BML, name="test", location=_PLACE, order=0, required=required), timing)


def at(left: Node | str, right: Node | str, offset: float = 0.0, *, required: bool = False) -> Tie:
    """``left = right + offset``; a point may be written ``behavior:sync``."""
    one, other = _node(left), _node(right)
    owner = one.behavior if isinstance(one, Point) else None
    return Tie(one, other, offset, owner, _PLACE, f"{_name(one)} = {_name(other)} + {offset:g}", required)


def after(later: Node | str, earlier: Node | str, offset: float = 0.0, *, required: bool = False) -> Precedence:
    """``later >= earlier + offset``; a point may be written ``behavior:sync``."""
    one, other = _node(later), _node(earlier)
    text = f"{_name(one)} after {_name(other)} + {offset:g}"
    return Precedence(one, other, offset, text, _PLACE, text, required)


def outer(name: str, time: float | None) -> AnticipatorPeg:
    """A predicted point; all of them are in one graph."""
    return AnticipatorPeg(_GRAPH, name, None if time is None else GlobalTime(time))


def problem(items: Sequence[Item], *constraints: Tie | Precedence) -> SchedulingProblem:
    """A problem in which the block starts at time 0; external pegs keep their times."""
    ties = tuple(each for each in constraints if isinstance(each, Tie))
    orders = tuple(each for each in constraints if isinstance(each, Precedence))
    cells = [node for each in constraints for node in each.nodes if not isinstance(node, Point | Origin)]
    return SchedulingProblem(tuple(items), ties, {cell: cell.value for cell in cells}, orders)


def pegs_of(asked: SchedulingProblem, solution: Solution) -> Mapping[Point, TimePeg]:
    """The pegs of a solution, of a block that starts at time 0; they move with the predicted points of `outer`."""
    start = Source[Time](_GRAPH, "start", GlobalTime(0.0))
    return PegLayout(asked, solution).build(_GRAPH, "b", start).pegs


def peg_times(asked: SchedulingProblem, solution: Solution) -> dict[Point, float | None]:
    """The times of the pegs of a solution, s after the start of the block."""
    return {point: peg.value for point, peg in pegs_of(asked, solution).items()}


@st.composite
def problems(draw: st.DrawFn, most: int = 7) -> SchedulingProblem:
    """Arbitrary problems, mostly infeasible, with external times that are past, future or unknown."""
    items = _draw_items(draw, sorted(TIMINGS), most)
    outside = [outer(f"outer{i}", draw(st.sampled_from([None, -0.5, 0.0, 1.0, 4.0]))) for i in range(2)]
    points = _points(items)
    rights = st.sampled_from(_nodes(points, outside))
    offsets = st.sampled_from([0.0, 0.0, 0.5, 1.0, -0.5, 3.0])
    pairs = st.tuples(st.sampled_from(points), rights, offsets, st.booleans())
    ties = [at(left, right, offset, required=need) for left, right, offset, need in draw(st.lists(pairs, max_size=8))]
    drawn = draw(st.lists(st.tuples(pairs, st.booleans()), max_size=4))
    orders = [
        after(left, right, offset, required=need) if late else after(right, left, offset, required=need)
        for (left, right, offset, need), late in drawn
    ]
    return problem(items, *ties, *orders)


@st.composite
def feasible_problems(draw: st.DrawFn, most: int = 6) -> SchedulingProblem:
    """Feasible problems: the constraints are read off a random plan."""
    items = _draw_items(draw, [kind for kind, timing in TIMINGS.items() if not timing.free], most)
    outside = [outer("known", draw(st.sampled_from([0.0, 1.0, 2.5]))), outer("unknown", None)]
    times = _draw_times(draw, items) | {Origin.BLOCK_START: 0.0}
    times |= {cell: 2.0 if cell.value is None else cell.value for cell in outside}
    groups = _rigid_groups(items, [Origin.BLOCK_START, *outside])
    nodes = st.sampled_from([*times])
    constraints: list[Tie | Precedence] = []
    for left, right in draw(st.lists(st.tuples(nodes, nodes), max_size=10)):
        distance = round(times[left] - times[right], 9)
        if isinstance(left, Point) and left != right and draw(st.booleans()):
            gap = groups.union(left, right, distance)
            if gap is None or abs(gap) <= TIE_TOLERANCE:
                constraints.append(at(left, right, distance))
        elif isinstance(left, Point) or isinstance(right, Point):
            constraints.append(after(left, right, distance - draw(st.sampled_from([0.0, 0.25, 1.0]))))
    return problem(items, *constraints)


def _draw_items(draw: st.DrawFn, kinds: Sequence[str], most: int) -> list[Item]:
    drawn = draw(st.lists(st.tuples(st.sampled_from(kinds), st.booleans()), min_size=1, max_size=most))
    return [item(f"{kind}{i}", TIMINGS[kind], required=required) for i, (kind, required) in enumerate(drawn)]


def _points(items: Sequence[Item]) -> list[Point]:
    return [Point(each.behavior.id, sync) for each in items for sync in each.timing.points]


def _nodes(points: Sequence[Point], outside: Sequence[TimeCell]) -> list[Node]:
    return [*points, Origin.BLOCK_START, *outside]


def _draw_times(draw: st.DrawFn, items: Sequence[Item]) -> dict[Node, float]:
    times: dict[Node, float] = {}
    for each in items:
        time = draw(st.integers(0, 16)) / 4
        times[Point(each.behavior.id, each.timing.points[0])] = time
        for phase, sync in zip(each.timing.phases, each.timing.points[1:], strict=True):
            time += _draw_duration(draw, phase)
            times[Point(each.behavior.id, sync)] = time
    return times


def _draw_duration(draw: st.DrawFn, phase: Phase) -> float:
    if phase.kind is PhaseKind.RIGID:
        return phase.duration
    more = draw(st.sampled_from([0.0, 0.5])) if phase.kind is PhaseKind.HOLD else 0.0
    return phase.duration * draw(st.sampled_from([0.5, 1.0, 1.0, 2.0])) + more


def _rigid_groups(items: Sequence[Item], fixed: Sequence[Node]) -> OffsetUnionFind[Node]:
    """Points that rigid phases hold together: only one of a group may be tied to a given time."""
    groups = OffsetUnionFind[Node](fixed)
    for each in items:
        points = [Point(each.behavior.id, sync) for sync in each.timing.points]
        for phase, (one, next_) in zip(each.timing.phases, itertools.pairwise(points), strict=True):
            if phase.kind is PhaseKind.RIGID:
                groups.union(next_, one, phase.duration)
    return groups


def _node(node: Node | str) -> Node:
    return Point(*node.split(":")) if isinstance(node, str) else node


def _name(node: Node) -> str:
    if isinstance(node, Point):
        return ":".join(node)
    return node.value if isinstance(node, Origin) else node.name
