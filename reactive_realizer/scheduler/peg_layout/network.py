"""The points of a plan as a network: roots, and the phases between them."""

from collections import defaultdict
from collections.abc import Collection, Mapping, Sequence
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


class Edge(NamedTuple):
    """Phases from root to root; if the elastic ones lasted no time at all, ``end = start + distance``, s.

    Attributes:
        leaves: offset (s) from the first root at which the edge begins.
        enters: offset (s) from the other one at which it ends.
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
        own: whether the later one can be pushed: a point of the block that is not tied to its start.
    """

    later: int
    earlier: int
    distance: float
    own: bool


class _Phases(NamedTuple):
    """The phases between two knots of a behavior.

    Attributes:
        start: node of the earlier knot.
        end: node of the later one.
        rigid: duration of the rigid ones, s.
        least: shortest duration of the others, s.
        flexible: whether there are others; if not, the knots share a root.
        connects: whether all of them have preferred durations.
    """

    start: int
    end: int
    rigid: float
    least: float
    flexible: bool
    connects: bool


class Network:
    """Behaviors of a plan, their roots, and the edges between these.

    A *knot* is a point that a constraint names, or the first point of a behavior. Knots and given points are numbered
    nodes. Nodes at fixed offsets from each other share a *root*, which is one of them. What depends on a time from
    outside is divided into `Branches`, each with a root of its own. A *cluster* is what edges connect.

    Args:
        problem: behaviors that are laid out together, and the kept constraints on them.
        times: of all points of the plan, s after the block's start.

    Attributes:
        nodes: number of each knot; given points come first, and the start of the block is the first of these.
        fixed: number of given nodes.
        knots: nodes of each behavior, by index of the point.
        positions: of the nodes.
        roots: in order; the given ones come first.
        branches: positions of the roots of branches on other roots.
        leads: offset (s) of the first point of each root; 0 for given ones.
        times: of the roots, s after the block's start.
        first_times: of the first points of the roots; likewise.
        clusters: of the roots.
        anchored: the clusters that contain a given root.
        edges: in order of time.
    """

    def __init__(self, problem: SchedulingProblem, times: Mapping[Point, float]) -> None:
        self._problem = problem
        self._times = times
        self.nodes = _given(problem)
        self.fixed = len(self.nodes)
        self.knots: dict[str, dict[int, int]] = {}
        self._knot_times: dict[int, float] = {}
        phases = self._add_knots()
        self._phases = [each for each in phases if each.flexible]
        rigid = [(each.end, each.start, each.rigid) for each in phases if not each.flexible]
        self._found, links = self._tie(rigid)
        pairs = [(end, start) for end, start, _ in rigid]
        self._branches = Branches(len(self.nodes), range(START + 1, self.fixed), pairs, links)
        self.positions = [self._position(node) for node in range(len(self.nodes))]
        self.leads = self._find_leads()
        self.roots = sorted(self.leads)
        self.branches = self._find_branches()
        self.times = self._find_times()
        self.first_times = {root: time + self.leads[root] for root, time in self.times.items()}
        self.clusters = self._find_clusters()
        self.anchored = {self.clusters[root] for root in range(self.fixed)}
        self.edges = self._edges(least=False)

    @property
    def given(self) -> Sequence[Node]:
        """The nodes that have pegs already; the start of the block is the first."""
        return list(self.nodes)[: self.fixed]

    def at(self, position: Position) -> float:
        """The time of a position, s after the block's start."""
        return self.times[position.root] + position.offset

    def is_rigid(self, branch: int) -> bool:
        """Whether a branch has more than one point."""
        return branch in self._branches.rigid

    def precedences(self) -> list[RootPrecedence]:
        """The before/after constraints between different roots."""
        found = []
        for order in self._problem.orders:
            late, early = (self.positions[self.nodes[node]] for node in order.nodes)
            if late.root != early.root:
                distance = order.offset + early.offset - late.offset
                own = isinstance(order.later, Point) and late.root != START
                found.append(RootPrecedence(late.root, early.root, distance, own))
        return found

    @cached_property
    def least_edges(self) -> Sequence[Edge]:
        """The edges of all phases at their shortest durations (thesis 7.15)."""
        return self._edges(least=True)

    # --- nodes

    def _add_knots(self) -> list[_Phases]:
        named: defaultdict[str, set[str]] = defaultdict(set)
        for each in self._problem.constraints:
            for node in each.nodes:
                if isinstance(node, Point) and node not in self.nodes:
                    named[node.behavior].add(node.sync)
        phases: list[_Phases] = []
        for item in self._problem.items:
            names = named.get(item.behavior.id, ())
            knots = {k: len(self.nodes) + n for n, k in enumerate(_knots(item, names))}
            self.nodes.update({item.points[k]: node for k, node in knots.items()})
            self._knot_times.update({node: self._times[item.points[k]] for k, node in knots.items()})
            self.knots[item.behavior.id] = knots
            for before, after in pairwise(knots):
                named_both = before > 0 or item.timing.points[0] in names
                phases.append(self._between(item, before, after, named=named_both))
        return phases

    def _between(self, item: Item, before: int, after: int, *, named: bool) -> _Phases:
        """The phases between two knots; if constraints name both, an elastic one of no duration can be forced apart."""
        knots, times, points = self.knots[item.behavior.id], self._times, item.points
        rigid, least, flexible, connects = 0.0, 0.0, False, True
        for k in range(before, after):
            phase = item.timing.phases[k]
            kind, duration, planned = phase.kind, phase.duration, times[points[k + 1]] - times[points[k]]
            if kind is PhaseKind.RIGID and abs(planned - duration) <= TIE_TOLERANCE:
                rigid += duration
            elif kind is not PhaseKind.ELASTIC or duration > 0 or named or phase.authored or planned > TIE_TOLERANCE:
                flexible, connects = True, connects and kind is not PhaseKind.FREE
                if kind is PhaseKind.ELASTIC and duration > 0:
                    least = LEAST
        if flexible:
            least = min(least, max(times[points[after]] - times[points[before]] - rigid, 0.0))
        return _Phases(knots[before], knots[after], rigid, least, flexible, connects)

    def _tie(self, rigid: Sequence[tuple[int, int, float]]) -> tuple[list[tuple[int, float]], list[tuple[int, int]]]:
        """Group the nodes at fixed offsets; rigid phases go before a tie that contradicts them.

        Returns:
            The root of the group of each node with the offset (s) from it; and the pairs that ties connect.
        """
        groups = OffsetUnionFind[int](range(self.fixed))
        for end, start, duration in rigid:
            groups.union(end, start, duration)
        for node in range(self.fixed, len(self.nodes)):
            groups.add(node)
        links = []
        for tie in self._problem.ties:
            left, right = self.nodes[tie.left], self.nodes[tie.right]
            if groups.union(left, right, tie.offset) is None:
                links.append((left, right))
        return [groups.find(node) for node in range(len(self.nodes))], links

    # --- roots

    def _position(self, node: int) -> Position:
        root, offset = self._found[node]
        if not START < root < self.fixed or node == root:
            return Position(root, offset)
        branch = self._branches.pieces[node]
        return Position(branch, offset - self._found[branch][1])

    def _find_leads(self) -> dict[int, float]:
        leads = dict.fromkeys(range(self.fixed), 0.0)
        for root, offset in self.positions[self.fixed :]:
            if root >= self.fixed:
                leads[root] = min(offset, leads.get(root, offset))
        return leads

    def _find_branches(self) -> dict[int, Position]:
        branches = {}
        for root in self.roots[self.fixed :]:
            group, offset = self._found[root]
            if group < self.fixed:
                host = self._branches.hosts[root]
                branches[root] = Position(host, offset - self._found[host][1])
        return branches

    def _find_times(self) -> dict[int, float]:
        """The times of the roots; an unknown given one gets the time that suits what is tied to it."""
        suiting: dict[int, float] = {}
        for knot, time in self._knot_times.items():
            root, offset = self._found[knot]
            if root < self.fixed:
                suiting.setdefault(root, time - offset)
        known = self._problem.given
        found = dict[int, float]()
        for root, node in enumerate(self.given):
            given = self._times[node] if isinstance(node, Point) else known[node]
            suits = suiting.get(root)
            if given is None or (suits is not None and abs(given - suits) > TIE_TOLERANCE):
                given = suits or 0.0
            found[root] = given
        return found | {root: self._knot_times[root] for root in self.roots[self.fixed :]}

    def _find_clusters(self) -> dict[int, int]:
        clusters = OffsetUnionFind[int]()
        for each in self._phases:
            if each.connects:
                clusters.union(self._found[each.start][0], self._found[each.end][0])
        return {root: clusters.find(self._found[root][0])[0] for root in self.roots}

    # --- edges

    def _edges(self, *, least: bool) -> list[Edge]:
        """The edges of all phases at their shortest, or of those with preferred durations, and these at nothing."""
        edges = [self._edge(each, each.least if least else 0.0) for each in self._phases if least or each.connects]
        return sorted((edge for edge in edges if least or edge.start != edge.end), key=self._turn)

    def _edge(self, phases: _Phases, least: float) -> Edge:
        (start, leaves), (end, enters) = self.positions[phases.start], self.positions[phases.end]
        return Edge(start, end, leaves + phases.rigid - enters + least, leaves, enters)

    def _turn(self, edge: Edge) -> tuple[float, float, Edge]:
        """By start; of edges that start together, but for rounding, one that takes no time goes first."""
        return round(self.times[edge.start], 9), round(self.times[edge.end], 9), edge


def _given(problem: SchedulingProblem) -> dict[Node, int]:
    """The nodes that constraints name and that are no points of the problem's behaviors, numbered."""
    own = {item.behavior.id for item in problem.items}
    nodes: dict[Node, int] = {Origin.BLOCK_START: START}
    for each in problem.constraints:
        for node in each.nodes:
            if not isinstance(node, Point) or node.behavior not in own:
                nodes.setdefault(node, len(nodes))
    return nodes


def _knots(item: Item, named: Collection[str]) -> list[int]:
    return [k for k, sync in enumerate(item.timing.points) if k == 0 or sync in named]
