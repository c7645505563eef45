"""The equations of the thesis, checked on a plan (thesis 7.1 and 7.3.1; docs/time.md says where they are corrected)."""

import itertools
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from math import inf

from reactive_realizer.errors import Fault, SchedulingFault, rounded
from reactive_realizer.pegboard.time_peg import AnticipatorPeg
from reactive_realizer.planunit.timing import SHORTEST, PhaseKind
from reactive_realizer.scheduler.offset_union_find import OffsetUnionFind
from reactive_realizer.scheduler.plan_view import PlanView
from reactive_realizer.scheduler.problem import Node, Origin, Point, Precedence, Tie

TOLERANCE = 1e-6
"""s by which an equation may be missed: times are sums of fractions."""


class ConstraintBroken(SchedulingFault):
    """A constraint that a plan misses, found by ``--verify``; ``amount`` in s."""

    code = "constraint-broken"
    template = "'{text}' is missed by {amount} s ({points}; thesis {equation})"
    text: str
    amount: float
    points: str
    equation: str


@dataclass(frozen=True, slots=True)
class Violation:
    """An equation that does not hold.

    Attributes:
        equation: its number in the thesis, or the section where it has none.
        points: that it is about: ``behavior:sync``, or the name of a peg.
        amount: by how much it is missed, s.
        text: the requirement in words.
    """

    equation: str
    points: tuple[str, ...]
    amount: float
    text: str

    @property
    def fault(self) -> Fault:
        """The fault that reports it."""
        points = ", ".join(self.points)
        return ConstraintBroken(text=self.text, amount=self.amount, points=points, equation=self.equation)


def verify(plan: PlanView) -> list[Violation]:
    """The equations that a plan breaks.

    Unknown times, points that were cut, `at` constraints of past points, and before/after constraints whose later point
    is past are not checked.
    """
    checks = (
        _constraints,
        _not_before_block,
        _durations,
        _sequences,
        _rigid_phases,
        _shortest_phases,
        _early_clusters,
        _block_end,
    )
    return [violation for check in checks for violation in check(plan) if violation.amount > TOLERANCE]


def missed(constraint: Tie | Precedence, first: float | None, second: float | None) -> float:
    """By how much (s) a constraint is missed if its nodes have these times; minus infinity if one is unknown."""
    if first is None or second is None:
        return -inf
    late = second + constraint.offset - first
    return abs(late) if isinstance(constraint, Tie) else late


def _constraints(plan: PlanView) -> Iterator[Violation]:
    """7.8-7.12, 7.32-7.34: ``f(left) = f(right) + offset``, ``f(later) >= f(earlier) + offset``."""
    for each in plan.expected:
        first, second = each.nodes
        if plan.movable(first) and (isinstance(each, Precedence) or plan.movable(second)):
            amount = missed(each, plan.time(first), plan.time(second))
            yield Violation(_equation(each), _names(*each.nodes), amount, each.text)


def _not_before_block(plan: PlanView) -> Iterator[Violation]:
    """7.13: no point comes before the start of its block."""
    for point in plan.times:
        if point.behavior not in plan.lurking and plan.movable(point):
            amount = _gap(plan, point, Origin.BLOCK_START)
            yield Violation("7.13", _names(point), amount, f"{_name(point)} not before its block")


def _durations(plan: PlanView) -> Iterator[Violation]:
    """7.14: a behavior has a duration, unless it is instant."""
    for id_, timing in plan.timings.items():
        start, end = Point(id_, timing.points[0]), Point(id_, timing.points[-1])
        if not timing.instant and plan.movable(end) and id_ not in plan.lurking:
            yield Violation("7.14", _names(start, end), _gap(plan, end, start, SHORTEST), f"{id_} takes time")


def _sequences(plan: PlanView) -> Iterator[Violation]:
    """7.15: the points of a behavior come in order."""
    for id_, timing in plan.timings.items():
        known = [point for sync in timing.points if plan.times.get(point := Point(id_, sync)) is not None]
        for point, after in itertools.pairwise(known):
            if id_ not in plan.lurking and (plan.movable(point) or plan.movable(after)):
                text = f"{id_}:{point.sync} not after its {after.sync}"
                yield Violation("7.15", _names(point, after), _gap(plan, after, point), text)


def _rigid_phases(plan: PlanView) -> Iterator[Violation]:
    """7.1.4: a rigid phase has its preferred duration."""
    for id_, timing in plan.timings.items():
        points = [Point(id_, sync) for sync in timing.points]
        for phase, (point, after) in zip(timing.phases, itertools.pairwise(points), strict=True):
            if phase.kind is PhaseKind.RIGID and plan.movable(point) and plan.movable(after):
                short, long = _gap(plan, after, point, phase.duration), _gap(plan, point, after, -phase.duration)
                text = f"{rounded(phase.duration)} s from {id_}:{point.sync} to its {after.sync}"
                yield Violation("7.1.4", _names(point, after), max(short, long), text)


def _shortest_phases(plan: PlanView) -> Iterator[Violation]:
    """7.2.1: no phase is shorter than the body needs; on the board, once it has begun."""
    for id_, timing in plan.timings.items():
        points = [Point(id_, sync) for sync in timing.points]
        for shortest, (point, after) in zip(plan.shortest.get(id_, ()), itertools.pairwise(points), strict=False):
            begun = not plan.past or (point in plan.past and plan.movable(after))
            if shortest > 0 and begun and id_ not in plan.lurking:
                text = f"{rounded(shortest)} s from {id_}:{point.sync} to its {after.sync} at least"
                yield Violation("7.2.1", _names(point, after), _gap(plan, after, point, shortest), text)


def _early_clusters(plan: PlanView) -> Iterator[Violation]:
    """7.24, 7.37: a cluster without times from outside starts as early as the block, now and its `after`s allow.

    One that other constraints put before something too may have to stay where it was planned (docs/semantics.md, pegs).
    """
    for behaviors, ties in _clusters(plan, [id_ for id_, timing in plan.timings.items() if not timing.free]):
        ids = sorted(behaviors)
        points = [Point(id_, sync) for id_ in ids for sync in plan.timings[id_].points]
        if all(plan.movable(point) for point in points) and all(
            isinstance(node, Point) and node.behavior in behaviors for tie in ties for node in tie.nodes
        ):
            starts = _names(*(Point(id_, plan.timings[id_].points[0]) for id_ in ids))
            yield Violation("7.24", starts, _earliness(plan, behaviors), f"{', '.join(starts)} as early as can be")


def _earliness(plan: PlanView, cluster: Collection[str]) -> float:
    """How much earlier (s) a cluster could be as a whole; 0 if some of its times are unknown."""
    times = [time for point, time in plan.times.items() if point.behavior in cluster]
    known = [time for time in times if time is not None]
    if plan.earliest is None or len(known) < len(times):
        return 0.0
    inside = {
        order: tuple(isinstance(node, Point) and node.behavior in cluster for node in order.nodes)
        for order in plan.kept
        if isinstance(order, Precedence)
    }
    if (False, True) in inside.values() and (True, False) in inside.values():
        return 0.0
    room = min(known) - plan.earliest
    for order, (later, earlier) in inside.items():
        if later and not earlier:
            gap = missed(order, *map(plan.time, order.nodes))
            room = min(room, 0.0 if gap == -inf or not plan.cut.isdisjoint(order.nodes) else -gap)
    return room


def _block_end(plan: PlanView) -> Iterator[Violation]:
    """7.27: a block ends with the last of its behaviors."""
    if plan.end is None or plan.start is None:
        return
    ends = (Point(id_, timing.points[-1]) for id_, timing in plan.timings.items())
    known = {point: time for point in ends if (time := plan.time(point)) is not None}
    for point, time in known.items():
        yield Violation("7.27", _names(point), time - plan.end, f"the block ends not before {_name(point)}")
    latest = max([plan.start, plan.end_floor, *known.values()])
    yield Violation("7.27", _names(*known), plan.end - latest, "the block ends with its last behavior")


def _clusters(plan: PlanView, behaviors: Collection[str]) -> list[tuple[frozenset[str], list[Tie]]]:
    """The clusters of some behaviors, as if there were no others, each with its ties (thesis 7.1.3.1, 7.16, 7.17)."""
    groups = OffsetUnionFind[str]()
    own: dict[str, list[Tie]] = {id_: [] for id_ in behaviors}
    for tie in plan.kept:
        ids = [node.behavior for node in tie.nodes if isinstance(node, Point) and node.behavior in own]
        if isinstance(tie, Tie) and ids:
            own[ids[0]].append(tie)
            groups.union(ids[0], ids[-1])
    members: dict[str, list[str]] = {}
    for id_ in behaviors:
        members.setdefault(groups.find(id_)[0], []).append(id_)
    return [(frozenset(ids), [tie for id_ in ids for tie in own[id_]]) for ids in members.values()]


def _gap(plan: PlanView, later: Node, earlier: Node, offset: float = 0.0) -> float:
    """By how much (s) ``later >= earlier + offset`` is missed; minus infinity if a time is unknown."""
    late, early = plan.time(later), plan.time(earlier)
    return -inf if late is None or early is None else early + offset - late


def _equation(constraint: Tie | Precedence) -> str:
    """The number of the equation: about the start of the block, two points, or a prediction."""
    if isinstance(constraint, Tie):
        numbers = "7.8", "7.11", "7.32"
    else:
        numbers = ("7.9", "7.12", "7.33") if isinstance(constraint.later, Point) else ("7.10", "7.12", "7.34")
    if Origin.BLOCK_START in constraint.nodes:
        return numbers[0]
    return numbers[1 + any(isinstance(node, AnticipatorPeg) for node in constraint.nodes)]


def _names(*nodes: Node) -> tuple[str, ...]:
    return tuple(_name(node) for node in nodes)


def _name(node: Node) -> str:
    if isinstance(node, Point):
        return ":".join(node)
    return node.value if isinstance(node, Origin) else node.name
