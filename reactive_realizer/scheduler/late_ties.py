"""Ties to times from outside that lie before their block can meet them (docs/semantics.md, late ties)."""

from collections import defaultdict
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import accumulate, pairwise
from math import inf
from typing import NamedTuple

from reactive_realizer.clock.units import GlobalTime, has_passed
from reactive_realizer.errors import SchedulingFault
from reactive_realizer.pegboard.time_peg import TimeCell
from reactive_realizer.planunit.timing import PhaseKind
from reactive_realizer.scheduler.offset_union_find import OffsetUnionFind
from reactive_realizer.scheduler.problem import Item, Origin, Point, Tie
from reactive_realizer.scheduler.solution import Loss, lost_constraint


class LateTie(SchedulingFault):
    """A tie to a time before the start of the block; ``late`` and ``start`` in s."""

    code = "late-tie"
    template = "{tie} is {late} s late, because the block starts at {start} s"
    tie: str
    late: float
    start: float


class OuterTie(NamedTuple):
    """A tie between the block and a time from outside: ``node = cell + offset``, offset in s."""

    node: Point | Origin
    cell: TimeCell
    offset: float
    tie: Tie


def outer_ties(ties: Iterable[Tie]) -> Iterator[OuterTie]:
    """The ties between a point or the start of the block and a time from outside."""
    for tie in ties:
        left, right = tie.nodes
        if isinstance(left, Point | Origin):
            if not isinstance(right, Point | Origin):
                yield OuterTie(left, right, tie.offset, tie)
        elif isinstance(right, Point | Origin):
            yield OuterTie(right, left, -tie.offset, tie)


class Bounds(NamedTuple):
    """Bounds that a time from outside sets on the ties of a block to it, s after the start of the block.

    Attributes:
        least: the earliest time to which no tie is late.
        earliest: at which the ties are met if one is late.
    """

    least: float
    earliest: float


def tie_bounds(items: Iterable[Item], ties: Collection[Tie]) -> dict[TimeCell, Bounds]:
    """The bounds of each time from outside that points are tied to."""
    behaviors = {item.behavior.id: item for item in items}
    outer = list(outer_ties(ties))
    if not outer:
        return {}
    leads, least = _Leads(behaviors.values(), ties), dict[TimeCell, float]()
    by_cell: defaultdict[TimeCell, list[OuterTie]] = defaultdict(list)
    for each in outer:
        by_cell[each.cell].append(each)
        if isinstance(each.node, Point):
            least[each.cell] = max(least.get(each.cell, -inf), leads[each.node] - each.offset)
    inner = _inner_ties(ties)
    return {cell: Bounds(time, _earliest(behaviors, inner, by_cell[cell])) for cell, time in least.items()}


class LateTies:
    """The ties of a block that starts too late for them.

    If one tie to a time from outside is late, all ties to this time are moved together: to the earliest time at which
    each behavior begins with its block or later, with its preferred durations. A behavior without preferences needs no
    time before its points.

    Args:
        items: the behaviors of the block.
        ties: all of its ties.
        start: of the block, s, global.

    Attributes:
        cells: the times from outside to which a tie is late.
    """

    def __init__(self, items: Sequence[Item], ties: Sequence[Tie], start: GlobalTime) -> None:
        self._items = {item.behavior.id: item for item in items}
        self._ties = ties
        self._start = start
        self._outer = list(outer_ties(ties))
        self._leads = _Leads(items if self._outer else (), ties)
        self.cells = {each.cell: None for each in self._outer if self._is_late(each)}.keys()

    def moved(self) -> tuple[list[Tie], list[Loss]]:
        """The ties of a block that starts now, and a loss for each late time, unless only starts are tied before it.

        Ties to a late time become ties to the start of the block.
        """
        members: defaultdict[TimeCell, list[OuterTie]] = defaultdict(list)
        for each in self._outer:
            if each.cell in self.cells:
                members[each.cell].append(each)
        inner = _inner_ties(self._ties)
        replaced: dict[int, Tie | None] = {}
        losses: list[Loss] = []
        for cell, own in members.items():
            time = _earliest(self._items, inner, own)
            replaced |= {id(each.tie): _to_start(each, time) for each in own}
            losses += self._losses(own, self._start + time - (cell.value or 0.0))
        ties = (replaced.get(id(tie), tie) for tie in self._ties)
        return [tie for tie in ties if tie is not None], losses

    def _is_late(self, outer: OuterTie) -> bool:
        time = outer.cell.value
        if time is None:
            return False
        lead = self._leads[outer.node] if isinstance(outer.node, Point) else 0.0
        return has_passed(time + outer.offset, self._start + lead)

    def _losses(self, ties: Iterable[OuterTie], late: float) -> Iterator[Loss]:
        named = [each for each in ties if self._is_late(each) and not self._says_start(each.node)]
        for each in sorted(named, key=lambda each: (each.offset, each.tie.text))[:1]:
            yield lost_constraint(each.tie, LateTie(tie=each.tie.text, late=late, start=self._start))

    def _says_start(self, node: Point | Origin) -> bool:
        return isinstance(node, Origin) or self._items[node.behavior].points[0] == node


class _Leads:
    """The least time (s) between the start of a block and each of its points.

    This is the time that rigid phases take before the point, and before those that are held at a distance from it: by
    ties, also through other behaviors, and by rigid phases.
    """

    def __init__(self, items: Iterable[Item], ties: Iterable[Tie]) -> None:
        items = tuple(items)
        self._groups = OffsetUnionFind[Point]()
        self._of_roots: dict[Point, float] = {}
        for item in items:
            for phase, (point, later) in zip(item.timing.phases, pairwise(item.points), strict=True):
                if phase.kind is PhaseKind.RIGID:
                    self._groups.union(later, point, phase.duration)
        for tie in ties if items else ():
            if isinstance(tie.left, Point) and isinstance(tie.right, Point):
                self._groups.union(tie.left, tie.right, tie.offset)
        for item in items:
            rigid = (phase.duration if phase.kind is PhaseKind.RIGID else 0.0 for phase in item.timing.phases)
            for point, lead in zip(item.points, accumulate(rigid, initial=0.0), strict=True):
                root, distance = self._groups.find(point)
                self._of_roots[root] = max(self._of_roots.get(root, -inf), lead - distance)

    def __getitem__(self, point: Point) -> float:
        root, distance = self._groups.find(point)
        return self._of_roots[root] + distance


_InnerTies = Mapping[str, Collection[tuple[Point, Point, float]]]
"""By behavior, its ties to others of the block: its point, the other one, and how much later (s) that is."""


def _earliest(items: Mapping[str, Item], inner: _InnerTies, late: Collection[OuterTie]) -> float:
    """The earliest time (s after the start of the block) for a time from outside.

    The behaviors at its ties, and those tied to them, are at their preferred durations from it.

    Args:
        items: the behaviors of the block, by id.
        inner: ties within the block.
        late: the ties to the time from outside.
    """
    places: dict[Point | Origin, float] = {each.node: each.offset for each in late}
    behaviors = dict.fromkeys(node.behavior for node in places if isinstance(node, Point))
    waiting = list(behaviors)
    while waiting:
        item = items[waiting.pop(0)]
        places |= _placed(item, places)
        for one, other, offset in inner.get(item.behavior.id, ()):
            if other.behavior not in behaviors:
                behaviors[other.behavior] = None
                places[other] = places[one] + offset
                waiting.append(other.behavior)
    return -min(places.values())


def _inner_ties(ties: Iterable[Tie]) -> _InnerTies:
    inner: defaultdict[str, list[tuple[Point, Point, float]]] = defaultdict(list)
    for tie in ties:
        if isinstance(tie.left, Point) and isinstance(tie.right, Point):
            inner[tie.left.behavior].append((tie.left, tie.right, -tie.offset))
            inner[tie.right.behavior].append((tie.right, tie.left, tie.offset))
    return inner


def _placed(item: Item, places: Mapping[Point | Origin, float]) -> dict[Point | Origin, float]:
    """All points of a behavior of which some have places: at its preferred durations from the next one that has."""
    known = [k for k, point in enumerate(item.points) if point in places]
    times = [0.0]
    for phase in item.timing.phases:
        times.append(times[-1] + (0.0 if phase.kind is PhaseKind.FREE else phase.duration))
    placed: dict[Point | Origin, float] = {}
    for k, point in enumerate(item.points):
        base = next((each for each in known if each >= k), known[-1])
        placed[point] = places[item.points[base]] + times[k] - times[base]
    return placed


def _to_start(outer: OuterTie, time: float) -> Tie | None:
    """The tie to a time (s) after the start of the block, not to the one from outside; None for a tie of the start."""
    if isinstance(outer.node, Origin):
        return None
    return replace(outer.tie, left=outer.node, right=Origin.BLOCK_START, offset=time + outer.offset)
