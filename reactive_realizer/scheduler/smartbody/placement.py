"""Where SmartBody's scheduler puts the points of one behavior (thesis 8.7.3, figure 8.12)."""

import itertools
from collections.abc import Iterable, Mapping, Sequence
from enum import Enum
from typing import NamedTuple

from reactive_realizer.errors import RealizerError
from reactive_realizer.planunit.timing import SHORTEST, TooShort
from reactive_realizer.scheduler.faults import OutOfOrder
from reactive_realizer.scheduler.problem import Item, Node


class Fixed(Enum):
    """Clusters that are never moved: what is tied to the start of the block, and what hangs on times from outside."""

    BLOCK_START = "block start"
    OUTSIDE = "outside"


Cluster = str | Fixed
"""Behaviors that are moved together, by the id of the first of them."""

_Timed = tuple[str, float]
"""A sync id and its time, s."""


class Placement(NamedTuple):
    """Where a point is.

    Attributes:
        time: s after the predicted start of the block.
        known: whether it is; what hangs on an unknown time from outside has one that suits the first behavior there.
        cluster: what it moves with.
        outer: what is given from outside that it hangs on, in whatever number of steps.
    """

    time: float
    known: bool
    cluster: Cluster
    outer: frozenset[Node] = frozenset()

    @property
    def known_time(self) -> float | None:
        """Its time (s), None while nobody knows it."""
        return self.time if self.known else None

    def moved(self, distance: float) -> "Placement":
        """The place at a distance (s)."""
        return self._replace(time=self.time + distance) if distance else self


def fill(item: Item, given: Mapping[int, Placement]) -> list[Placement]:
    """All points from those that are given: a ratio between two of them, else at a distance from the nearest."""
    offsets = item.timing.offsets
    stretch = _average_stretch(offsets, {i: p.time for i, p in given.items() if p.known})
    placed = []
    for i in range(len(offsets)):
        before = max((k for k in given if k <= i), default=None)
        after = min((k for k in given if k >= i), default=None)
        if i in given:
            placed.append(given[i])
        elif before is not None and after is not None:
            placed.append(_between(given[before], given[after], ratio_between(offsets, before, i, after)))
        else:
            nearest = before if before is not None else min(given)
            placed.append(given[nearest].moved((offsets[i] - offsets[nearest]) * stretch))
    return placed


def ratio_between(offsets: Sequence[float], before: int, index: int, after: int) -> float:
    """How far a point is on its preferred way between two others: stretching is uniform."""
    preferred = offsets[after] - offsets[before]
    return (offsets[index] - offsets[before]) / preferred if preferred > 0 else 0.0


def check_given(item: Item, given: Mapping[int, Placement]) -> None:
    """Refuse times that were asked for and are out of order, by the names they were asked for.

    Raises:
        RealizerError: "out-of-order".
    """
    known = [(item.timing.points[i], p.time) for i, p in sorted(given.items()) if p.known]
    _check_order(itertools.combinations(known, 2))


def check_playable(item: Item, placed: Sequence[Placement]) -> None:
    """Refuse what cannot be played (thesis 7.14, 7.15).

    Raises:
        RealizerError: points out of order, or no time at all between start and end.
    """
    known = [(sync, p.time) for sync, p in zip(item.timing.points, placed, strict=True) if p.known]
    _check_order(itertools.pairwise(known))
    start, end = placed[0], placed[-1]
    if not item.timing.instant and start.known and end.known and end.time - start.time < SHORTEST:
        raise RealizerError(TooShort())


def _average_stretch(offsets: Sequence[float], known: Mapping[int, float]) -> float:
    """How much longer than preferred the behavior is between its first and last known points; 1 if that says nothing.

    Args:
        offsets: preferred times (s) of the points after the first.
        known: times (s) by index.
    """
    indices = sorted(known)
    if len(indices) < 2:
        return 1.0
    first, last = indices[0], indices[-1]
    preferred = offsets[last] - offsets[first]
    return (known[last] - known[first]) / preferred if preferred > 0 else 1.0


def _between(before: Placement, after: Placement, ratio: float) -> Placement:
    time = before.time + ratio * (after.time - before.time)
    return Placement(time, before.known and after.known, before.cluster, before.outer | after.outer)


def _check_order(pairs: Iterable[tuple[_Timed, _Timed]]) -> None:
    for (sync, time), (later, then) in pairs:
        if then < time - SHORTEST:
            raise RealizerError(OutOfOrder(sync=sync, later=later, gap=time - then))
