"""SmartBody's scheduling with Elckerlyc's sorting (thesis 7.2.2, 7.3.5)."""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from math import isfinite

from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.planunit.timing import SHORTEST
from reactive_realizer.scheduler.faults import (
    BeforeBlock,
    ContradictoryTie,
    NoOrder,
    OuterTie,
    Rigid,
    TooHurried,
)
from reactive_realizer.scheduler.offset_union_find import TIE_TOLERANCE, OffsetUnionFind
from reactive_realizer.scheduler.problem import Item, Node, Origin, Point, SchedulingProblem, Tie
from reactive_realizer.scheduler.smartbody.placement import (
    Cluster,
    Placement,
    check_given,
    check_playable,
    fill,
    squeeze,
)
from reactive_realizer.scheduler.solution import Loss, Solution, lost_behavior, lost_constraint, with_required

_SAME = 1e-3
"""A rigid behavior may miss a time by less (s)."""


class SmartBodyStrategy:
    """Places behaviors one by one, each by its ties to earlier ones; then moves free clusters to the block's start.

    It keeps no before/after constraints, and its plans depend on the order of the behaviors (thesis 7.1.6). It is the
    reference for better strategies.
    """

    name = "smartbody"

    def solve(self, problem: SchedulingProblem) -> Solution:
        """See `SchedulingStrategy`; after a loss, the rest is placed again without it."""
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
        self._start = Placement(0.0, known=True, cluster=Origin.BLOCK_START)
        self._roots: dict[Node, tuple[Placement, float]] = {Origin.BLOCK_START: (self._start, 0.0)}
        self._clusters = OffsetUnionFind[Cluster]([Origin.BLOCK_START])
        self._placed: dict[str, list[Placement]] = {}
        self._losses: list[Loss] = []

    def solve(self) -> Solution:
        for tie in self._problem.ties:
            self._tie(tie)
        for order in self._problem.orders:
            self._losses.append(lost_constraint(order, NoOrder(strategy=SmartBodyStrategy.name, text=order.text)))
        for item in _sorted(self._problem, self._ties):
            try:
                self._place(item)
            except RealizerError as problem:
                self._losses.append(lost_behavior(item.behavior, problem.fault))
        earliest = self._earliest()
        for item in self._problem.items:
            fault = self._past(self._placed.get(item.behavior.id, ()))
            if fault is not None:
                del self._placed[item.behavior.id]
                self._losses.append(lost_behavior(item.behavior, fault))
        times = {
            point: placed.time - earliest.get(self._cluster(placed), 0.0)
            for item in self._problem.items
            if item.behavior.id in self._placed
            for point, placed in zip(item.points, self._placed[item.behavior.id], strict=True)
        }
        return Solution(times, tuple(self._losses))

    def _tie(self, tie: Tie) -> None:
        gap = self._ties.union(tie.left, tie.right, tie.offset)
        if gap is None:
            self._tied.update(tie.nodes)
        elif abs(gap) > TIE_TOLERANCE:
            contradiction = ContradictoryTie(tie=tie.text, gap=abs(gap))
            self._losses.append(lost_constraint(tie, contradiction if isfinite(gap) else OuterTie(tie=tie.text)))

    def _place(self, item: Item) -> None:
        """Place every point of a behavior; the placements of earlier behaviors stay."""
        points = item.points
        tied = self._known(item, points)
        if not tied:  # it begins a cluster with its first tied point, or its start
            first = next((i for i, point in enumerate(points) if point in self._tied), 0)
            tied = {first: Placement(item.timing.offsets[first], known=True, cluster=item.behavior.id)}
        tied = self._with_own_ties(item, points, tied)
        if item.timing.rigid:
            tied = self._met(item, points, tied)
        first = min(tied)
        known = self._not_before_the_block(item, {first: tied[first]} if item.timing.rigid else tied)
        check_given(item, known)
        if not item.timing.rigid:
            known = self._unsqueezed(item, points, known)
        placed = fill(item, known)
        if item.timing.rigid:  # it stays in one piece when its start has passed
            placed = fill(item, {0: placed[0]})
        check_playable(item, placed)
        cluster, *others = [placed.cluster for placed in (*tied.values(), *known.values())]
        for other in others:
            self._clusters.union(cluster, other)
        self._placed[item.behavior.id] = placed
        for point, placement in zip(points, placed, strict=True):
            root, distance = self._ties.find(point)
            if isinstance(root, Point):
                # The first one counts: a rigid behavior may have missed its place, which is no measure for others.
                # It counts as known, so that what is also tied to known times has the time that it needs.
                self._roots.setdefault(root, (placement._replace(known=True), distance))

    def _known(self, item: Item, points: Sequence[Point]) -> dict[int, Placement]:
        """The points that are tied to placed or given ones, by index."""
        known = self._all_at(points)
        for i, point in enumerate(points):
            root, distance = self._ties.find(point)
            if i not in known and root in self._given:
                suits = fill(item, known)[i].time if known else item.timing.offsets[i]
                self._roots[root] = Placement(suits, known=False, cluster=root), distance
                known = self._all_at(points)
        return known

    def _all_at(self, points: Sequence[Point]) -> dict[int, Placement]:
        return {i: placed for i, point in enumerate(points) if (placed := self._at(point)) is not None}

    def _at(self, point: Point) -> Placement | None:
        """The placement of a point by the root of its ties; None while that has none."""
        root, distance = self._ties.find(point)
        if root not in self._roots and (time := self._given.get(root)) is not None:
            self._roots[root] = Placement(time, known=True, cluster=Origin.BLOCK_START), 0.0
        if root not in self._roots:
            return None
        placed, at = self._roots[root]
        return placed.moved(distance - at)

    def _with_own_ties(self, item: Item, points: Sequence[Point], known: dict[int, Placement]) -> dict[int, Placement]:
        """Also the points that the behavior ties to each other: the first one has its place, the others follow it."""
        leaders: dict[Node, tuple[int, float]] = {}
        for i, point in enumerate(points):
            root, distance = self._ties.find(point)
            leader, at = leaders.setdefault(root, (i, distance))
            if i not in known and leader != i:
                first = known.get(leader) or fill(item, known)[leader]
                known = {**known, leader: first, i: first.moved(distance - at)}
        return known

    def _met(self, item: Item, points: Sequence[Point], known: Mapping[int, Placement]) -> dict[int, Placement]:
        """The points that a rigid behavior placed by its first one meets; the ties of the others are lost."""
        met, first = {}, min(known)
        for i, placed in sorted(known.items()):
            gap = self._gap(item, points, known, first, i)
            if gap is not None and abs(gap) <= _SAME:
                met[i] = placed
                continue
            lost = [loss.constraint for loss in self._losses]
            for tie in (tie for tie in self._problem.ties if points[i] in tie.nodes and tie not in lost):
                rigid = Rigid(tie=tie.text, point=":".join(points[i]), gap=abs(gap or 0.0))
                place, fault = item.behavior.location, OuterTie(tie=tie.text) if gap is None else rigid
                located = fault.located(place.line, place.column)
                self._losses.append(Loss(item.behavior.id, located, False, tie.required, tie))
        return met

    def _unsqueezed(self, item: Item, points: Sequence[Point], known: dict[int, Placement]) -> dict[int, Placement]:
        """The known points without those that leave earlier phases too little time; their ties are lost."""
        while (found := squeeze(item, known)) is not None:
            start, end = item.timing.points[found.before], item.timing.points[found.after]
            phases = (f"{item.behavior.id} from {start} to {end}",)
            lost = [loss.constraint for loss in self._losses]
            ties = [tie for tie in self._problem.ties if points[found.after] in tie.nodes and tie not in lost]
            self._losses += [
                lost_constraint(tie, TooHurried(what=tie.text, phases=phases, need=found.need, room=found.room))
                for tie in ties
            ]
            known = {i: placed for i, placed in known.items() if i != found.after}
        return known

    def _gap(
        self, item: Item, points: Sequence[Point], known: Mapping[int, Placement], first: int, index: int
    ) -> float | None:
        """By how much (s) a rigid behavior that is placed by one point misses another; None if it is unknown."""
        preferred = item.timing.offsets[index] - item.timing.offsets[first]
        before, after = known[first], known[index]
        if before.known and after.known:
            return after.time - before.time - preferred
        (root, here), (other, there) = self._ties.find(points[first]), self._ties.find(points[index])
        return there - here - preferred if root == other else None

    def _not_before_the_block(self, item: Item, known: dict[int, Placement]) -> dict[int, Placement]:
        """Have a behavior that would start before its block start with it, by shortening its first phases (7.13).

        This does not concern clusters that are moved later.
        """
        first = min((i for i, placed in known.items() if placed.known), default=None)
        if first is None:
            return known
        given, start = known[first], fill(item, known)[0]
        early = -(start if start.known else given).time
        if early <= SHORTEST or self._is_free(given):
            return known
        if not start.known or first == 0 or item.timing.rigid or given.time <= 0:
            raise RealizerError(BeforeBlock(early=early))
        return {0: self._start, **known}

    def _cluster(self, placed: Placement) -> Cluster:
        return self._clusters.find(placed.cluster)[0]

    def _is_free(self, placed: Placement) -> bool:
        """Whether its cluster is tied to no known time, and will be moved."""
        return self._cluster(placed) is not Origin.BLOCK_START

    def _earliest(self) -> dict[Cluster, float]:
        """By how much (s) each free cluster is moved so that it starts with the block (thesis 7.24)."""
        earliest: dict[Cluster, float] = {}
        for placed in (placed for points in self._placed.values() for placed in points if self._is_free(placed)):
            cluster = self._cluster(placed)
            earliest[cluster] = min(earliest.get(cluster, placed.time), placed.time)
        return earliest

    def _past(self, placed: Sequence[Placement]) -> Fault | None:
        """The fault of a behavior before its block, whose cluster a later behavior has tied to something fixed."""
        early = (each.time for each in placed if each.known and each.time < -SHORTEST and not self._is_free(each))
        return next((BeforeBlock(early=-time) for time in early), None)


def _sorted(problem: SchedulingProblem, ties: OffsetUnionFind[Node]) -> list[Item]:
    """The order of scheduling (thesis 7.3.5): rigid behaviors whose time is given, then all others.

    Among these, a rigid behavior comes before the behaviors with which it is in a cycle of ties.
    Otherwise, behaviors stay in document order. (The thesis's third group, completely flexible behaviors,
    follows with the first behavior of that kind.)
    """
    rigid = [item for item in problem.items if item.timing.rigid]
    grounded = [item for item in rigid if any(not isinstance(ties.find(node)[0], Point) for node in item.points)]
    order = [item for item in problem.items if item not in grounded]
    flexible = {item.behavior.id for item in problem.items if not item.timing.rigid}
    pairs = [tie.nodes for tie in problem.ties]
    links = [(one, other) for one, other in pairs if isinstance(one, Point) and isinstance(other, Point)]
    groups = OffsetUnionFind[str]()
    for one, other in links:
        if {one.behavior, other.behavior} <= flexible:
            groups.union(one.behavior, other.behavior)
    for item in [item for item in order if item.timing.rigid]:
        touched: defaultdict[str, set[str]] = defaultdict(set)
        for here, there in [*links, *((other, one) for one, other in links)]:
            if here.behavior == item.behavior.id and there.behavior in flexible:
                touched[groups.find(there.behavior)[0]].add(here.sync)
        cycles = {group for group, points in touched.items() if len(points) > 1}
        ahead = order[: order.index(item)]
        place = next((i for i, each in enumerate(ahead) if groups.find(each.behavior.id)[0] in cycles), None)
        if place is not None:
            order.remove(item)
            order.insert(place, item)
    return grounded + order
