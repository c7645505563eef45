"""Ways around obstacles."""

import math
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive_realizer.embodiment.world import Ground, Obstacle
from reactive_realizer.engines.animation.walking.route import length_of, route

coordinates = st.floats(-5.0, 5.0)
points = st.tuples(coordinates, coordinates)
obstacles = st.lists(st.builds(Obstacle, points, st.floats(0.1, 1.5)), max_size=5)


def clearance(start: Ground, end: Ground, place: Ground) -> float:
    """How far a straight way stays away from a place, m."""
    shares = (k / 200 for k in range(201))
    along = ([a + share * (b - a) for a, b in zip(start, end, strict=True)] for share in shares)
    return min(math.dist(point, place) for point in along)


@given(points, points, obstacles)
def test_a_way_leads_through_no_obstacle_that_excludes_its_ends(
    start: Ground, goal: Ground, obstacles: list[Obstacle]
) -> None:
    corners = route(start, goal, obstacles)
    if corners is None:
        return
    way = (start, *corners, goal)
    for place, radius in obstacles:
        if min(math.dist(start, place), math.dist(goal, place)) >= 1.04 * radius:
            assert all(clearance(*leg, place) >= radius - 1e-3 for leg in pairwise(way))


@given(points, points, st.builds(Obstacle, points, st.floats(0.1, 1.5)))
def test_one_obstacle_makes_a_way_hardly_longer_than_the_shortest_around_it(
    start: Ground, goal: Ground, obstacle: Obstacle
) -> None:
    corners = route(start, goal, [obstacle])
    assert corners is not None
    straight = math.dist(start, goal)
    around = straight + (math.pi - 2.0) * obstacle.radius
    assert straight - 1e-9 <= length_of((start, *corners, goal)) <= 1.05 * around


def test_a_free_way_is_straight() -> None:
    assert route((0.0, 0.0), (0.0, 4.0), [Obstacle((2.0, 2.0), 1.0)]) == ()


@pytest.mark.parametrize(("aside", "side"), [(0.2, -1.0), (-0.2, 1.0)])
def test_a_way_leads_around_the_nearer_side(aside: float, side: float) -> None:
    corners = route((0.0, 0.0), (0.0, 4.0), [Obstacle((aside, 2.0), 1.0)])
    assert corners
    assert all(math.copysign(1.0, x) == side for x, _ in corners)


def test_a_goal_behind_a_closed_ring_has_no_way() -> None:
    angles = [k * math.pi / 3.0 for k in range(6)]
    ring = [Obstacle((2.0 * math.cos(angle), 2.0 * math.sin(angle)), 1.1) for angle in angles]
    assert route((5.0, 0.0), (0.0, 0.0), ring) is None
