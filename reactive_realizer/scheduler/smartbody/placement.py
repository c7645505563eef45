"""Orders behaviors (thesis 7.3.5), and places the points of each from those that are given (8.7.3, figure 8.12)."""

import itertools
from bisect import bisect
from collections import defaultdict
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.planunit.timing import SHORTEST, Phase, PhaseKind, TooShort, stretched
from reactive_realizer.scheduler.faults import Conflicting, ContradictoryTie, TooHurried
from reactive_realizer.scheduler.offset_union_find import TIE_TOLERANCE, OffsetUnionFind
from reactive_realizer.scheduler.problem import Item, Node, Point, SchedulingProblem, Tie

Cluster = str | Node
"""Behaviors that are moved together, by the id of the first of them or by the unknown time from outside that it names.

That of the block's start is never moved; it includes all that is tied to known times from outside.
"""


class Placement(NamedTuple):
    """The time of a point.

    Attributes:
        time: s after the predicted start of the block. A point that depends on an unknown time from outside has one
            that suits the first behavior that depends on it.
        known: whether the time is known; those of earlier behaviors count as known.
        cluster: with which it is moved.
    """

    time: float
    known: bool
    cluster: Cluster

    def moved(self, distance: float) -> "Placement":
        """The placement at a distance (s)."""
        return Placement(self.time + distance, self.known, self.cluster) if distance else self

    def as_known(self) -> "Placement":
        """The same placement, whose time counts as known."""
        return Placement(self.time, known=True, cluster=self.cluster)


class Squeeze(NamedTuple):
    """Given points that are nearer to each other than the phases between them allow.

    Attributes:
        before: index of the earlier point.
        after: index of the later one.
        need: shortest duration of these phases, s.
        room: time that is given, s; negative if the points are out of order.
    """

    before: int
    after: int
    need: float
    room: float


def fill(item: Item, given: Mapping[int, Placement]) -> list[Placement]:
    """All points from the given ones: in proportion between two of them, or at a distance from the nearest.

    Phases that would become shorter than their shortest duration have that.
    """
    timing = item.timing
    stretch = _average_stretch(timing.offsets, {i: placed.time for i, placed in given.items() if placed.known})
    indices = sorted(given)
    return [given.get(i) or _place(i, timing.phases, given, indices, stretch) for i in range(len(timing.points))]


def squeeze(item: Item, given: Mapping[int, Placement]) -> Squeeze | None:
    """The first two given points that leave the phases between them too little time, if there are.

    Both have known times, or times at a distance from the same unknown one.
    """
    groups: defaultdict[Cluster | None, list[tuple[int, float]]] = defaultdict(list)
    for i, placed in sorted(given.items()):
        groups[None if placed.known else placed.cluster].append((i, placed.time))
    for (before, time), (after, later) in itertools.chain.from_iterable(map(itertools.pairwise, groups.values())):
        need = sum(map(_least, item.timing.phases[before:after]))
        if later - time < need - TIE_TOLERANCE:
            return Squeeze(before, after, need, later - time)
    return None


def squeeze_fault(item: Item, tie: Tie, found: Squeeze, *, by_block: bool) -> Fault:
    """The fault of a tie that leaves too little time, or a wrong order; ``by_block``: after the start of the block."""
    if found.room >= -TIE_TOLERANCE:
        start, end = item.timing.points[found.before], item.timing.points[found.after]
        phases = (f"{item.behavior.id} from {start} to {end}",)
        return TooHurried(what=tie.text, phases=phases, need=found.need, room=max(found.room, 0.0))
    if by_block or found.before == found.after:
        return Conflicting(what=tie.text, others="the start of the block", gap=-found.room)
    return ContradictoryTie(tie=tie.text, gap=-found.room)


def check_playable(item: Item, placed: Sequence[Placement]) -> None:
    """Refuse a behavior without duration (thesis 7.14).

    Raises:
        RealizerError: there is no time between its start and its end.
    """
    start, end = placed[0], placed[-1]
    if not item.timing.instant and start.known and end.known and end.time - start.time < SHORTEST:
        raise RealizerError(TooShort())


def _least(phase: Phase) -> float:
    return phase.duration if phase.kind is PhaseKind.RIGID else phase.shortest


def _place(
    i: int, phases: Sequence[Phase], given: Mapping[int, Placement], indices: Sequence[int], stretch: float
) -> Placement:
    """A point that is not given itself; ``indices`` are the given ones, in order."""
    after = bisect(indices, i)
    if after == 0:
        return given[indices[0]].moved(-sum(_durations(phases[i : indices[0]], stretch)))
    low = indices[after - 1]
    if after == len(indices):
        return given[low].moved(sum(_durations(phases[low:i], stretch)))
    high = indices[after]
    one, other = given[low], given[high]
    time = one.time + sum(stretched(phases[low:high], other.time - one.time)[: i - low])
    return Placement(time, one.known and other.known, one.cluster)


def _durations(phases: Sequence[Phase], stretch: float) -> list[float]:
    """Of phases outside of the given points, s; rigid ones keep theirs, such as the end of a stretched speech."""
    return [
        each.duration if each.kind is PhaseKind.RIGID else max(each.shortest, each.duration * stretch)
        for each in phases
    ]


def _average_stretch(offsets: Sequence[float], known: Mapping[int, float]) -> float:
    """The duration between the first and the last known point, in relation to the preferred one; 1 if it is unknown."""
    if len(known) < 2:
        return 1.0
    first, last = min(known), max(known)
    preferred = offsets[last] - offsets[first]
    return (known[last] - known[first]) / preferred if preferred > 0 else 1.0


def sorted_items(problem: SchedulingProblem, ties: OffsetUnionFind[Node]) -> list[Item]:
    """The order of scheduling (thesis 7.3.5): rigid behaviors whose time is given, then all others.

    Among these, a rigid behavior comes before the behaviors with which it is in a cycle of ties.
    Otherwise, behaviors stay in document order. (The thesis's third group, completely flexible behaviors,
    follows with the first behavior of that kind.)
    """
    rigid = [item for item in problem.items if item.timing.rigid]
    grounded = [item for item in rigid if any(not isinstance(ties.find(node)[0], Point) for node in item.points)]
    first = {item.behavior.id for item in grounded}
    order = [item for item in problem.items if item.behavior.id not in first]
    flexible = {item.behavior.id for item in problem.items if not item.timing.rigid}
    pairs = [tie.nodes for tie in problem.ties]
    links = [(one, other) for one, other in pairs if isinstance(one, Point) and isinstance(other, Point)]
    groups = OffsetUnionFind[str]()
    for one, other in links:
        if {one.behavior, other.behavior} <= flexible:
            groups.union(one.behavior, other.behavior)
    touched: defaultdict[tuple[str, str], set[str]] = defaultdict(set)
    for here, there in [*links, *((other, one) for one, other in links)]:
        if here.behavior not in flexible and there.behavior in flexible:
            touched[here.behavior, groups.find(there.behavior)[0]].add(here.sync)
    in_cycles: defaultdict[str, set[str]] = defaultdict(set)
    for (behavior, group), points in touched.items():
        if len(points) > 1:
            in_cycles[behavior].add(group)
    for item in [item for item in order if item.behavior.id in in_cycles]:
        cycles = in_cycles[item.behavior.id]
        ahead = order[: order.index(item)]
        place = next((i for i, each in enumerate(ahead) if groups.find(each.behavior.id)[0] in cycles), None)
        if place is not None:
            order.remove(item)
            order.insert(place, item)
    return grounded + order
