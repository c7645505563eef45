"""Places the points of one behavior from those that are given (thesis 8.7.3, figure 8.12)."""

import itertools
from bisect import bisect
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from reactive_realizer.errors import RealizerError, SchedulingFault
from reactive_realizer.planunit.timing import SHORTEST, Phase, TooShort, stretched
from reactive_realizer.scheduler.offset_union_find import TIE_TOLERANCE
from reactive_realizer.scheduler.problem import Item, Node


class OutOfOrder(SchedulingFault):
    """A behavior with sync points in the wrong order; ``gap`` in s."""

    code = "out-of-order"
    template = "this behavior is dropped: its {sync} would come {gap:g} s after its {later}"
    sync: str
    later: str
    gap: float


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
        return self._replace(time=self.time + distance) if distance else self


class Squeeze(NamedTuple):
    """Given points that are nearer to each other than the phases between them allow.

    Attributes:
        before: index of the earlier point.
        after: index of the later one.
        need: shortest duration of these phases, s.
        room: time that is given, s.
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
    """The first two given points with known times that leave the phases between them too little time, if there are."""
    known = [(i, placed.time) for i, placed in sorted(given.items()) if placed.known]
    for (before, time), (after, later) in itertools.pairwise(known):
        need = sum(phase.shortest for phase in item.timing.phases[before:after])
        if later - time < need - TIE_TOLERANCE:
            return Squeeze(before, after, need, max(0.0, later - time))
    return None


def check_given(item: Item, given: Mapping[int, Placement]) -> None:
    """Refuse given times that are out of order.

    Raises:
        RealizerError: "out-of-order".
    """
    known = [(item.timing.points[i], placed.time) for i, placed in sorted(given.items()) if placed.known]
    _check_order(itertools.combinations(known, 2))


def check_playable(item: Item, placed: Sequence[Placement]) -> None:
    """Refuse a behavior that cannot be played (thesis 7.14, 7.15).

    Raises:
        RealizerError: its points are out of order, or there is no time between its start and its end.
    """
    known = [(sync, point.time) for sync, point in zip(item.timing.points, placed, strict=True) if point.known]
    _check_order(itertools.pairwise(known))
    start, end = placed[0], placed[-1]
    if not item.timing.instant and start.known and end.known and end.time - start.time < SHORTEST:
        raise RealizerError(TooShort())


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
    return [max(phase.shortest, phase.duration * stretch) for phase in phases]


def _average_stretch(offsets: Sequence[float], known: Mapping[int, float]) -> float:
    """The duration between the first and the last known point, in relation to the preferred one; 1 if it is unknown."""
    if len(known) < 2:
        return 1.0
    first, last = min(known), max(known)
    preferred = offsets[last] - offsets[first]
    return (known[last] - known[first]) / preferred if preferred > 0 else 1.0


def _check_order(pairs: Iterable[tuple[tuple[str, float], tuple[str, float]]]) -> None:
    for (sync, time), (later, then) in pairs:
        if then < time - SHORTEST:
            raise RealizerError(OutOfOrder(sync=sync, later=later, gap=time - then))
