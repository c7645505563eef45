"""Circles of phases: what is tied at both ends, and to nothing else between, is a problem of one unknown.

Most of what is stretched at all is such a circle: a behavior between two given times, or one that has to be hurried to
start within its block.
"""

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from math import inf
from typing import NamedTuple

from reactive_realizer.scheduler.convex.costs import SLACK, STIFFNESS
from reactive_realizer.scheduler.convex.model import START
from reactive_realizer.scheduler.convex.span import Bound, Span

_STEPS = 100
_CLOSES = 1e-13
"""Relative error with which a circle is closed."""

_STRONGEST = 1e9
"""A force that leaves of every second no more than a nanosecond; what it does not close, nothing does."""


class _Edge(NamedTuple):
    """``x[head] - x[tail] = length - shift``; the length of a bound, which is no span, is any from 0 on."""

    tail: int
    head: int
    shift: float
    span: Span | None


class _Side(NamedTuple):
    """An edge of a circle, and whether it leads forward (1) or back (-1)."""

    edge: _Edge
    sign: float


def solve_circles(spans: Sequence[Span], bounds: Sequence[Bound]) -> dict[int, float] | None:
    """The times of least cost, limits of spans included, if all there is are circles that touch in single variables.

    Returns:
        Times (s) of the variables, the first one of all that hang together at 0; None where there is more than circles.
    """
    if not {span.guide for span in spans}.isdisjoint(spans):
        return None
    edges = [_Edge(s.tail, s.head, s.shift, s) for s in spans]
    edges += [_Edge(b.earlier, b.later, -b.distance, None) for b in bounds]
    lengths: dict[_Edge, float] = {}
    for circle in _circles(edges):
        solved = _solve(circle) if circle else None
        if solved is None:
            return None
        lengths |= solved
    return _times(lengths)


def _circles(edges: Sequence[_Edge]) -> Iterator[list[_Side]]:
    """All edges in circles; an empty one where some are in none."""
    at: defaultdict[int, list[_Edge]] = defaultdict(list)
    for edge in edges:
        at[edge.tail].append(edge)
        at[edge.head].append(edge)
    corners = {node for node, around in at.items() if node == START or len(around) != 2}
    left = dict.fromkeys(edges)
    for corner in [*sorted(corners), *sorted(at.keys() - corners)]:
        for edge in at[corner]:
            if edge in left:
                yield _around(corner, edge, at, corners, left)


def _around(
    start: int, edge: _Edge, at: Mapping[int, Sequence[_Edge]], corners: set[int], left: dict[_Edge, None]
) -> list[_Side]:
    """The way from a corner on until the next one, if that is the same; takes away what it passes."""
    way: list[_Side] = []
    node = start
    while True:
        del left[edge]
        way.append(_Side(edge, 1.0 if node == edge.tail else -1.0))
        node = edge.head if node == edge.tail else edge.tail
        following = [other for other in at[node] if other in left]
        if node == start:
            return way
        if node in corners or not following:
            return []
        edge = following[0]


def _solve(circle: Sequence[_Side]) -> dict[_Edge, float] | None:
    """The lengths of least cost that lead back to where they began."""
    sides = [side for side in circle if side.edge.span is not None]
    bounds = [side for side in circle if side.edge.span is None]
    if len(bounds) > 1:
        return None
    shift = sum(side.sign * side.edge.shift for side in circle)
    lengths = {bound.edge: (shift - _sum(sides, 0.0)) * bound.sign for bound in bounds}
    if any(slack >= 0.0 for slack in lengths.values()):
        force: float | None = 0.0
    else:
        force, lengths = _force(sides, shift), dict.fromkeys(lengths, 0.0)
    return None if force is None else lengths | {side.edge: _length(side, force) for side in sides}


def _force(sides: Sequence[_Side], total: float) -> float | None:
    """The force with which the lengths of all sides add up to a total (s), by Newton's steps within brackets."""
    low = -min((_stiffness(side) for side in sides if side.sign < 0), default=_STRONGEST)
    high = min((_stiffness(side) for side in sides if side.sign > 0), default=_STRONGEST)
    force = 0.0
    for _ in range(_STEPS):
        gap = total - _sum(sides, force)
        if abs(gap) <= _CLOSES * (1.0 + abs(total)):
            return force
        low, high = (force, high) if gap > 0 else (low, force)
        slope = sum(_slope(side, force) for side in sides)
        force = force + gap / slope if slope else high
        if not low < force < high:
            force = (low + high) / 2
    return None


def _stiffness(side: _Side) -> float:
    """The force that would stretch a span without end; one that has a longest length it only brings there."""
    span = side.edge.span
    if span is None or span.maximum < inf:
        return _STRONGEST
    return 1.0 if span.elastic else STIFFNESS


def _sum(sides: Sequence[_Side], force: float) -> float:
    return sum(side.sign * _length(side, force) for side in sides)


def _length(side: _Side, force: float) -> float:
    """How long (s) a span is where its cost rises as fast as a force pulls (`Costs`), within its limits."""
    span = side.edge.span
    if span is None:
        return 0.0
    return min(max(_wish(span, side.sign * force), span.minimum), span.maximum)


def _wish(span: Span, pull: float) -> float:
    if pull >= (1.0 if span.elastic else STIFFNESS):
        return inf
    if span.elastic:
        return span.goal / (1.0 - pull)
    return (span.goal + SLACK) / (1.0 - pull / STIFFNESS) - SLACK


def _slope(side: _Side, force: float) -> float:
    """How fast that grows with the force; not at all at a limit."""
    span, pull = side.edge.span, side.sign * force
    if span is None or not span.minimum < _wish(span, pull) < span.maximum:
        return 0.0
    if span.elastic:
        return span.goal / (1.0 - pull) ** 2
    return (span.goal + SLACK) / STIFFNESS / (1.0 - pull / STIFFNESS) ** 2


def _times(lengths: Mapping[_Edge, float]) -> dict[int, float]:
    """Of the variables, from the first of all that hang together on."""
    steps: defaultdict[int, list[tuple[int, float]]] = defaultdict(list)
    for edge, length in lengths.items():
        steps[edge.tail].append((edge.head, length - edge.shift))
        steps[edge.head].append((edge.tail, edge.shift - length))
    times: dict[int, float] = {}
    for first in sorted(steps):
        waiting = [] if first in times else [(first, 0.0)]
        while waiting:
            node, time = waiting.pop()
            if node not in times:
                times[node] = time
                waiting += [(other, time + step) for other, step in steps[node]]
    return times
