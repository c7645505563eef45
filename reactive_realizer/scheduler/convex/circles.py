"""Circles of phases: a chain of phases that is tied at both ends only is a problem with one unknown.

Most phases that are stretched at all lie on such a circle: those of a behavior between two given times, or of one that
has to hurry to start within its block.
"""

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from math import inf
from typing import NamedTuple

from reactive_realizer.scheduler.convex.costs import SLACK, STIFFNESS
from reactive_realizer.scheduler.convex.model import START, BoundArc
from reactive_realizer.scheduler.convex.spans import Span

_STEPS = 100
_CLOSES = 1e-13
"""Relative error with which a circle is closed."""

_STRONGEST = 1e9
"""A force that shortens a second to a nanosecond: a circle that it does not close cannot be closed."""


class _Edge(NamedTuple):
    """``x[head] - x[tail] = length - shift``; the length of an edge without a span, a bound, is 0 or more."""

    tail: int
    head: int
    shift: float
    span: Span | None


class _Side(NamedTuple):
    """An edge of a circle, and whether it leads forward (1) or back (-1)."""

    edge: _Edge
    sign: float


def solve_circles(spans: Sequence[Span], bounds: Sequence[BoundArc]) -> dict[int, float] | None:
    """The times of least cost within the limits of spans, if the graph consists of circles that share single variables.

    Returns:
        Times (s) of the variables, the first one of each component at 0; None if the graph is not of that kind.
    """
    if not {span.guide for span in spans}.isdisjoint(spans):
        return None
    edges = [_Edge(s.tail, s.head, s.shift, s) for s in spans]
    edges += [_Edge(b.tail, b.head, -b.length, None) for b in bounds]
    lengths: dict[_Edge, float] = {}
    for circle in _circles(edges):
        solved = _solve(circle) if circle else None
        if solved is None:
            return None
        lengths |= solved
    return _times(lengths)


def _circles(edges: Sequence[_Edge]) -> Iterator[list[_Side]]:
    """All edges in circles; an empty circle if some edges are in none."""
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
    """The path from a corner back to it, or nothing if it leads to another corner; removes its edges from ``left``."""
    path: list[_Side] = []
    node = start
    while True:
        del left[edge]
        path.append(_Side(edge, 1.0 if node == edge.tail else -1.0))
        node = edge.head if node == edge.tail else edge.tail
        following = [other for other in at[node] if other in left]
        if node == start:
            return path
        if node in corners or not following:
            return []
        edge = following[0]


def _solve(circle: Sequence[_Side]) -> dict[_Edge, float] | None:
    """The lengths of least cost that close a circle; None if none do."""
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
    """The force at which the length of a span becomes infinite; a span with a maximum has none."""
    span = side.edge.span
    if span is None or span.maximum < inf:
        return _STRONGEST
    return 1.0 if span.elastic else STIFFNESS


def _sum(sides: Sequence[_Side], force: float) -> float:
    return sum(side.sign * _length(side, force) for side in sides)


def _length(side: _Side, force: float) -> float:
    """The length (s) at which the cost of a span rises as fast as a force pulls (`Costs`), within its limits."""
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
    """The derivative of the length by the force; 0 at a limit."""
    span, pull = side.edge.span, side.sign * force
    if span is None or not span.minimum < _wish(span, pull) < span.maximum:
        return 0.0
    if span.elastic:
        return span.goal / (1.0 - pull) ** 2
    return (span.goal + SLACK) / STIFFNESS / (1.0 - pull / STIFFNESS) ** 2


def _times(lengths: Mapping[_Edge, float]) -> dict[int, float]:
    """The times of the variables, from the first one of each component on."""
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
