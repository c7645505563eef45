"""The points of a plan that others depend on, and the phases between them."""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import NamedTuple

from reactive_realizer.planunit.timing import PhaseKind
from reactive_realizer.scheduler.offset_union_find import TIE_TOLERANCE
from reactive_realizer.scheduler.problem import LEAST, Item, Node, Origin, Point, SchedulingProblem

START = 0
"""The node of the block's start."""


class KnotPhases(NamedTuple):
    """The phases between two knots of a behavior.

    Attributes:
        start: node of the earlier knot.
        end: node of the later one.
        rigid: duration of the rigid ones, s.
        least: shortest duration of the others, s.
        flexible: whether there are others.
        connects: whether all of them have preferred durations.
    """

    start: int
    end: int
    rigid: float
    least: float
    flexible: bool
    connects: bool


class Knots:
    """The knots of behaviors: the points that constraints name, and the first point of each behavior.

    Knots and given points are numbered nodes.

    Args:
        problem: the behaviors, and the kept constraints on them.
        times: of all points of the plan, s after the block's start.

    Attributes:
        nodes: number of each knot; given points come first, and the start of the block is the first of these.
        fixed: number of given nodes.
        indices: nodes of each behavior, by index of the point.
        times: of the knots, s after the block's start.
        phases: between consecutive knots.
    """

    def __init__(self, problem: SchedulingProblem, times: Mapping[Point, float]) -> None:
        self.nodes = _given(problem)
        self.fixed = len(self.nodes)
        self.indices: dict[str, dict[int, int]] = {}
        self.times: dict[int, float] = {}
        self.phases: list[KnotPhases] = []
        self._planned = times
        named: defaultdict[str, set[str]] = defaultdict(set)
        for each in problem.constraints:
            for node in each.nodes:
                if isinstance(node, Point) and node not in self.nodes:
                    named[node.behavior].add(node.sync)
        for item in problem.items:
            names = named.get(item.behavior.id, ())
            self._add(item, [k for k, sync in enumerate(item.timing.points) if k == 0 or sync in names])
            for before, after in pairwise(self.indices[item.behavior.id]):
                apart = before > 0 or item.timing.points[0] in names
                self.phases.append(self._between(item, before, after, apart=apart))

    def _add(self, item: Item, indices: Sequence[int]) -> None:
        knots = {k: node for node, k in enumerate(indices, len(self.nodes))}
        self.indices[item.behavior.id] = knots
        for k, node in knots.items():
            self.nodes[item.points[k]] = node
            self.times[node] = self._planned[item.points[k]]

    def _between(self, item: Item, before: int, after: int, *, apart: bool) -> KnotPhases:
        """The phases between two knots; an elastic one of no duration counts if constraints may force it apart."""
        knots, times, points = self.indices[item.behavior.id], self._planned, item.points
        rigid, least, flexible, connects = 0.0, 0.0, False, True
        for k in range(before, after):
            phase = item.timing.phases[k]
            kind, duration, planned = phase.kind, phase.duration, times[points[k + 1]] - times[points[k]]
            if kind is PhaseKind.RIGID and abs(planned - duration) <= TIE_TOLERANCE:
                rigid += duration
            elif kind is not PhaseKind.ELASTIC or duration > 0 or apart or phase.authored or planned > TIE_TOLERANCE:
                flexible, connects = True, connects and kind is not PhaseKind.FREE
                if kind is PhaseKind.ELASTIC and duration > 0:
                    least = LEAST
        if flexible:
            least = min(least, max(times[points[after]] - times[points[before]] - rigid, 0.0))
        return KnotPhases(knots[before], knots[after], rigid, least, flexible, connects)


def _given(problem: SchedulingProblem) -> dict[Node, int]:
    """The nodes that constraints name and that are no points of the problem's behaviors, numbered."""
    own = {item.behavior.id for item in problem.items}
    nodes: dict[Node, int] = {Origin.BLOCK_START: START}
    for each in problem.constraints:
        for node in each.nodes:
            if not isinstance(node, Point) or node.behavior not in own:
                nodes.setdefault(node, len(nodes))
    return nodes
