"""SmartBody's scheduling with Elckerlyc's sorting (thesis 7.2.2, 7.3.5)."""

from collections.abc import Iterable, Mapping
from math import isfinite

from reactive_realizer.errors import Fault, RealizerError, error
from reactive_realizer.pegboard.time_peg import TimeCell
from reactive_realizer.planunit.timing import SHORTEST
from reactive_realizer.scheduler.equalities import Equalities
from reactive_realizer.scheduler.losses import kept_of, lost_behavior, lost_constraint, with_required
from reactive_realizer.scheduler.placed import Placed, cells_of, check_given, check_playable, filled, is_past, moved
from reactive_realizer.scheduler.problem import (
    Anchor,
    AtBlock,
    AtOffset,
    Item,
    Loss,
    Node,
    Order,
    Origin,
    PegSpec,
    Point,
    Problem,
    Solution,
    Tie,
)
from reactive_realizer.scheduler.sorting import sort_items

_SAME = 1e-3
"""Times closer than this (s) are no contradiction for a rigid behavior."""


class SmartBodyStrategy:
    """Behaviors one by one, each tied to those already placed; at last free clusters are moved to the block start.

    It keeps no before/after constraints, and what it can place depends on the order of the behaviors (thesis 7.1.6):
    it is the reference that better strategies are measured by.
    """

    name = "smartbody"

    def solve(self, problem: Problem) -> Solution:
        """See `SchedulingStrategy`; the rest of what is lost is placed once more, as if that had never been."""
        left, lost = problem, list[Loss]()
        while (solution := _Run(left).solve()).losses:
            lost += [with_required(loss, problem) for loss in solution.losses]
            left = kept_of(left, solution)
        return Solution(solution.pegs, tuple(lost))


class _Run:
    """The work on one problem."""

    def __init__(self, problem: Problem) -> None:
        self._problem = problem
        self._ties = Equalities[Node](frozenset([Origin.BLOCK_START, *problem.times]))
        self._branches = Equalities[Node](frozenset())
        self._leads: dict[Node, float] = {}
        start = Anchor()
        self._start = Placed(AtBlock(start, 0.0), 0.0, start)
        self._classes: dict[Node, tuple[Placed, float]] = {Origin.BLOCK_START: (self._start, 0.0)}
        self._shared: dict[tuple[Node, float], Placed] = {}
        self._clusters: dict[Anchor, list[Anchor]] = {}
        self._placed: dict[str, list[Placed]] = {}
        self._losses: list[Loss] = []

    def solve(self) -> Solution:
        for tie in self._problem.ties:
            self._tie(tie)
        self._branch_off()
        self._losses += [_unkept(order) for order in self._problem.orders]
        for item in sort_items(self._problem, self._ties):
            try:
                self._place(item)
            except RealizerError as problem:
                self._losses.append(lost_behavior(item.behavior, problem.fault))
        self._normalize()
        return Solution({item.behavior.id: self._pegs(item) for item in self._kept()}, tuple(self._losses))

    def _tie(self, tie: Tie) -> None:
        gap = self._ties.tie(tie.left, tie.right, tie.offset)
        if gap is not None:
            code = "contradictory-tie" if isfinite(gap) else "outer-tie"
            self._losses.append(lost_constraint(tie, Fault(code, {"tie": tie.text, "gap": abs(gap)})))
        elif all(isinstance(node, Point) for node in tie.nodes):
            self._branches.tie(tie.left, tie.right, tie.offset)

    def _branch_off(self) -> None:
        """What hangs on a time from outside hangs there by the first point of what is tied together without that."""
        for node in (node for tie in self._problem.ties for node in tie.nodes):
            distance, branch = self._ties.find(node)[1], self._branches.find(node)[0]
            self._leads[branch] = min(distance, self._leads.get(branch, distance))

    def _place(self, item: Item) -> None:
        """Find the peg of every point; those of earlier behaviors stand."""
        tied = self._with_own_ties(item, self._known(item) or self._anchor(item))
        if item.timing.rigid:
            tied = self._met(item, tied)
        first = min(tied)
        known = self._not_before_the_block(item, {first: tied[first]} if item.timing.rigid else tied)
        check_given(item, known)
        placed = filled(item, known)
        if item.timing.rigid:  # it stays in one piece when its start has passed
            placed = filled(item, {0: placed[0]})
        check_playable(item, placed)
        self._join([point.anchor for point in (*tied.values(), *known.values())])
        self._accept(item, placed)

    def _known(self, item: Item) -> dict[int, Placed]:
        """The points whose class has a peg already, by index."""
        nodes = (Point(item.behavior.id, sync) for sync in item.timing.points)
        found = ((i, self._at(node)) for i, node in enumerate(nodes))
        return {i: placed for i, placed in found if placed is not None}

    def _at(self, node: Node) -> Placed | None:
        """The peg of all points at the distance of a node from the root of their class; None while nothing is there."""
        root, distance = self._ties.find(node)
        if not isinstance(root, Point | Origin):
            root = self._on_branch(root, self._branches.find(node)[0])
        key = (root, round(distance, 9))
        if key not in self._shared and root in self._classes:
            placed, at = self._classes[root]
            self._shared[key] = moved(placed, distance - at)
        return self._shared.get(key)

    def _on_branch(self, cell: TimeCell, branch: Node) -> Node:
        """What leads a branch on a time from outside, as a class of its own."""
        if branch not in self._classes:
            lead, time = self._leads[branch], self._problem.times[cell]
            placed = Placed(AtOffset(cell, lead), None if time is None else time + lead, None)
            self._classes[branch] = placed, lead
        return branch

    def _anchor(self, item: Item) -> dict[int, Placed]:
        """A behavior that hangs on nothing yet gets a free cluster, anchored at its first tied point or its start."""
        nodes = [Point(item.behavior.id, sync) for sync in item.timing.points]
        index = next((i for i, node in enumerate(nodes) if self._ties.tied(node)), 0)
        anchor = Anchor(item.timing.offsets[index], free=True)
        self._clusters[anchor] = [anchor]
        return {index: Placed(AtBlock(anchor, 0.0), anchor.time, anchor)}

    def _with_own_ties(self, item: Item, known: dict[int, Placed]) -> dict[int, Placed]:
        """Points that only the behavior itself ties to each other: the first stays where it would be, others follow."""
        leaders: dict[Node, tuple[int, float]] = {}
        for i, sync in enumerate(item.timing.points):
            root, distance = self._ties.find(Point(item.behavior.id, sync))
            leader, at = leaders.setdefault(root, (i, distance))
            if i not in known and leader != i:
                first = known.get(leader) or filled(item, known)[leader]
                known = {**known, leader: first, i: moved(first, distance - at)}
        return known

    def _met(self, item: Item, known: Mapping[int, Placed]) -> dict[int, Placed]:
        """The first point places a rigid behavior; a tie of another one that it cannot meet is lost: rigid wins."""
        met = {}
        for i, placed in sorted(known.items()):
            gap = self._gap(item, known, i)
            if gap is None or abs(gap) > _SAME:
                self._lose_ties(item, i, gap)
            else:
                met[i] = placed
        return met

    def _gap(self, item: Item, known: Mapping[int, Placed], index: int) -> float | None:
        """By how much (s) a rigid behavior placed by its first known point misses another; None if nobody knows yet."""
        first = min(known)
        preferred = item.timing.offsets[index] - item.timing.offsets[first]
        before, after = known[first].time, known[index].time
        if before is not None and after is not None:
            return after - before - preferred
        (root, here), (other, there) = (
            self._ties.find(Point(item.behavior.id, item.timing.points[i])) for i in (first, index)
        )
        return there - here - preferred if root == other else None

    def _not_before_the_block(self, item: Item, known: dict[int, Placed]) -> dict[int, Placed]:
        """A start before its block (thesis 7.13) is tied to the block's: the way to the first given point shortens.

        That binds neither free clusters, which are moved later, nor what hangs on an outer time that has passed.
        """
        times = {i: time for i in sorted(known) if (time := known[i].time) is not None}
        if not times:
            return known
        first, time = next(iter(times.items()))
        given, start = known[first], filled(item, known)[0].time
        early = -(time if start is None else start)
        if early <= SHORTEST or (given.anchor.free if given.anchor else self._joins_late(given)):
            return known
        if start is None or first == 0 or item.timing.rigid or time <= 0:
            raise error("before-block", early=early)
        return {0: self._start, **known}

    def _joins_late(self, placed: Placed) -> bool:
        """Whether an outer time that it hangs on is before the block, or brings a point there that is tied to it."""
        cells = cells_of(placed.spec)
        for tie in self._problem.ties:
            for cell in cells.intersection(tie.nodes):
                time = self._problem.times[cell]
                if time is not None and min(time, time + (tie.offset if tie.right is cell else -tie.offset)) < 0:
                    return True
        return False

    def _join(self, anchors: Iterable[Anchor | None]) -> None:
        """Clusters that a behavior ties together stay together; tied to something fixed they are free no more."""
        joined = [a for a in dict.fromkeys(anchors) if a is not None and a.free]
        fixed = len(joined) < len(dict.fromkeys(anchors))
        cluster = [member for anchor in joined for member in self._clusters[anchor]]
        for anchor in cluster:
            anchor.free = not fixed
            self._clusters[anchor] = cluster

    def _accept(self, item: Item, placed: list[Placed]) -> None:
        self._placed[item.behavior.id] = placed
        for sync, point in zip(item.timing.points, placed, strict=True):
            root, distance = self._ties.find(Point(item.behavior.id, sync))
            if isinstance(root, Point):
                # The first one leads: a point that a rigid behavior could not bring there is no measure for others.
                self._classes.setdefault(root, (point, distance))

    def _normalize(self) -> None:
        """Move every free cluster so that it starts with the block (thesis 7.24)."""
        earliest: dict[int, float] = {}
        for placed in self._placed.values():
            for point in placed:
                if point.anchor is not None and point.anchor.free and point.time is not None:
                    cluster = id(self._clusters[point.anchor])
                    earliest[cluster] = min(earliest.get(cluster, point.time), point.time)
        for anchor, members in self._clusters.items():
            if anchor.free:
                anchor.time -= earliest.get(id(members), 0.0)
        for item in self._kept():
            points = self._placed[item.behavior.id]
            # A later behavior may have tied a cluster to something fixed while it lay before the block.
            early = next((point for point in points if point.anchor is not None and is_past(point)), None)
            if early is not None:
                self._remove(item, Fault("before-block", {"early": -(early.time or 0.0)}))
            elif is_past(points[-1]):
                self._remove(item, Fault("all-past", {"late": -(points[-1].time or 0.0)}))

    def _remove(self, item: Item, fault: Fault) -> None:
        del self._placed[item.behavior.id]
        self._losses.append(lost_behavior(item.behavior, fault))

    def _lose_ties(self, item: Item, index: int, gap: float | None) -> None:
        """A point of a rigid behavior is not where its ties want it: so far (s) away, or nobody knows how far."""
        point, place = Point(item.behavior.id, item.timing.points[index]), item.behavior.location
        lost = [loss.constraint for loss in self._losses]
        for tie in self._problem.ties:
            if point in tie.nodes and tie not in lost:
                details = {"point": ":".join(point), "tie": tie.text, "gap": abs(gap or 0.0)}
                fault = Fault("outer-tie" if gap is None else "rigid", details).located(place.line, place.column)
                self._losses.append(Loss(item.behavior.id, fault, dropped=False, required=tie.required, constraint=tie))

    def _kept(self) -> list[Item]:
        return [item for item in self._problem.items if item.behavior.id in self._placed]

    def _pegs(self, item: Item) -> dict[str, PegSpec]:
        placed = self._placed[item.behavior.id]
        return {sync: point.spec for sync, point in zip(item.timing.points, placed, strict=True)}


def _unkept(order: Order) -> Loss:
    return lost_constraint(order, Fault("no-order", {"strategy": SmartBodyStrategy.name, "text": order.text}))
