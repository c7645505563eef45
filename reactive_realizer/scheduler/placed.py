"""Where SmartBody's scheduler puts the points of one behavior (thesis 8.7.3, figure 8.12)."""

import itertools
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from reactive_realizer.errors import error
from reactive_realizer.pegboard.time_peg import TimeCell
from reactive_realizer.planunit.timing import SHORTEST
from reactive_realizer.reactive.cell import Cell
from reactive_realizer.scheduler.problem import Anchor, AtOffset, AtRatio, Item, PegSpec
from reactive_realizer.scheduler.stretch import average_stretch, ratio_between

_Timed = tuple[str, float]
"""A sync id and its time, s."""


class Placed(NamedTuple):
    """A peg; its time (s) after the predicted block start, as far as it is known; the anchor it hangs on, if any.

    What hangs on no anchor hangs on the outside: another block's point or an anticipator's.
    """

    spec: PegSpec
    time: float | None
    anchor: Anchor | None


def filled(item: Item, known: Mapping[int, Placed]) -> list[Placed]:
    """All points from the known ones: a ratio between two of them, else at a distance from the nearest."""
    offsets = item.timing.offsets
    stretch = average_stretch(offsets, {i: p.time for i, p in known.items() if p.time is not None})
    placed = []
    for i in range(len(offsets)):
        before = max((k for k in known if k <= i), default=None)
        after = min((k for k in known if k >= i), default=None)
        if before is not None and after is not None:
            ratio = ratio_between(offsets, before, i, after)
            placed.append(known[i] if i in known else _between(known[before], known[after], ratio))
        else:
            nearest = before if before is not None else min(known)
            placed.append(moved(known[nearest], (offsets[i] - offsets[nearest]) * stretch))
    return placed


def cells_of(spec: PegSpec) -> set[TimeCell]:
    """The pegs of the outside that one hangs on, in whatever number of steps."""
    cells: set[TimeCell] = set()
    seen, links = {spec}, [*spec.links]
    while links:
        link = links.pop()
        if isinstance(link, Cell):
            cells.add(link)
        elif link not in seen:
            seen.add(link)
            links += link.links
    return cells


def is_past(placed: Placed) -> bool:
    """Whether a point lies before its block; those of free clusters have been moved."""
    free = placed.anchor is not None and placed.anchor.free
    return not free and placed.time is not None and placed.time < -SHORTEST


def moved(placed: Placed, distance: float) -> Placed:
    """At a distance (s) from another one; the same where there is none."""
    if distance == 0:
        return placed
    time = None if placed.time is None else placed.time + distance
    return Placed(AtOffset(placed.spec, distance), time, placed.anchor)


def check_given(item: Item, known: Mapping[int, Placed]) -> None:
    """Refuse times that were asked for and are out of order, by the names they were asked for.

    Raises:
        RealizerError: "out-of-order".
    """
    given = [(item.timing.points[i], time) for i, p in sorted(known.items()) if (time := p.time) is not None]
    _check_order(itertools.combinations(given, 2))


def check_playable(item: Item, placed: Sequence[Placed]) -> None:
    """Refuse what cannot be played (thesis 7.14, 7.15).

    Raises:
        RealizerError: points out of order, or no time at all between start and end.
    """
    known = [(sync, p.time) for sync, p in zip(item.timing.points, placed, strict=True) if p.time is not None]
    _check_order(itertools.pairwise(known))
    start, end = placed[0].time, placed[-1].time
    if not item.timing.instant and start is not None and end is not None and end - start < SHORTEST:
        raise error("too-short")


def _between(before: Placed, after: Placed, ratio: float) -> Placed:
    time = None
    if before.time is not None and after.time is not None:
        time = before.time + ratio * (after.time - before.time)
    return Placed(AtRatio(before.spec, after.spec, ratio), time, before.anchor)


def _check_order(pairs: Iterable[tuple[_Timed, _Timed]]) -> None:
    for (sync, time), (later, then) in pairs:
        if then < time - SHORTEST:
            raise error("out-of-order", sync=sync, later=later, gap=time - then)
