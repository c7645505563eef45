"""Behaviors cut at the points that matter to others."""

import itertools
from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple

from reactive_realizer.planunit.timing import PhaseKind
from reactive_realizer.scheduler.problem import Item, Point, Precedence, Tie


class Span(NamedTuple):
    """What lies between two knots of a behavior: stretched as a whole, its phases keep their proportions.

    Attributes:
        start: the earlier knot.
        end: the later one.
        preferred: duration, s.
        rigid: whether it cannot be stretched; all other phases are alike to EMBR.
    """

    start: Point
    end: Point
    preferred: float
    rigid: bool


def knots_of(items: Iterable[Item], constraints: Iterable[Tie | Precedence]) -> dict[str, tuple[int, ...]]:
    """Of each behavior, the indices of its first and last point, those that are named, and those of rigid phases."""
    named = {node for each in constraints for node in each.nodes}
    knots = {}
    for item in items:
        points = item.timing.points
        own = {i for i, sync in enumerate(points) if Point(item.behavior.id, sync) in named}
        rigid = [phase.kind is PhaseKind.RIGID for phase in item.timing.phases]
        own |= {i for i in range(1, len(rigid)) if rigid[i] is not rigid[i - 1]}
        knots[item.behavior.id] = tuple(sorted(own | {0, len(points) - 1}))
    return knots


def spans_of(items: Iterable[Item], knots: Mapping[str, tuple[int, ...]]) -> Iterator[Span]:
    """The spans of all behaviors."""
    for item in items:
        offsets = item.timing.offsets
        for first, last in itertools.pairwise(knots[item.behavior.id]):
            start, end = (Point(item.behavior.id, item.timing.points[i]) for i in (first, last))
            rigid = item.timing.phases[first].kind is PhaseKind.RIGID
            yield Span(start, end, offsets[last] - offsets[first], rigid)
