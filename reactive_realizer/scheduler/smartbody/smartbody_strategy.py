"""SmartBody's scheduling with Elckerlyc's sorting (thesis 7.2.2, 7.3.5)."""

from collections.abc import Mapping
from math import isfinite

from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.planunit.timing import SHORTEST
from reactive_realizer.scheduler.faults import AllPast, BeforeBlock, ContradictoryTie, NoOrder, OuterTie, Rigid
from reactive_realizer.scheduler.losses import lost_behavior, lost_constraint, with_required
from reactive_realizer.scheduler.offset_union_find import TIE_TOLERANCE, OffsetUnionFind
from reactive_realizer.scheduler.problem import (
    Item,
    Loss,
    Node,
    Origin,
    Point,
    Precedence,
    SchedulingProblem,
    Solution,
    Tie,
)
from reactive_realizer.scheduler.smartbody.placement import Cluster, Fixed, Placement, check_given, check_playable, fill
from reactive_realizer.scheduler.smartbody.sorting import sort_items

_SAME = 1e-3
"""Times closer than this (s) are no contradiction for a rigid behavior."""


class SmartBodyStrategy:
    """Behaviors one by one, each tied to those already placed; at last free clusters are moved to the block start.

    It keeps no before/after constraints, and what it can place depends on the order of the behaviors (thesis 7.1.6):
    it is the reference that better strategies are measured by.
    """

    name = "smartbody"

    def solve(self, problem: SchedulingProblem) -> Solution:
        """See `SchedulingStrategy`; the rest of what is lost is placed once more, as if that had never been."""
        left, lost = problem, list[Loss]()
        while (solution := _Run(left).solve()).losses:
            lost += [with_required(loss, problem) for loss in solution.losses]
            left = solution.kept_of(left)
        return Solution(solution.times, tuple(lost))


class _Run:
    """The work on one problem."""

    def __init__(self, problem: SchedulingProblem) -> None:
        self._problem = problem
        self._given = problem.given
        self._ties = OffsetUnionFind[Node](self._given)
        self._tied: set[Node] = set()
        self._start = Placement(0.0, known=True, cluster=Fixed.BLOCK_START)
        self._roots: dict[Node, tuple[Placement, float]] = {Origin.BLOCK_START: (self._start, 0.0)}
        self._clusters = OffsetUnionFind[Cluster](Fixed)
        self._placed: dict[str, list[Placement]] = {}
        self._losses: list[Loss] = []

    def solve(self) -> Solution:
        for tie in self._problem.ties:
            self._tie(tie)
        self._losses += [_unkept(order) for order in self._problem.orders]
        for item in sort_items(self._problem, self._ties):
            try:
                self._place(item)
            except RealizerError as problem:
                self._losses.append(lost_behavior(item.behavior, problem.fault))
        earliest = self._earliest()
        self._drop_past()
        times = {
            Point(item.behavior.id, sync): placed.time - earliest.get(self._cluster(placed), 0.0)
            for item in self._kept()
            for sync, placed in zip(item.timing.points, self._placed[item.behavior.id], strict=True)
        }
        return Solution(times, tuple(self._losses))

    def _tie(self, tie: Tie) -> None:
        gap = self._ties.union(tie.left, tie.right, tie.offset)
        if gap is None:
            self._tied |= {*tie.nodes}
        elif abs(gap) > TIE_TOLERANCE:
            contradiction = ContradictoryTie(tie=tie.text, gap=abs(gap))
            self._losses.append(lost_constraint(tie, contradiction if isfinite(gap) else OuterTie(tie=tie.text)))

    def _place(self, item: Item) -> None:
        """Find the place of every point; those of earlier behaviors stand."""
        tied = self._with_own_ties(item, self._known(item) or self._anchor(item))
        if item.timing.rigid:
            tied = self._met(item, tied)
        first = min(tied)
        known = self._not_before_the_block(item, {first: tied[first]} if item.timing.rigid else tied)
        check_given(item, known)
        placed = fill(item, known)
        if item.timing.rigid:  # it stays in one piece when its start has passed
            placed = fill(item, {0: placed[0]})
        check_playable(item, placed)
        first_cluster, *others = [placed.cluster for placed in (*tied.values(), *known.values())]
        for cluster in others:
            self._clusters.union(first_cluster, cluster)
        self._accept(item, placed)

    def _known(self, item: Item) -> dict[int, Placement]:
        """The points whose places follow from ties to what stands already, by index."""
        nodes = [Point(item.behavior.id, sync) for sync in item.timing.points]
        known = {i: placed for i, node in enumerate(nodes) if (placed := self._at(node)) is not None}
        for i, node in enumerate(nodes):
            root, distance = self._ties.find(node)
            if i not in known and root in self._given:
                suits = fill(item, known)[i].time if known else item.timing.offsets[i]
                self._roots[root] = (
                    Placement(suits, known=False, cluster=Fixed.OUTSIDE, outer=frozenset([root])),
                    distance,
                )
                known = {k: placed for k, node in enumerate(nodes) if (placed := self._at(node)) is not None}
        return known

    def _at(self, node: Node) -> Placement | None:
        """The place of a node, at its distance from the root of what it is tied to; None while nothing is there."""
        root, distance = self._ties.find(node)
        if root not in self._roots and (time := self._given.get(root)) is not None:
            self._roots[root] = Placement(time, known=True, cluster=Fixed.OUTSIDE, outer=frozenset([root])), 0.0
        if root not in self._roots:
            return None
        placed, at = self._roots[root]
        return placed.moved(distance - at)

    def _anchor(self, item: Item) -> dict[int, Placement]:
        """A behavior that hangs on nothing yet begins a cluster with its first tied point, or its start."""
        nodes = [Point(item.behavior.id, sync) for sync in item.timing.points]
        index = next((i for i, node in enumerate(nodes) if node in self._tied), 0)
        return {index: Placement(item.timing.offsets[index], known=True, cluster=item.behavior.id)}

    def _with_own_ties(self, item: Item, known: dict[int, Placement]) -> dict[int, Placement]:
        """Points that only the behavior itself ties to each other: the first stays where it would be, others follow."""
        leaders: dict[Node, tuple[int, float]] = {}
        for i, sync in enumerate(item.timing.points):
            root, distance = self._ties.find(Point(item.behavior.id, sync))
            leader, at = leaders.setdefault(root, (i, distance))
            if i not in known and leader != i:
                first = known.get(leader) or fill(item, known)[leader]
                known = {**known, leader: first, i: first.moved(distance - at)}
        return known

    def _met(self, item: Item, known: Mapping[int, Placement]) -> dict[int, Placement]:
        """The first point places a rigid behavior; a tie of another one that it cannot meet is lost: rigid wins."""
        met = {}
        for i, placed in sorted(known.items()):
            gap = self._gap(item, known, i)
            if gap is None or abs(gap) > _SAME:
                self._lose_ties(item, i, gap)
            else:
                met[i] = placed
        return met

    def _gap(self, item: Item, known: Mapping[int, Placement], index: int) -> float | None:
        """By how much (s) a rigid behavior placed by its first known point misses another; None if nobody knows yet."""
        first = min(known)
        preferred = item.timing.offsets[index] - item.timing.offsets[first]
        before, after = known[first], known[index]
        if before.known and after.known:
            return after.time - before.time - preferred
        (root, here), (other, there) = (
            self._ties.find(Point(item.behavior.id, item.timing.points[i])) for i in (first, index)
        )
        return there - here - preferred if root == other else None

    def _not_before_the_block(self, item: Item, known: dict[int, Placement]) -> dict[int, Placement]:
        """A start before its block (thesis 7.13) is tied to the block's: the way to the first given point shortens.

        That binds neither free clusters, which are moved later, nor what hangs on an outer time that has passed.
        """
        first = min((i for i, placed in known.items() if placed.known), default=None)
        if first is None:
            return known
        given, start = known[first], fill(item, known)[0]
        early = -(start if start.known else given).time
        if early <= SHORTEST or self._is_free(given) or self._joins_late(given):
            return known
        if not start.known or first == 0 or item.timing.rigid or given.time <= 0:
            raise RealizerError(BeforeBlock(early=early))
        return {0: self._start, **known}

    def _joins_late(self, given: Placement) -> bool:
        """Whether an outer time that it hangs on is before the block, or brings a point there that is tied to it."""
        for tie in self._problem.ties if given.cluster is Fixed.OUTSIDE else ():
            for node in given.outer.intersection(tie.nodes):
                time, offset = self._given[node], tie.offset if tie.right == node else -tie.offset
                if time is not None and time + (0.0 if isinstance(node, Point) else min(0.0, offset)) < 0:
                    return True
        return False

    def _cluster(self, placed: Placement) -> Cluster:
        return self._clusters.find(placed.cluster)[0]

    def _is_free(self, placed: Placement) -> bool:
        """Whether its cluster is tied to nothing fixed, and is moved at last."""
        return isinstance(self._cluster(placed), str)

    def _accept(self, item: Item, placed: list[Placement]) -> None:
        self._placed[item.behavior.id] = placed
        for sync, point in zip(item.timing.points, placed, strict=True):
            root, distance = self._ties.find(Point(item.behavior.id, sync))
            if isinstance(root, Point):
                # The first one leads: a point that a rigid behavior could not bring there is no measure for others.
                self._roots.setdefault(root, (point, distance))

    def _earliest(self) -> dict[Cluster, float]:
        """By how much (s) each free cluster is moved back so that it starts with the block (thesis 7.24)."""
        earliest: dict[Cluster, float] = {}
        for placed in (placed for points in self._placed.values() for placed in points if self._is_free(placed)):
            cluster = self._cluster(placed)
            earliest[cluster] = min(earliest.get(cluster, placed.time), placed.time)
        return earliest

    def _drop_past(self) -> None:
        """A later behavior may have tied a cluster to something fixed while it lay before the block."""
        for item in self._kept():
            points = self._placed[item.behavior.id]
            past = [placed for placed in points if self._is_past(placed)]
            early = next((placed for placed in past if placed.cluster is not Fixed.OUTSIDE), None)
            if early is not None:
                self._remove(item, BeforeBlock(early=-early.time))
            elif self._is_past(points[-1]):
                self._remove(item, AllPast(late=-points[-1].time))

    def _is_past(self, placed: Placement) -> bool:
        return placed.known and placed.time < -SHORTEST and not self._is_free(placed)

    def _remove(self, item: Item, fault: Fault) -> None:
        del self._placed[item.behavior.id]
        self._losses.append(lost_behavior(item.behavior, fault))

    def _lose_ties(self, item: Item, index: int, gap: float | None) -> None:
        """A point of a rigid behavior is not where its ties want it: so far (s) away, or nobody knows how far."""
        point, place = Point(item.behavior.id, item.timing.points[index]), item.behavior.location
        lost = [loss.constraint for loss in self._losses]
        for tie in self._problem.ties:
            if point in tie.nodes and tie not in lost:
                rigid = Rigid(tie=tie.text, point=":".join(point), gap=abs(gap or 0.0))
                fault = OuterTie(tie=tie.text) if gap is None else rigid
                located = fault.located(place.line, place.column)
                self._losses.append(
                    Loss(item.behavior.id, located, dropped=False, required=tie.required, constraint=tie)
                )

    def _kept(self) -> list[Item]:
        return [item for item in self._problem.items if item.behavior.id in self._placed]


def _unkept(order: Precedence) -> Loss:
    return lost_constraint(order, NoOrder(strategy=SmartBodyStrategy.name, text=order.text))
