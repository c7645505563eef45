"""A problem without what was given up, as spans, groups of points at fixed offsets, and inequalities of variables."""

from collections import defaultdict
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass
from math import inf
from typing import NamedTuple, TypeVar

from reactive_realizer.planunit.timing import Timing
from reactive_realizer.scheduler.convex.conflicts import GIVEN, Conflict, ExplainedGroups, Need, Rank, Requirement
from reactive_realizer.scheduler.convex.longest_path import TOLERANCE, Arc
from reactive_realizer.scheduler.convex.spans import BehaviorSpans, Span
from reactive_realizer.scheduler.problem import LEAST, Item, Node, Origin, Point, Precedence, SchedulingProblem, Tie

START = 0
"""The node of the block's start, and its variable, which all known times share."""

C = TypeVar("C", Tie, Precedence)


@dataclass(frozen=True, slots=True)
class RelaxedProblem:
    """The behaviors and constraints that were not given up.

    Attributes:
        items: by index in the problem, in order.
        ties: between them.
        orders: between them.
        fixed: the given nodes that these name, with their times (s after the block's start, None while unknown); the
            start of the block is the first.
    """

    items: Mapping[int, Item]
    ties: Mapping[Requirement, Tie]
    orders: Mapping[Requirement, Precedence]
    fixed: Mapping[Node, float | None]

    @classmethod
    def of(cls, problem: SchedulingProblem, dropped: AbstractSet[Requirement]) -> "RelaxedProblem":
        """A problem in canonical order without some requirements."""
        items = {k: item for k, item in enumerate(problem.items) if Requirement(Rank.BEHAVIOR, k) not in dropped}
        lost = {item.behavior.id for k, item in enumerate(problem.items) if k not in items}
        ties, orders = _left(problem.ties, Rank.TIE, lost, dropped), _left(problem.orders, Rank.ORDER, lost, dropped)
        given, fixed = problem.given, dict[Node, float | None]({Origin.BLOCK_START: 0.0})
        pairs = [*(tie.nodes for tie in ties.values()), *(order.nodes for order in orders.values())]
        fixed.update({node: given[node] for pair in pairs for node in pair if node in given})
        return cls(items, ties, orders, fixed)


def _left(
    constraints: Sequence[C], rank: Rank, lost: Collection[str], dropped: AbstractSet[Requirement]
) -> dict[Requirement, C]:
    left = {Requirement(rank, index): each for index, each in enumerate(constraints)}
    if dropped:
        left = {key: each for key, each in left.items() if key not in dropped and not each.names(lost)}
    return left


class Inequality(NamedTuple):
    """``later >= earlier + distance`` (s), of nodes.

    Attributes:
        need: the shortest duration that it states, if it does.
    """

    later: int
    earlier: int
    distance: float
    requirement: Requirement
    need: Need | None = None


BoundArc = Arc[Inequality]
"""An inequality of variables: ``x[head] >= x[tail] + length``."""


class Model:
    """The unknowns of a relaxed problem.

    A *node* is a knot, or a point between two spans. A variable ``x`` is the time of a group of nodes at fixed offsets
    from each other, s after the block's start.

    Args:
        problem: in canonical order.
        dropped: requirements that were given up.

    Attributes:
        relaxed: the problem without these.
        nodes: number of each knot; the given ones come first.
        knots: nodes of each behavior, by index of the point, in order.
        parts: spans of each behavior.
        spans: all of them.
        bounds: all inequalities.
        conflicts: those found while building.
        size: number of variables.
        places: the variable of each node, and the offset (s) from it.
    """

    def __init__(self, problem: SchedulingProblem, dropped: AbstractSet[Requirement]) -> None:
        self.relaxed = relaxed = RelaxedProblem.of(problem, dropped)
        self._dropped = dropped
        self.nodes: dict[Node, int] = {node: number for number, node in enumerate(relaxed.fixed)}
        self.groups = ExplainedGroups(len(relaxed.fixed))
        self.knots: dict[int, dict[int, int]] = {}
        self.parts: dict[int, BehaviorSpans] = {}
        self.conflicts: list[Conflict] = []
        self._add_behaviors(dropped)
        self._link()
        self._found = [self.groups.find(node) for node in range(len(self.groups))]
        self.spans = [span for part in self.parts.values() for span in part.spans]
        self.places = self._find_places()
        self.size = 1 + max(variable for variable, _ in self.places)
        for span in self.spans:
            self._settle(span)
        for span in self.spans:
            _follow_if_settled(span)
        self.bounds = list(self._bounds(self._inequalities()))

    # --- nodes

    def _add_behaviors(self, dropped: AbstractSet[Requirement]) -> None:
        tied, ordered = self._named(self.relaxed.ties.values()), self._named(self.relaxed.orders.values())
        for index, item in self.relaxed.items.items():
            id_, points = item.behavior.id, item.timing.points
            at = {k for k, sync in enumerate(points) if sync in tied[id_]} if id_ in tied else set[int]()
            named = at | {k for k, sync in enumerate(points) if sync in ordered[id_]} if id_ in ordered else at
            knots = {k: self.groups.add_node() for k in sorted({0, *named})}
            self.nodes.update({item.points[k]: node for k, node in knots.items()})
            self.knots[index] = knots
            self.parts[index] = BehaviorSpans(index, item.timing, knots, named, at, dropped, self.groups.add_node)

    def _named(self, constraints: Iterable[Tie | Precedence]) -> dict[str, set[str]]:
        named: defaultdict[str, set[str]] = defaultdict(set)
        for each in constraints:
            for node in each.nodes:
                if isinstance(node, Point) and node not in self.nodes:
                    named[node.behavior].add(node.sync)
        return named

    def _link(self) -> None:
        """Group tied nodes; rigid phases go before a tie that contradicts them."""
        for index, part in self.parts.items():
            for earlier, later, distance in part.rigid:
                self.groups.tie(later, earlier, distance, Requirement(Rank.BEHAVIOR, index))
        for requirement, tie in self.relaxed.ties.items():
            conflict = self.groups.tie(self.nodes[tie.left], self.nodes[tie.right], tie.offset, requirement)
            if conflict is not None:
                self.conflicts.append(conflict)

    # --- variables

    def _find_places(self) -> list[tuple[int, float]]:
        times = list(self.relaxed.fixed.values())
        variables: dict[int, tuple[int, float]] = {}
        number = START
        for node, (root, _) in enumerate(self._found):
            if node == root:
                known = times[root] if root < len(times) else None
                if known is None:
                    number += 1
                variables[root] = (number, 0.0) if known is None else (START, known)
        return [(variables[root][0], variables[root][1] + offset) for root, offset in self._found]

    def _settle(self, span: Span) -> None:
        """Write a span in variables; a duration that follows from ties is found now."""
        (span.tail, start), (span.head, end) = self.places[span.start], self.places[span.end]
        span.shift = end - start - span.rigid
        if not span.closed:
            return
        span.duration = span.shift
        if span.elastic and not span.shortest and span.duration < LEAST:
            requirements = self.groups.between(span.start, span.end) | {span.requirement}
            requirements |= {span.length_requirement} if span.duration > -TOLERANCE else set()
            self.conflicts.append(Conflict(requirements, LEAST - span.duration))

    # --- inequalities

    def _inequalities(self) -> Iterator[Inequality]:
        for requirement, order in self.relaxed.orders.items():
            yield Inequality(self.nodes[order.later], self.nodes[order.earlier], order.offset, requirement)
        for knots in self.knots.values():
            yield Inequality(knots[0], START, 0.0, GIVEN)  # thesis 7.13
        for span in self.spans:
            yield from _limits(span)
        for index, item in self.relaxed.items.items():
            yield from self._whole_limits(index, item.timing)

    def _whole_limits(self, index: int, timing: Timing) -> Iterator[Inequality]:
        """The longest duration of a whole behavior, which holds could exceed."""
        last = len(timing.phases)
        _, most = timing.limits
        requirement = Requirement(Rank.LIMIT, index, last)
        if most < inf and last in self.knots[index] and requirement not in self._dropped:
            yield Inequality(self.knots[index][0], self.knots[index][last], -most, requirement)

    def _bounds(self, inequalities: Iterable[Inequality]) -> Iterator[BoundArc]:
        for each in inequalities:
            (later, late), (earlier, early) = self.places[each.later], self.places[each.earlier]
            distance = each.distance + early - late
            if later != earlier:
                yield Arc(earlier, later, distance, each)
            elif distance > TOLERANCE:
                requirements = self.groups.between(each.later, each.earlier) | {each.requirement}
                needs = () if each.need is None else (each.need,)
                self.conflicts.append(Conflict(requirements, distance, needs=needs))


def _follow_if_settled(span: Span) -> None:
    """A stretch that is known already only changes the goal of the span."""
    if span.guide is not None and span.guide.closed:
        span.goal = span.preferred * span.guide.ratio
        span.guide = None


def _limits(span: Span) -> Iterator[Inequality]:
    if span.minimum > span.shortest:
        yield Inequality(span.end, span.start, span.rigid + span.minimum, _limit(span))
    elif span.shortest > 0:
        yield Inequality(span.end, span.start, span.rigid + span.shortest, span.requirement, span.need)
    elif not span.elastic:
        yield Inequality(span.end, span.start, span.rigid, span.requirement)
    if span.maximum < inf:
        yield Inequality(span.start, span.end, -span.rigid - span.maximum, _limit(span))


def _limit(span: Span) -> Requirement:
    return Requirement(Rank.LIMIT, span.behavior, span.phases[0])
