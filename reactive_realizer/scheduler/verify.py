"""The equations of the thesis, checked on a plan (thesis 7.1 and 7.3.1; docs/time.md says where they are corrected)."""

import itertools
from collections.abc import Iterator
from dataclasses import dataclass
from math import inf

from reactive_realizer.errors import Fault
from reactive_realizer.pegboard.time_peg import AnticipatorPeg
from reactive_realizer.planunit.timing import SHORTEST, PhaseKind
from reactive_realizer.scheduler.clusters import Cluster, clusters_of
from reactive_realizer.scheduler.faults import ConstraintBroken
from reactive_realizer.scheduler.plan_view import PlanView
from reactive_realizer.scheduler.problem import Node, Origin, Point, Precedence, Tie

TOLERANCE = 1e-6
"""s by which an equation may be missed: times are sums of fractions."""


@dataclass(frozen=True, slots=True)
class Violation:
    """An equation that does not hold.

    Attributes:
        equation: its number in the thesis, or the section where it has none.
        points: what it is about: ``behavior:sync``, or the name of a peg.
        amount: by how much it is missed, s.
        text: what should hold, for people.
    """

    equation: str
    points: tuple[str, ...]
    amount: float
    text: str

    @property
    def fault(self) -> Fault:
        """What is said of it."""
        points = ", ".join(self.points)
        return ConstraintBroken(text=self.text, amount=self.amount, points=points, equation=self.equation)


def verify(plan: PlanView) -> list[Violation]:
    """The equations that a plan breaks.

    Not judged is what nobody knows or can help any more: unknown times, points that were cut, `at` constraints of
    points that have passed, and before/after constraints of which the later point has.
    """
    checks = (_ties, _orders, _not_before_block, _durations, _sequences, _rigid_phases, _early_clusters, _block_end)
    return [violation for check in checks for violation in check(plan) if violation.amount > TOLERANCE]


def missed(constraint: Tie | Precedence, first: float | None, second: float | None) -> float:
    """By how much (s) a constraint is missed with its nodes at some times; minus infinity if one is unknown."""
    late = _late(first, second, constraint.offset)
    return abs(late) if isinstance(constraint, Tie) and late > -inf else late


def _ties(plan: PlanView) -> Iterator[Violation]:
    """7.8, 7.11, 7.32: ``f(left) = f(right) + offset``."""
    for tie in plan.expected:
        if isinstance(tie, Tie) and plan.movable(tie.left) and plan.movable(tie.right):
            amount = missed(tie, *map(plan.time, tie.nodes))
            yield Violation(_equation(tie.nodes, "7.8", "7.11", "7.32"), _names(*tie.nodes), amount, tie.text)


def _orders(plan: PlanView) -> Iterator[Violation]:
    """7.9, 7.10, 7.12, 7.33, 7.34: ``f(later) >= f(earlier) + offset``."""
    for order in plan.expected:
        if isinstance(order, Precedence) and plan.movable(order.later):
            amount = missed(order, *map(plan.time, order.nodes))
            before = not isinstance(order.later, Point)
            numbers = ("7.10", "7.12", "7.34") if before else ("7.9", "7.12", "7.33")
            yield Violation(_equation(order.nodes, *numbers), _names(*order.nodes), amount, order.text)


def _not_before_block(plan: PlanView) -> Iterator[Violation]:
    """7.13: nothing comes before the start of its block, but what joins an outer time that passed before it."""
    late = [cluster.behaviors for cluster in clusters_of(plan, plan.timings) if cluster.joins_late(plan)]
    excused = plan.lurking.union(*late)
    for point in plan.times:
        if point.behavior not in excused and plan.movable(point):
            amount = _gap(plan, point, Origin.BLOCK_START)
            yield Violation("7.13", _names(point), amount, f"{_name(point)} not before its block")


def _durations(plan: PlanView) -> Iterator[Violation]:
    """7.14: a behavior takes time, unless it is an event."""
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
    """7.1.4: what is rigid takes the time that it wants."""
    for id_, timing in plan.timings.items():
        points = [Point(id_, sync) for sync in timing.points]
        for phase, (point, after) in zip(timing.phases, itertools.pairwise(points), strict=True):
            if phase.kind is PhaseKind.RIGID and plan.movable(point) and plan.movable(after):
                short = _gap(plan, after, point, phase.duration)
                long = _gap(plan, point, after, -phase.duration)
                text = f"{phase.duration:g} s from {id_}:{point.sync} to its {after.sync}"
                yield Violation("7.1.4", _names(point, after), max(short, long), text)


def _early_clusters(plan: PlanView) -> Iterator[Violation]:
    """7.24, 7.37: a cluster that nothing grounds starts as soon as the block, now and its `after`s let it."""
    for cluster in clusters_of(plan, [id_ for id_, timing in plan.timings.items() if not timing.free]):
        points = [Point(id_, sync) for id_ in sorted(cluster.behaviors) for sync in plan.timings[id_].points]
        if not cluster.grounded and all(plan.movable(point) for point in points):
            starts = _names(*(Point(id_, plan.timings[id_].points[0]) for id_ in sorted(cluster.behaviors)))
            yield Violation("7.24", starts, _could_be_earlier(plan, cluster), f"{', '.join(starts)} as early as can be")


def _could_be_earlier(plan: PlanView, cluster: Cluster) -> float:
    """How much earlier (s) a cluster could be as a whole."""
    times = [time for point, time in plan.times.items() if point.behavior in cluster.behaviors]
    known = [time for time in times if time is not None]
    if plan.earliest is None or len(known) < len(times):
        return 0.0
    room = min(known) - plan.earliest
    for order in plan.kept:
        inside = [isinstance(node, Point) and node.behavior in cluster.behaviors for node in order.nodes]
        if isinstance(order, Precedence) and inside == [True, False]:
            gap = missed(order, *map(plan.time, order.nodes))
            room = min(room, 0.0 if gap == -inf else -gap)
    return room


def _block_end(plan: PlanView) -> Iterator[Violation]:
    """7.27: a block ends with the last of its behaviors."""
    ends = (Point(id_, timing.points[-1]) for id_, timing in plan.timings.items())
    known = {point: time for point in ends if (time := plan.time(point)) is not None}
    if plan.end is None or plan.start is None:
        return
    for point, time in known.items():
        yield Violation("7.27", _names(point), time - plan.end, f"the block ends not before {_name(point)}")
    latest = max([plan.start, plan.end_floor, *known.values()])
    yield Violation("7.27", _names(*known), plan.end - latest, "the block ends with its last behavior")


def _gap(plan: PlanView, later: Node, earlier: Node, offset: float = 0.0) -> float:
    """By how much (s) ``later >= earlier + offset`` is missed; minus infinity if nobody knows."""
    return _late(plan.time(later), plan.time(earlier), offset)


def _late(later: float | None, earlier: float | None, offset: float) -> float:
    return -inf if later is None or earlier is None else earlier + offset - later


def _equation(nodes: tuple[Node, Node], absolute: str, relative: str, predicted: str) -> str:
    if Origin.BLOCK_START in nodes:
        return absolute
    return predicted if any(isinstance(node, AnticipatorPeg) for node in nodes) else relative


def _names(*nodes: Node) -> tuple[str, ...]:
    return tuple(_name(node) for node in nodes)


def _name(node: Node) -> str:
    if isinstance(node, Point):
        return ":".join(node)
    return node.value if isinstance(node, Origin) else node.name
