"""The points of a plan as a network: roots, and the phases between them."""

from collections import defaultdict
from collections.abc import Collection, Iterable, Mapping, Sequence
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

from reactive_realizer.planunit.timing import PhaseKind
from reactive_realizer.scheduler.offset_union_find import TIE_TOLERANCE, OffsetUnionFind
from reactive_realizer.scheduler.peg_layout.branches import Branches
from reactive_realizer.scheduler.peg_layout.peg_rules import Position
from reactive_realizer.scheduler.problem import LEAST, Item, Node, Origin, Point, SchedulingProblem

START = 0
"""The node of the block's start."""

TOLERANCE = 1e-9
"""Times that differ by less (s) are equal."""

Stops = Mapping[int, Sequence[Position]]
"""By root, what its first point cannot pass in one direction."""


class Edge(NamedTuple):
    """Phases from root to root; if the elastic ones lasted no time at all, ``end = start + distance``, s.

    Attributes:
        leaves: how much later (s) than its first root the edge begins.
        enters: how much later (s) than the other one it ends.
    """

    start: int
    end: int
    distance: float
    leaves: float
    enters: float

    @property
    def back(self) -> "Edge":
        """The same edge in the other direction."""
        return Edge(self.end, self.start, -self.distance, self.enters, self.leaves)


class RootPrecedence(NamedTuple):
    """``later >= earlier + distance``, of roots.

    Attributes:
        own: whether the later one can be pushed: a point that does not stand at a time of the block.
    """

    later: int
    earlier: int
    distance: float
    own: bool


class _Span(NamedTuple):
    """Phases between two knots of a behavior, nodes.

    Attributes:
        rigid: s of it that cannot give.
        least: s that the rest lasts at least.
        connects: whether the behavior prefers a duration for all of it.
    """

    start: int
    end: int
    rigid: float
    least: float
    connects: bool


class Network:
    """Behaviors of a plan, their roots, and the edges between these.

    A *knot* is a point that a constraint names, or the first one of a behavior. Knots and what is given are numbered
    nodes. What hangs on a time from outside falls apart into `Branches`, each with a root of its own.

    Args:
        problem: behaviors that are laid out together, and the kept constraints on them.
        times: of all points of the plan, s after the block's start.

    Attributes:
        nodes: number of each knot; what is given comes first, and of that the start of the block.
        fixed: number of given nodes.
        knots: nodes by index of the point, of each behavior.
        roots: in order; the fixed ones come first.
        branches: where the roots of branches hang.
        leads: how much later (s) than the root its first point is; 0 for fixed ones.
        edges: in order of time.
    """

    def __init__(self, problem: SchedulingProblem, times: Mapping[Point, float]) -> None:
        self._problem = problem
        self._times = times
        self.knots: dict[str, dict[int, int]] = {}
        self.nodes = _given(problem)
        self.fixed = len(self.nodes)
        self._groups = OffsetUnionFind[int](range(self.fixed))
        self._spans = self._add_knots()
        links = self._tie()
        outside = range(START + 1, self.fixed)
        self._branches = Branches(len(self.nodes), outside, self._rigid, links)
        self._positions = [self._position(node, outside) for node in range(len(self.nodes))]
        self._clusters = self._connected()
        self._hanging = {self.cluster(root) for root in range(self.fixed)}
        self.branches: dict[int, Position] = {}
        self.leads: dict[int, float] = dict.fromkeys(range(self.fixed), 0.0)
        self._note_leads()
        self.roots = sorted(self.leads)
        self._root_times = self._find_times()
        self.edges = self._edges(least=False)

    @property
    def given(self) -> Sequence[Node]:
        """What has pegs already; the start of the block is the first."""
        return list(self.nodes)[: self.fixed]

    def time(self, root: int) -> float:
        """Of a root, s after the block's start."""
        return self._root_times[root]

    def cluster(self, root: int) -> int:
        """The cluster of a root: what edges connect."""
        return self._clusters.find(self._groups.find(root)[0])[0]

    def first_time(self, root: int) -> float:
        """Of the first point of a root, s after the block's start."""
        return self.time(root) + self.leads[root]

    def position(self, node: int) -> Position:
        """Where a node is."""
        return self._positions[node]

    def at(self, position: Position) -> float:
        """When, s after the block's start."""
        return self.time(position.root) + position.offset

    def is_rigid(self, branch: int) -> bool:
        """Whether a branch is more than one point."""
        return branch in self._branches.rigid

    def hangs(self, cluster: int) -> bool:
        """Whether something of it, or next to it, is given."""
        return cluster in self._hanging

    def precedences(self) -> list[RootPrecedence]:
        """The orders between different roots."""
        found = []
        for order in self._problem.orders:
            late, early = (self.position(self.nodes[node]) for node in order.nodes)
            if late.root != early.root:
                distance = order.offset + early.offset - late.offset
                own = isinstance(order.later, Point) and late.root != START
                found.append(RootPrecedence(late.root, early.root, distance, own))
        return found

    def floors(self, given: Collection[int]) -> Stops:
        """What the first points of roots cannot come before: all given roots from which phases lead to them."""
        return self._stops(given, self._least_edges, 1.0)

    def ceilings(self, given: Collection[int]) -> Stops:
        """What they cannot come after: all given roots to which phases lead."""
        return self._stops(given, [edge.back for edge in reversed(self._least_edges)], -1.0)

    def between(self, given: Collection[int]) -> bool:
        """Whether phases lead from or to more than one of them."""
        return len({root for edge in self.edges for root in (edge.start, edge.end)}.intersection(given)) > 1

    def latest_before(self, given: Iterable[int]) -> dict[int, Position]:
        """For each root that phases lead to from a given one: where it would be if these took no time.

        Of several the latest; a path goes no further than from one given root to the next.
        """
        return self._nearest(given, self.edges, 1.0)

    def earliest_after(self, given: Iterable[int]) -> dict[int, Position]:
        """The same, backwards."""
        return self._nearest(given, [edge.back for edge in reversed(self.edges)], -1.0)

    # --- from behaviors to nodes

    def _add_knots(self) -> list[_Span]:
        named: defaultdict[str, set[str]] = defaultdict(set)
        for point in (node for each in self._problem.constraints for node in each.nodes):
            if isinstance(point, Point) and point not in self.nodes:
                named[point.behavior].add(point.sync)
        self._rigid: list[tuple[int, int]] = []
        self._knot_times: dict[int, float] = {}
        spans: list[_Span] = []
        for item in self._problem.items:
            id_, points = item.behavior.id, item.timing.points
            indices = [k for k, sync in enumerate(points) if k == 0 or sync in named[id_]]
            times = [self._times[Point(id_, sync)] for sync in points]
            self.knots[id_] = {}
            for k in indices:
                node = self.knots[id_][k] = self.nodes[Point(id_, points[k])] = len(self.nodes)
                self._knot_times[node] = times[k]
            for before, after in pairwise(indices):
                span = self._span(item, times, before, after, named=before > 0 or points[0] in named[id_])
                spans += [] if span is None else [span]
        for node in range(self.fixed, len(self.nodes)):
            self._groups.add(node)
        return spans

    def _span(self, item: Item, times: Sequence[float], before: int, after: int, *, named: bool) -> _Span | None:
        """The phases between two knots; None where they are rigid, and the knots are one root."""
        knots = self.knots[item.behavior.id]
        start, end = knots[before], knots[after]
        rigid, least, kinds = 0.0, 0.0, set[PhaseKind]()
        for k, phase in enumerate(item.timing.phases[before:after], before):
            if phase.kind is PhaseKind.RIGID and abs(times[k + 1] - times[k] - phase.duration) <= TIE_TOLERANCE:
                rigid += phase.duration
            elif (
                phase.kind is not PhaseKind.ELASTIC or phase.duration > 0 or phase.authored or named or _apart(times, k)
            ):
                kinds.add(phase.kind)
                if phase.kind is PhaseKind.ELASTIC and phase.duration > 0:
                    least = LEAST
        least = min(least, max(times[after] - times[before] - rigid, 0.0))
        if kinds:
            return _Span(start, end, rigid, least, PhaseKind.FREE not in kinds)
        if self._groups.union(end, start, rigid) is None:
            self._rigid.append((end, start))
        return None

    def _tie(self) -> list[tuple[int, int]]:
        """Make one what is tied, unless it is already; what is rigid goes before a tie that contradicts it."""
        pairs = [(tuple(self.nodes[node] for node in tie.nodes), tie.offset) for tie in self._problem.ties]
        return [(left, right) for (left, right), offset in pairs if self._groups.union(left, right, offset) is None]

    # --- roots

    def _position(self, node: int, outside: Collection[int]) -> Position:
        fixed, distance = self._groups.find(node)
        if fixed not in outside or node == fixed:
            return Position(fixed, distance)
        root = self._branches.pieces[node]
        return Position(root, distance - self._groups.find(root)[1])

    def _connected(self) -> OffsetUnionFind[int]:
        clusters = OffsetUnionFind[int]()
        for node in range(len(self.nodes)):
            clusters.add(node)
        for span in self._spans:
            if span.connects:
                clusters.union(self._groups.find(span.start)[0], self._groups.find(span.end)[0])
        return clusters

    def _note_leads(self) -> None:
        for node in range(self.fixed, len(self.nodes)):
            root, distance = self.position(node)
            if root >= self.fixed:
                self.leads[root] = min(distance, self.leads.get(root, distance))
                self._note_branch(root)

    def _note_branch(self, root: int) -> None:
        fixed, distance = self._groups.find(root)
        if fixed < self.fixed:
            host = self._branches.hosts[root]
            self.branches[root] = Position(host, distance - self._groups.find(host)[1])

    def _find_times(self) -> dict[int, float]:
        """Of the roots; a given one that is unknown is taken to be where it suits what is tied to it."""
        suiting: dict[int, float] = {}
        given_times = self._problem.given
        for node, time in self._knot_times.items():
            root, offset = self._groups.find(node)
            suiting.setdefault(root, time - offset)
        times = dict[int, float]()
        for root, name in enumerate(self.given):
            given = self._times[name] if isinstance(name, Point) else given_times[name]
            suits = suiting.get(root)
            if given is None or (suits is not None and abs(given - suits) > TIE_TOLERANCE):
                given = suits or 0.0
            times[root] = given
        return times | {root: self._knot_times[root] for root in self.roots[self.fixed :]}

    # --- edges

    @cached_property
    def _least_edges(self) -> list[Edge]:
        return self._edges(least=True)

    def _edges(self, *, least: bool) -> list[Edge]:
        """Of all spans as short as they may be (thesis 7.15), or of those with a preference, and these at nothing."""
        edges = (self._edge(span, span.least if least else 0.0) for span in self._spans if least or span.connects)
        return sorted((edge for edge in edges if least or edge.start != edge.end), key=self._turn)

    def _edge(self, span: _Span, least: float) -> Edge:
        (start, one), (end, two) = self.position(span.start), self.position(span.end)
        return Edge(start, end, one + span.rigid - two + least, one, two)

    def _turn(self, edge: Edge) -> tuple[float, float, Edge]:
        """By start; of those that start together, but for rounding, one that takes no time goes first."""
        return round(self.time(edge.start), 9), round(self.time(edge.end), 9), edge

    def _stops(self, given: Collection[int], edges: Sequence[Edge], sign: float) -> Stops:
        found: defaultdict[int, dict[int, float]] = defaultdict(dict)
        for _ in self.roots:
            moved = False
            for edge in edges:
                stops = {edge.start: 0.0} if edge.start in given else found[edge.start]
                for root, distance in stops.items():
                    old = found[edge.end].get(root)
                    if root != edge.end and (old is None or sign * (distance + edge.distance - old) > TOLERANCE):
                        found[edge.end][root], moved = distance + edge.distance, True
            if not moved:
                break
        return {
            root: [Position(stop, distance + self.leads[root]) for stop, distance in found[root].items()]
            for root in self.roots
        }

    def _nearest(self, given: Iterable[int], edges: Sequence[Edge], sign: float) -> dict[int, Position]:
        ends = set(given)
        found = {root: Position(root, 0.0) for root in ends}
        for _ in self.roots:
            moved = False
            for edge in edges:
                if edge.start not in found or edge.end in ends:
                    continue
                root, distance = found[edge.start]
                position = Position(root, distance + edge.distance)
                old = found.get(edge.end)
                if old is None or sign * (self.at(position) - self.at(old)) > TOLERANCE:
                    found[edge.end], moved = position, True
            if not moved:
                break
        return {root: position for root, position in found.items() if root not in ends}


def _apart(times: Sequence[float], phase: int) -> bool:
    """Whether a plan gives a phase some time."""
    return times[phase + 1] - times[phase] > TIE_TOLERANCE


def _given(problem: SchedulingProblem) -> dict[Node, int]:
    """What constraints name that is no point of the problem's behaviors, numbered."""
    own = {item.behavior.id for item in problem.items}
    named = (node for each in problem.constraints for node in each.nodes)
    given = (node for node in named if not isinstance(node, Point) or node.behavior not in own)
    return {node: number for number, node in enumerate(dict.fromkeys((Origin.BLOCK_START, *given)))}
