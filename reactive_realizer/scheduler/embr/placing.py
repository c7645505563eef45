"""Finds the times of all knots: as close to preferred durations as possible, and then as early as possible."""

import itertools
from collections import defaultdict
from collections.abc import Iterable, Sequence
from math import inf

from reactive_realizer.scheduler.embr.differences import TOLERANCE, Differences, Row
from reactive_realizer.scheduler.embr.embr_problem import EmbrProblem, PhaseGroup
from reactive_realizer.scheduler.embr.keeping import Kept
from reactive_realizer.scheduler.embr.linear_program import Wish, least_deviations
from reactive_realizer.scheduler.offset_union_find import TIE_TOLERANCE, OffsetUnionFind
from reactive_realizer.scheduler.problem import Node, Origin, Tie

_STIFFEST = 0.1
"""s; segments with shorter preferred durations are not stiffer."""


def place(problem: EmbrProblem, kept: Kept) -> dict[Node, float]:
    """The time (s after the block's start) of every knot; unknown given times are chosen as they suit best."""
    times: dict[Node, float] = {}
    for group in _groups(problem, kept):
        times |= group.place()
    return times


class _Group:
    """Behaviors that depend on each other by constraints, and on no others.

    Attributes:
        segments: of its behaviors.
        ties: its `at` constraints.
        rows: the other conditions on its times.
    """

    def __init__(self, problem: EmbrProblem, kept: Kept) -> None:
        self._problem = problem
        self._kept = kept
        self.segments: list[PhaseGroup] = []
        self.ties: list[Tie] = []
        self.rows: list[Row[Node]] = []

    def place(self) -> dict[Node, float]:
        """The time of every node: with preferred durations if possible, or else with those that deviate least."""
        preferred = self._earliest([segment.preferred for segment in self.segments])
        if preferred is not None:
            return preferred
        times = self._least_deviating()
        # If the solver's rounding keeps bodies from being moved, its times are taken.
        return self._earliest([times[segment.end] - times[segment.start] for segment in self.segments]) or times

    def _earliest(self, durations: Sequence[float]) -> dict[Node, float] | None:
        """The earliest times with these durations; None if these contradict ties or rows."""
        bodies = self._bodies(durations)
        if bodies is None:
            return None
        ground, later = bodies.find(Origin.BLOCK_START)
        floors = {ground: -inf} | self._floors(bodies)
        if floors[ground] > TOLERANCE - later:
            return None
        least = Differences[Node](floors | {ground: -later}, [ground])
        if any(least.add(_between_roots(bodies, row)) is not None for row in self.rows):
            return None
        return {node: least[root] + later for node in self._nodes() for root, later in [bodies.find(node)]}

    def _bodies(self, durations: Sequence[float]) -> OffsetUnionFind[Node] | None:
        """Nodes at known distances from each other, and known times at theirs from the start of the block."""
        distances: list[tuple[Node, Node, float]] = [
            (node, Origin.BLOCK_START, time)
            for node in self._nodes()
            if (time := self._problem.known(node)) is not None
        ]
        distances += [
            (segment.end, segment.start, duration) for segment, duration in zip(self.segments, durations, strict=True)
        ]
        distances += [(tie.left, tie.right, tie.offset) for tie in self.ties]
        bodies = OffsetUnionFind[Node]()
        gaps = (bodies.union(*distance) for distance in distances)
        return bodies if all(gap is None or abs(gap) <= TIE_TOLERANCE for gap in gaps) else None

    def _least_deviating(self) -> dict[Node, float]:
        """Times by the linear program; its variables are the groups of points tied to each other."""
        groups = self._kept.groups
        bounds = {root: (floor, inf) for root, floor in self._floors(groups).items()}
        bounds |= {root: (time, time) for root in bounds if (time := self._problem.known(root)) is not None}
        numbers = {root: number for number, root in enumerate(bounds)}
        rows = [
            Row(numbers[later], numbers[earlier], distance)
            for row in self.rows
            for later, earlier, distance in [_between_roots(groups, row)]
            if later != earlier
        ]
        wishes = [
            Wish(Row(numbers[later], numbers[earlier], distance), max(segment.preferred, _STIFFEST))
            for segment in self.segments
            for later, earlier, distance in [_between_roots(groups, Row(segment.end, segment.start, segment.preferred))]
            if later != earlier
        ]
        times = least_deviations(list(bounds.values()), rows, wishes)
        if times is None:
            return {node: self._kept.least[node] for node in self._nodes()}
        return {node: times[numbers[root]] + later for node in self._nodes() for root, later in [groups.find(node)]}

    def _nodes(self) -> list[Node]:
        """Knots, and the given nodes that constraints on them name."""
        pairs: list[tuple[Node, Node]] = [(segment.start, segment.end) for segment in self.segments]
        pairs += [(row.later, row.earlier) for row in self.rows]
        return list(dict.fromkeys(itertools.chain(*pairs, *(tie.nodes for tie in self.ties))))

    def _floors(self, groups: OffsetUnionFind[Node]) -> dict[Node, float]:
        """The earliest time of the root of each group; minus infinity if it has none."""
        floors: dict[Node, float] = {}
        for node in self._nodes():
            root, later = groups.find(node)
            floors[root] = max(floors.get(root, -inf), -later if self._problem.known(node) is None else -inf)
        return floors


def _groups(problem: EmbrProblem, kept: Kept) -> Iterable[_Group]:
    linked = OffsetUnionFind[Node | str]()
    for constraint in kept.constraints:
        moved = [each for node in constraint.nodes if (each := problem.movable(node)) is not None]
        if len(moved) > 1:
            linked.union(moved[0], moved[1])
    found: dict[Node | str, _Group] = defaultdict(lambda: _Group(problem, kept))

    def concerned(*nodes: Node) -> Iterable[_Group]:
        """The group of some nodes, as a list; empty if all their times are given and known."""
        moved = [each for node in nodes if (each := problem.movable(node)) is not None]
        return [found[linked.find(each)[0]] for each in moved[:1]]

    for segment in problem.segments:
        for group in concerned(segment.start):
            group.segments.append(segment)
    for row in kept.rows:
        for group in concerned(row.later, row.earlier):
            group.rows.append(row)
    for tie in (each for each in kept.constraints if isinstance(each, Tie)):
        for group in concerned(*tie.nodes):
            group.ties.append(tie)
    return found.values()


def _between_roots(groups: OffsetUnionFind[Node], row: Row[Node]) -> Row[Node]:
    """The same condition on the roots of groups."""
    (root, later), (other, earlier) = groups.find(row.later), groups.find(row.earlier)
    return Row(root, other, row.distance + earlier - later)
