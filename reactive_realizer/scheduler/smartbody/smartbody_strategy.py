"""SmartBody's scheduling with Elckerlyc's sorting (thesis 7.2.2, 7.3.5)."""

import itertools
from collections.abc import Mapping, Sequence
from math import isfinite

from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.planunit.timing import SHORTEST
from reactive_realizer.scheduler.faults import (
    ContradictoryTie,
    NoOrder,
    OuterTieDropped,
    Rigid,
)
from reactive_realizer.scheduler.offset_union_find import TIE_TOLERANCE, OffsetUnionFind
from reactive_realizer.scheduler.problem import Item, Node, Origin, Point, SchedulingProblem, Tie
from reactive_realizer.scheduler.smartbody.followers import followers, with_followers
from reactive_realizer.scheduler.smartbody.placement import (
    Cluster,
    Placement,
    Squeeze,
    check_playable,
    fill,
    sorted_items,
    squeeze,
    squeeze_fault,
)
from reactive_realizer.scheduler.smartbody.tie_chain import chain, links_of
from reactive_realizer.scheduler.solution import Loss, Solution, lost_behavior, lost_constraint, with_required

_SAME = 1e-3
"""A rigid behavior may miss a time by less (s)."""


class SmartBodyStrategy:
    """Places behaviors one by one, each by its ties to earlier ones; then moves free clusters to the block's start.

    If a behavior cannot be placed, a speech without a given time is moved later, or else one of the ties is given up.
    The behaviors that only `after` constraints place come last. The strategy keeps no other before/after constraints,
    and its plans depend on the order of the behaviors (thesis 7.1.6). It is the reference for better strategies.
    """

    name = "smartbody"

    def solve(self, problem: SchedulingProblem) -> Solution:
        """See `SchedulingStrategy`; after a loss, the rest is placed again without it."""
        left, lost = problem, list[Loss]()
        while (solution := _once(left)).losses:
            lost += [with_required(loss, problem) for loss in solution.losses]
            left = solution.kept_of(left)
        return Solution(solution.times, tuple(lost))


def _once(problem: SchedulingProblem) -> Solution:
    """A solution with the first losses."""
    following = followers(problem)
    kept = {id(order) for orders in following.values() for order in orders}
    others = problem.only(lambda item: item.behavior.id not in following, lambda each: id(each) not in kept)
    return with_followers(problem, _Run(others).solve(), following)


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
        self._links = links_of(problem.ties)
        self._unsettled: set[str] = set()

    def solve(self) -> Solution:
        for tie in self._problem.ties:
            self._tie(tie)
        for order in self._problem.orders:
            self._losses.append(lost_constraint(order, NoOrder(strategy=SmartBodyStrategy.name, text=order.text)))
        for item in sorted_items(self._problem, self._ties):
            try:
                if self._unsettled and self._unsettled & self._neighbors(item):
                    self._leave(item)
                else:
                    self._place(item)
            except RealizerError as problem:
                self._losses.append(lost_behavior(item.behavior, problem.fault))
        earliest = self._earliest()
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
            self._losses.append(lost_constraint(tie, contradiction if isfinite(gap) else OuterTieDropped(tie=tie.text)))

    def _place(self, item: Item) -> None:
        """Place every point of a behavior; the placements of earlier behaviors stay, if possible."""
        points = item.points
        tied = self._known(item, points)
        if not tied:  # it begins a cluster with its first tied point, or its start
            first = next((i for i, point in enumerate(points) if point in self._tied), 0)
            tied = {first: Placement(item.timing.offsets[first], known=True, cluster=item.behavior.id)}
        tied = self._with_own_ties(item, points, tied)
        if self._ground(tied):
            self._place(item)
            return
        if item.timing.rigid and self._misses(item, points, tied):
            return
        first, fixed = min(tied), self._is_fixed(tied)
        known = {first: tied[first]} if item.timing.rigid else tied
        known = self._not_before_the_block(item, known, fixed=fixed)
        if (found := self._conflict(item, known, fixed=fixed)) is not None:
            self._resolve(item, tied, found)
            return
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
                self._roots.setdefault(root, (placement.as_known(), distance))

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

    def _misses(self, item: Item, points: Sequence[Point], known: Mapping[int, Placement]) -> bool:
        """Whether a rigid behavior placed by its first known point misses another one; the tie of that is given up."""
        first = min(known)
        gaps = {i: self._gap(item, points, known, first, i) for i in sorted(known)}
        for i, gap in gaps.items():
            if gap is None or abs(gap) > _SAME:
                tie = self._least(item, i, first)
                rigid = Rigid(tie=tie.text, point=":".join(points[i]), gap=abs(gap or 0.0))
                self._give_up(item, tie, OuterTieDropped(tie=tie.text) if gap is None else rigid)
                return True
        return False

    def _ground(self, tied: Mapping[int, Placement]) -> bool:
        """Move free clusters that begin before the block, and are tied to known times now, to its start (thesis 7.24).

        Returns:
            Whether one has been moved.
        """
        free = {self._cluster(placed) for placed in tied.values() if self._is_free(placed)}
        if not free or not self._is_fixed(tied):
            return False
        earliest = self._earliest()
        early = {cluster: -earliest[cluster] for cluster in free if earliest.get(cluster, 0.0) < -SHORTEST}
        for cluster, distance in early.items():
            self._move(cluster, distance)
        return bool(early)

    def _conflict(self, item: Item, known: Mapping[int, Placement], *, fixed: bool) -> Squeeze | None:
        """Known points that cannot be where they are; ``fixed``: the behavior is tied to a known time."""
        first = min((i for i, placed in known.items() if placed.known), default=None)
        if first is not None and known[first].time < -SHORTEST and fixed:
            return Squeeze(0, first, 0.0, known[first].time)
        return squeeze(item, known)

    def _resolve(self, item: Item, tied: Mapping[int, Placement], found: Squeeze) -> None:
        """Have a rigid behavior of a free cluster wait for one that is placed, or give up a tie of that one."""
        cluster = self._cluster(tied[found.after])
        others = {i: placed for i, placed in tied.items() if self._cluster(placed) != cluster}
        rigid = any(each.timing.rigid for each in self._problem.items if self._is_in(each, cluster))
        if rigid and cluster is not Origin.BLOCK_START and found.before in others:
            distance = fill(item, others)[found.after].time - tied[found.after].time
            if distance > found.need - found.room - TIE_TOLERANCE:
                self._move(cluster, distance)
                self._clusters.union(others[found.before].cluster, cluster)
                self._place(item)
                return
        tie = self._least(item, found.after, found.before)
        self._give_up(item, tie, squeeze_fault(item, tie, found, by_block=found.before not in tied))

    def _least(self, item: Item, *indices: int) -> Tie:
        """The tie to be given up of those that determine the places of points: the last one that is not required."""
        chains = (reversed(self._chain(item, index)) for index in indices)
        return min(itertools.chain.from_iterable(chains), key=lambda tie: tie.required)

    def _give_up(self, item: Item, tie: Tie, fault: Fault) -> None:
        """Give up a tie; its behavior and those that are tied to that are placed without it, in the next run."""
        self._losses.append(lost_constraint(tie, fault))
        self._leave(item)

    def _leave(self, item: Item) -> None:
        """Have a behavior, and those that are tied to it, be placed in the next run."""
        self._unsettled.add(item.behavior.id)
        self._placed[item.behavior.id] = fill(item, {0: self._start})

    def _chain(self, item: Item, index: int) -> list[Tie]:
        """The ties that determine the place of a point of a behavior."""
        lost = {id(loss.constraint) for loss in self._losses}

        def is_placed(node: Node) -> bool:
            own = isinstance(node, Point) and (node.behavior == item.behavior.id or node.behavior in self._placed)
            return own or node in self._given

        return chain(item.points[index], self._links, lost, is_placed)

    def _neighbors(self, item: Item) -> set[str]:
        """Ids of the behaviors that are tied to a behavior."""
        return set[str]().union(*(tie.behaviors for point in item.points for tie in self._links.get(point, ())))

    def _move(self, cluster: Cluster, distance: float) -> None:
        """Move all placements of a cluster by a distance (s)."""

        def moved(placed: Placement) -> Placement:
            return placed.moved(distance) if self._cluster(placed) == cluster else placed

        self._placed = {id_: [moved(placed) for placed in points] for id_, points in self._placed.items()}
        self._roots = {root: (moved(placed), at) for root, (placed, at) in self._roots.items()}

    def _is_in(self, item: Item, cluster: Cluster) -> bool:
        placed = self._placed.get(item.behavior.id, ())
        return any(self._cluster(each) == cluster for each in placed)

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

    def _not_before_the_block(self, item: Item, known: dict[int, Placement], *, fixed: bool) -> dict[int, Placement]:
        """Have a behavior that would start before its block start with it, by shortening its first phases (7.13).

        This does not concern clusters that are moved later, and starts that will follow from an unknown time; that of
        a free behavior does not.
        """
        start = known.get(0) or fill(item, known)[0]
        early = (start.known or item.timing.free) and start.time < -SHORTEST and fixed
        return {0: self._start, **known} if early else known

    def _is_fixed(self, known: Mapping[int, Placement]) -> bool:
        """Whether a behavior is tied to a known time."""
        return not all(self._is_free(placed) for placed in known.values())

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
