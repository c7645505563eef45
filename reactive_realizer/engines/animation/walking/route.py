"""Ways around obstacles: the shortest path in a visibility graph.

T. Lozano-Perez and M. A. Wesley, "An algorithm for planning collision-free paths among polyhedral obstacles"
(Communications of the ACM 22, 1979); the search is A* (P. E. Hart and others, 1968).
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from heapq import heappop, heappush
from itertools import pairwise

from reactive_realizer.embodiment.world import Ground, Obstacle

_CORNERS = 12
"""Of the polygon around an obstacle, on which figures walk."""

_INSIDE = 1e-6
"""How far a way may lead into an obstacle, m: it touches corners."""

_MOST = 12
"""Limit of the obstacles that one way goes around."""


def route(start: Ground, goal: Ground, obstacles: Iterable[Obstacle]) -> tuple[Ground, ...] | None:
    """Return the corners of the shortest way to a goal, without the start and the goal.

    An obstacle that the start or the goal lies in is smaller by so much that it does not.

    Args:
        start: on the ground, m.
        goal: on the ground, m.
        obstacles: with the clearance that a figure needs.

    Returns:
        Nothing (an empty tuple) if the straight way is free; None if no way is.
    """
    free = [each for obstacle in obstacles if (each := _outside(obstacle, (start, goal))).radius > 0.0]
    near: list[Obstacle] = []
    for _ in range(_MOST):
        corners = _search(start, goal, near)
        if corners is None:
            return None
        way = (start, *corners, goal)
        hit = [each for each in free if each not in near and any(_blocks(each, *leg) for leg in _legs(way))]
        if not hit:
            return corners
        near += hit
    return None


def length_of(points: Sequence[Ground]) -> float:
    """Return the length of a way through points, m."""
    return sum(math.dist(*leg) for leg in _legs(points))


def _legs(points: Sequence[Ground]) -> Iterator[tuple[Ground, Ground]]:
    return pairwise(points)


def _outside(obstacle: Obstacle, points: Iterable[Ground]) -> Obstacle:
    """Return the obstacle, or a smaller one whose corners exclude some points."""
    nearest = min(math.dist(obstacle.place, point) for point in points)
    return obstacle._replace(radius=min(obstacle.radius, nearest * math.cos(math.pi / _CORNERS)))


def _search(start: Ground, goal: Ground, obstacles: Sequence[Obstacle]) -> tuple[Ground, ...] | None:
    """Return the corners of the shortest way around some obstacles; None if there is none."""
    places = [start, goal, *(corner for each in obstacles for corner in _polygon(each, obstacles))]
    lengths, before = {0: 0.0}, dict[int, int]()
    waiting, done = [(math.dist(start, goal), 0)], set[int]()
    while waiting:
        _, here = heappop(waiting)
        if here == 1:
            return tuple(reversed([places[k] for k in _back(1, before)]))
        if here in done:
            continue
        done.add(here)
        for there, place in enumerate(places):
            length = lengths[here] + math.dist(places[here], place)
            if there in done or length >= lengths.get(there, math.inf):
                continue
            if not any(_blocks(each, places[here], place) for each in obstacles):
                lengths[there], before[there] = length, here
                heappush(waiting, (length + math.dist(place, goal), there))
    return None


def _back(place: int, before: dict[int, int]) -> Iterator[int]:
    """Yield the places between the start and a place, the last first."""
    while (place := before[place]) != 0:
        yield place


def _polygon(obstacle: Obstacle, others: Iterable[Obstacle]) -> Iterator[Ground]:
    """Yield the corners of a polygon around an obstacle that lie in no other one."""
    x, z = obstacle.place
    radius = obstacle.radius / math.cos(math.pi / _CORNERS)
    for k in range(_CORNERS):
        angle = 2.0 * math.pi * k / _CORNERS
        corner = (x + radius * math.cos(angle), z + radius * math.sin(angle))
        if all(math.dist(corner, each.place) >= each.radius - _INSIDE for each in others):
            yield corner


def _blocks(obstacle: Obstacle, start: Ground, end: Ground) -> bool:
    """Return whether a straight way leads through an obstacle."""
    (x, z), (from_x, from_z) = obstacle.place, start
    along_x, along_z = end[0] - from_x, end[1] - from_z
    squared = along_x * along_x + along_z * along_z
    share = 0.0 if squared == 0.0 else ((x - from_x) * along_x + (z - from_z) * along_z) / squared
    share = min(1.0, max(0.0, share))
    return math.hypot(from_x + share * along_x - x, from_z + share * along_z - z) < obstacle.radius - _INSIDE
