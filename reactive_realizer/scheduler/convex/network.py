"""The roots of a timetable and the phases between them."""

from collections import defaultdict
from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import NamedTuple

from reactive_realizer.scheduler.convex.branches import Branches
from reactive_realizer.scheduler.convex.longest_path import TOLERANCE
from reactive_realizer.scheduler.convex.model import START
from reactive_realizer.scheduler.convex.recipes import Spot
from reactive_realizer.scheduler.convex.span import Span
from reactive_realizer.scheduler.convex.timetable import Timetable
from reactive_realizer.scheduler.problem import Point

Stops = Mapping[int, Sequence[Spot]]
"""By root, what its first point cannot pass in one direction."""


class Way(NamedTuple):
    """A span from root to root; if it lasted no time at all, ``end = start + distance``, s.

    Attributes:
        leaves: how much later (s) than its first root the span begins.
        enters: how much later (s) than the other one it ends.
    """

    start: int
    end: int
    distance: float
    leaves: float
    enters: float

    @property
    def back(self) -> "Way":
        """The same way in the other direction."""
        return Way(self.end, self.start, -self.distance, self.enters, self.leaves)


class Precedence(NamedTuple):
    """``later >= earlier + distance``, of roots.

    Attributes:
        own: whether the later one can be pushed: a point that does not stand at a time of the block.
    """

    later: int
    earlier: int
    distance: float
    own: bool


class Network:
    """Roots, their times, and ways between them.

    What hangs on a time from outside falls apart into `Branches`, each with a root of its own.

    Attributes:
        roots: in order; the fixed ones come first.
        fixed: number of fixed roots.
        branches: where the roots of branches hang.
        leads: how much later (s) than the root its first point is; 0 for fixed ones.
        ways: in order of time.
    """

    def __init__(self, table: Timetable) -> None:
        self._table = table
        self._model = table.model
        self.fixed = len(self._model.stage.fixed)
        self._outside = range(START + 1, self.fixed)
        self._branches = Branches(self._model.roots, self._outside)
        self._spots = [self._spot(node) for node in range(len(self._model.roots))]
        self.branches: dict[int, Spot] = {}
        self._hanging = table.grounded | {self.cluster(root) for root in range(self.fixed)}
        self.leads: dict[int, float] = dict.fromkeys(range(self.fixed), 0.0)
        for node in (node for knots in self._model.knots.values() for node in knots.values()):
            root, distance = self.spot(node)
            if root >= self.fixed:
                self.leads[root] = min(distance, self.leads.get(root, distance))
                self._note_branch(root)
        spans = [span for span in self._model.spans if span.costs]
        for root in (self.spot(node).root for span in spans for node in (span.start, span.end)):
            self.leads.setdefault(root, 0.0)
        self.roots = sorted(self.leads)
        self._times = {root: table.time(root) for root in {spot.root for spot in self._spots}}
        ways = [self._way(span) for span in spans]
        self.ways = sorted((w for w in ways if w.start != w.end), key=self._turn)

    def time(self, root: int) -> float:
        """Of a root, s after the block's start."""
        return self._times[root]

    def cluster(self, root: int) -> int:
        """The cluster of a root."""
        return self._table.clusters[self._model.place(root)[0]]

    def first_time(self, root: int) -> float:
        """Of the first point of a root, s after the block's start."""
        return self.time(root) + self.leads[root]

    def spot(self, node: int) -> Spot:
        """Where a node is."""
        return self._spots[node]

    def at(self, spot: Spot) -> float:
        """When, s after the block's start."""
        return self.time(spot.root) + spot.distance

    def is_rigid(self, branch: int) -> bool:
        """Whether a branch is more than one point."""
        return branch in self._branches.rigid

    def hangs(self, cluster: int) -> bool:
        """Whether something of it, or next to it, has its time from outside."""
        return cluster in self._hanging

    def precedences(self) -> list[Precedence]:
        """The orders between different roots."""
        found = []
        for order in self._model.stage.orders.values():
            late, early = (self.spot(self._model.nodes[node]) for node in order.nodes)
            if late.root != early.root:
                distance = order.offset + early.distance - late.distance
                own = isinstance(order.later, Point) and late.root != START
                found.append(Precedence(late.root, early.root, distance, own))
        return found

    def floors(self, given: Collection[int]) -> Stops:
        """What the first points of roots cannot come before: all given roots from which phases lead to them."""
        return self._stops(given, self._least_ways(), 1.0)

    def ceilings(self, given: Collection[int]) -> Stops:
        """What they cannot come after: all given roots to which phases lead."""
        return self._stops(given, [way.back for way in reversed(self._least_ways())], -1.0)

    def between(self, given: Collection[int]) -> bool:
        """Whether phases lead from or to more than one of them."""
        return len({root for way in self.ways for root in (way.start, way.end)}.intersection(given)) > 1

    def latest_before(self, given: Iterable[int]) -> dict[int, Spot]:
        """For each root that phases lead to from a given one: where it would be if these took no time.

        Of several the latest; the way goes no further than from one given root to the next.
        """
        return self._nearest(given, self.ways, 1.0)

    def earliest_after(self, given: Iterable[int]) -> dict[int, Spot]:
        """The same, backwards."""
        return self._nearest(given, [way.back for way in reversed(self.ways)], -1.0)

    def _least_ways(self) -> list[Way]:
        """All spans, also those of no preference, as short as they may be: thesis 7.15 holds for all."""
        ways = ((self._way(span), span.least) for span in self._model.spans)
        return sorted((way._replace(distance=way.distance + least) for way, least in ways), key=self._turn)

    def _stops(self, given: Collection[int], ways: Sequence[Way], sign: float) -> Stops:
        found: defaultdict[int, dict[int, float]] = defaultdict(dict)
        moved = True
        while moved:
            moved = False
            for way in ways:
                stops = {way.start: 0.0} if way.start in given else found[way.start]
                for root, distance in stops.items():
                    old = found[way.end].get(root)
                    if root != way.end and (old is None or sign * (distance + way.distance - old) > TOLERANCE):
                        found[way.end][root], moved = distance + way.distance, True
        return {
            root: [Spot(stop, distance + self.leads[root]) for stop, distance in found[root].items()]
            for root in self.roots
        }

    def _nearest(self, given: Iterable[int], ways: Sequence[Way], sign: float) -> dict[int, Spot]:
        ends = set(given)
        found = {root: Spot(root, 0.0) for root in ends}
        moved = True
        while moved:
            moved = False
            for way in ways:
                if way.start not in found or way.end in ends:
                    continue
                root, distance = found[way.start]
                spot = Spot(root, distance + way.distance)
                old = found.get(way.end)
                if old is None or sign * (self.at(spot) - self.at(old)) > TOLERANCE:
                    found[way.end], moved = spot, True
        return {root: spot for root, spot in found.items() if root not in ends}

    def _spot(self, node: int) -> Spot:
        fixed, distance = self._model.roots.find(node)
        root = self._branches.pieces[node]
        if fixed not in self._outside or node == fixed:
            return Spot(fixed, distance)
        return Spot(root, distance - self._model.roots.find(root)[1])

    def _turn(self, way: Way) -> tuple[float, float, Way]:
        """By start; of those that start together, but for rounding, one that takes no time goes first."""
        return round(self._times[way.start], 9), round(self._times[way.end], 9), way

    def _note_branch(self, root: int) -> None:
        fixed, distance = self._model.roots.find(root)
        if fixed < self.fixed:
            host = self._branches.hosts[root]
            self.branches[root] = Spot(host, distance - self._model.roots.find(host)[1])

    def _way(self, span: Span) -> Way:
        (start, one), (end, two) = self.spot(span.start), self.spot(span.end)
        return Way(start, end, one + span.rigid - two, one, two)
