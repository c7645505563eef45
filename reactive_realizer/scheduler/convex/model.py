"""A relaxed problem as nodes, roots, spans and rows; and all of these in variables."""

from collections import defaultdict
from collections.abc import Iterable, Iterator
from collections.abc import Set as AbstractSet
from math import inf

from reactive_realizer.scheduler.convex.behavior_spans import BehaviorSpans
from reactive_realizer.scheduler.convex.conflict import GIVEN, Conflict, Rank, Requirement
from reactive_realizer.scheduler.convex.explained_groups import ExplainedGroups
from reactive_realizer.scheduler.convex.lateness import late_behaviors
from reactive_realizer.scheduler.convex.longest_path import TOLERANCE
from reactive_realizer.scheduler.convex.relaxed_problem import RelaxedProblem
from reactive_realizer.scheduler.convex.span import Bound, Row, Span
from reactive_realizer.scheduler.problem import LEAST, Node, Point, Precedence, Tie

START = 0
"""The node of the block's start, and its variable, which all known times share."""


class Model:
    """What is to be found for the behaviors of a relaxed problem.

    A variable ``x`` is the time of a root, s after the block's start; every node is at a distance from a variable.

    Args:
        lifted: lengths and limits that were given up.

    Attributes:
        nodes: number of each point that a constraint names, or that begins a behavior; the fixed ones come first.
        knots: those of each behavior, by index of the point, in order.
        parts: spans of each behavior.
        spans: all of them.
        late: the behaviors that join late; thesis 7.13 does not bind them (docs/semantics.md).
        bounds: all inequalities, in variables.
        conflicts: what was found to be impossible while building.
        size: number of variables.
    """

    def __init__(self, relaxed: RelaxedProblem, lifted: AbstractSet[Requirement]) -> None:
        self.relaxed = relaxed
        self.nodes: dict[Node, int] = {node: number for number, node in enumerate(relaxed.fixed)}
        self.groups = ExplainedGroups(len(relaxed.fixed))
        self.knots: dict[int, dict[int, int]] = {}
        self.parts: dict[int, BehaviorSpans] = {}
        self.conflicts: list[Conflict] = []
        self._add_behaviors(lifted)
        self._link()
        self.late = late_behaviors(relaxed, self.nodes, self.groups)
        self.spans = [span for part in self.parts.values() for span in part.spans]
        self._places = self._variables()
        self.size = 1 + max(variable for variable, _ in self._places)
        for span in self.spans:
            self._settle(span)
        for span in self.spans:
            _follow_if_settled(span)
        self.bounds = list(self._bounds(self._rows()))

    def place(self, node: int) -> tuple[int, float]:
        """The variable that a node hangs on, and how much later (s) it is."""
        return self._places[node]

    # --- nodes

    def _add_behaviors(self, lifted: AbstractSet[Requirement]) -> None:
        tied = self._named(self.relaxed.ties.values())
        ordered = self._named(self.relaxed.orders.values())
        for index, item in self.relaxed.items.items():
            points = item.timing.points
            id_ = item.behavior.id
            at = {k for k, sync in enumerate(points) if sync in tied[id_]}
            named = at | {k for k, sync in enumerate(points) if sync in ordered[id_]} if id_ in ordered else at
            knots = {k: self.groups.add_node() for k in sorted({0, *named})}
            self.nodes.update({Point(id_, points[k]): node for k, node in knots.items()})
            self.knots[index] = knots
            self.parts[index] = BehaviorSpans(index, item.timing, knots, named, at, lifted, self.groups.add_node)

    def _named(self, constraints: Iterable[Tie | Precedence]) -> defaultdict[str, set[str]]:
        named: defaultdict[str, set[str]] = defaultdict(set)
        for node in (node for each in constraints for node in each.nodes):
            if isinstance(node, Point) and node not in self.nodes:
                named[node.behavior].add(node.sync)
        return named

    def _link(self) -> None:
        """Make one what is tied; a rigid behavior goes before what ties it, since rigid wins."""
        for index, part in self.parts.items():
            for earlier, later, distance in part.rigid:
                self.groups.tie(later, earlier, distance, Requirement(Rank.BEHAVIOR, index))
        for requirement, tie in self.relaxed.ties.items():
            left, right = (self.nodes[node] for node in tie.nodes)
            conflict = self.groups.tie(left, right, tie.offset, requirement)
            if conflict is not None:
                self.conflicts.append(conflict)

    # --- variables

    def _variables(self) -> list[tuple[int, float]]:
        times = list(self.relaxed.fixed.values())
        variables: dict[int, tuple[int, float]] = {}
        number = START
        for root in range(len(self.groups)):
            if self.groups.find(root)[0] == root:
                known = times[root] if root < len(times) else None
                if known is None:
                    number += 1
                variables[root] = (number, 0.0) if known is None else (START, known)
        found = map(self.groups.find, range(len(self.groups)))
        return [(variables[root][0], variables[root][1] + distance) for root, distance in found]

    def _settle(self, span: Span) -> None:
        """Write a span in variables; one whose duration follows from ties has it now."""
        (span.tail, start), (span.head, end) = self.place(span.start), self.place(span.end)
        span.shift = end - start - span.rigid
        if not span.closed:
            return
        span.duration = span.shift
        if span.elastic and span.duration < LEAST:
            requirements = self.groups.between(span.start, span.end) | {span.requirement}
            requirements |= {span.length_requirement} if span.duration > -TOLERANCE else set()
            self.conflicts.append(Conflict(requirements, LEAST - span.duration))

    # --- inequalities

    def _rows(self) -> Iterator[Row]:
        for requirement, order in self.relaxed.orders.items():
            yield Row(self.nodes[order.later], self.nodes[order.earlier], order.offset, requirement)
        for index, knots in self.knots.items():
            if index not in self.late:
                yield Row(knots[0], START, 0.0, GIVEN)  # thesis 7.13
        for span in self.spans:
            yield from _limits(span)

    def _bounds(self, rows: Iterable[Row]) -> Iterator[Bound]:
        for row in rows:
            (later, late), (earlier, early) = self.place(row.later), self.place(row.earlier)
            distance = row.distance + early - late
            if later != earlier:
                yield Bound(later, earlier, distance, row)
            elif distance > TOLERANCE:
                self.conflicts.append(
                    Conflict(self.groups.between(row.later, row.earlier) | {row.requirement}, distance)
                )


def _follow_if_settled(span: Span) -> None:
    """A stretch that is known already only changes what the span would like."""
    if span.guide is not None and span.guide.closed:
        span.goal = span.preferred * span.guide.ratio
        span.guide = None


def _limits(span: Span) -> Iterator[Row]:
    limit = Requirement(Rank.LIMIT, span.behavior, span.phases[0])
    if span.minimum > 0:
        yield Row(span.end, span.start, span.rigid + span.minimum, limit)
    elif not span.elastic:
        yield Row(span.end, span.start, span.rigid, span.requirement)
    if span.maximum < inf:
        yield Row(span.start, span.end, -span.rigid - span.maximum, limit)
