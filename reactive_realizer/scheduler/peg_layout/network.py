"""The points of a plan as a network: roots, and the phases between them."""

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import NamedTuple

from reactive_realizer.scheduler.offset_union_find import TIE_TOLERANCE, OffsetUnionFind
from reactive_realizer.scheduler.peg_layout.branches import Branches
from reactive_realizer.scheduler.peg_layout.knots import START, KnotPhases, Knots
from reactive_realizer.scheduler.peg_layout.peg_rules import Position
from reactive_realizer.scheduler.problem import Node, Point, SchedulingProblem

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


class Network:
    """Behaviors of a plan, their roots, and the edges between these.

    Nodes at fixed offsets from each other share a *root*, which is one of them. What depends on a time from
    outside is divided into `Branches`, each with a root of its own. A *cluster* is what edges connect.

    Args:
        problem: behaviors that are laid out together, and the kept constraints on them.
        times: of all points of the plan, s after the block's start.

    Attributes:
        knots: the nodes.
        fixed: number of given nodes.
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
        self.knots = Knots(problem, times)
        self.fixed = self.knots.fixed
        self._phases = [each for each in self.knots.phases if each.flexible]
        rigid = [(each.end, each.start, each.rigid) for each in self.knots.phases if not each.flexible]
        self._found, links = self._tie(rigid)
        pairs = [(end, start) for end, start, _ in rigid]
        self._branches = Branches(len(self.knots.nodes), range(START + 1, self.fixed), pairs, links)
        self.positions = [self._position(node) for node in range(len(self.knots.nodes))]
        self.leads = self._find_leads()
        self.roots = sorted(self.leads)
        self.branches = self._find_branches()
        self.times = self._find_times(times)
        self.first_times = {root: time + self.leads[root] for root, time in self.times.items()}
        self.clusters = self._find_clusters()
        self.anchored = {self.clusters[root] for root in range(self.fixed)}
        self.edges = self._edges(least=False)

    @property
    def given(self) -> Sequence[Node]:
        """The nodes that have pegs already; the start of the block is the first."""
        return list(self.knots.nodes)[: self.fixed]

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
            late, early = (self.positions[self.knots.nodes[node]] for node in order.nodes)
            if late.root != early.root:
                distance = order.offset + early.offset - late.offset
                own = isinstance(order.later, Point) and late.root != START
                found.append(RootPrecedence(late.root, early.root, distance, own))
        return found

    @cached_property
    def least_edges(self) -> Sequence[Edge]:
        """The edges of all phases at their shortest durations (thesis 7.15)."""
        return self._edges(least=True)

    # --- roots

    def _tie(self, rigid: Sequence[tuple[int, int, float]]) -> tuple[list[tuple[int, float]], list[tuple[int, int]]]:
        """Group the nodes at fixed offsets; rigid phases go before a tie that contradicts them.

        Returns:
            The root of the group of each node with the offset (s) from it; and the pairs that ties connect.
        """
        groups = OffsetUnionFind[int](range(self.fixed))
        for end, start, duration in rigid:
            groups.union(end, start, duration)
        for node in range(self.fixed, len(self.knots.nodes)):
            groups.add(node)
        links = []
        for tie in self._problem.ties:
            left, right = self.knots.nodes[tie.left], self.knots.nodes[tie.right]
            if groups.union(left, right, tie.offset) is None:
                links.append((left, right))
        return [groups.find(node) for node in range(len(self.knots.nodes))], links

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

    def _find_times(self, times: Mapping[Point, float]) -> dict[int, float]:
        """The times of the roots; an unknown given one gets the time that suits what is tied to it."""
        suiting: dict[int, float] = {}
        for knot, time in self.knots.times.items():
            root, offset = self._found[knot]
            if root < self.fixed:
                suiting.setdefault(root, time - offset)
        known = self._problem.given
        found = dict[int, float]()
        for root, node in enumerate(self.given):
            given = times[node] if isinstance(node, Point) else known[node]
            suits = suiting.get(root)
            if given is None or (suits is not None and abs(given - suits) > TIE_TOLERANCE):
                given = suits or 0.0
            found[root] = given
        return found | {root: self.knots.times[root] for root in self.roots[self.fixed :]}

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

    def _edge(self, phases: KnotPhases, least: float) -> Edge:
        (start, leaves), (end, enters) = self.positions[phases.start], self.positions[phases.end]
        return Edge(start, end, leaves + phases.rigid - enters + least, leaves, enters)

    def _turn(self, edge: Edge) -> tuple[float, float, Edge]:
        """By start; of edges that start together, but for rounding, one that takes no time goes first."""
        return round(self.times[edge.start], 9), round(self.times[edge.end], 9), edge
