"""The ways of feet from where they stand to where they are to stand."""

import math
from itertools import pairwise

import pytest

from reactive_realizer.embodiment.quaternion import IDENTITY, from_euler
from reactive_realizer.embodiment.skeleton import Place
from reactive_realizer.embodiment.vector import Vec3, add
from reactive_realizer.engines.animation.easing import minimum_jerk
from reactive_realizer.engines.animation.posture.steps import Foot, leading, stepped

LEFT, RIGHT = (0.1, 0.08, 0.0), (-0.1, 0.08, 0.0)
STANDING = (Place(LEFT, IDENTITY), Place(RIGHT, IDENTITY))
FRAMES = 1000


def moved(left: Vec3, right: Vec3 = (0.0, 0.0, 0.0), yaw: float = 0.0) -> tuple[Place, Place]:
    """Both feet, elsewhere by so much, m, the left one turned outward, rad."""
    return Place(add(LEFT, left), from_euler(0.0, yaw, 0.0)), Place(add(RIGHT, right), IDENTITY)


def way(before, after, foot: int) -> list[Place]:
    """Where a foot is on its way, in equal times of an eased weight."""
    leader = leading(before, after)
    start = tuple(map(Foot, before))
    return [stepped(start, after, minimum_jerk(i / FRAMES), leader)[foot].place for i in range(FRAMES + 1)]


def lifts(places: list[Place]) -> list[float]:
    """How high a foot is above the straight line of its way, m."""
    start, goal = places[0].position, places[-1].position
    far = math.dist((start[0], start[2]), (goal[0], goal[2]))
    gone = [math.dist((start[0], start[2]), (p.position[0], p.position[2])) / far for p in places]
    return [p.position[1] - start[1] - g * (goal[1] - start[1]) for p, g in zip(places, gone, strict=True)]


def test_the_farther_a_foot_goes_the_higher_it_is_lifted_up_to_ten_centimeters():
    highest = [max(lifts(way(STANDING, moved((far, 0.0, 0.0)), 0))) for far in (0.01, 0.03, 0.08, 0.2, 0.5)]
    assert highest == sorted(highest)
    assert highest == pytest.approx([0.011, 0.027, 0.05, 0.071, 0.086], abs=0.001)


@pytest.mark.parametrize("far", [0.06, 0.2, 0.5])
def test_a_foot_is_a_centimeter_high_before_it_goes_anywhere_and_when_it_has_arrived(far):
    places = way(STANDING, moved((far, 0.0, 0.0)), 0)
    for a, b in pairwise(places):
        if max(a.position[1], b.position[1]) < LEFT[1] + 0.01:
            assert abs(b.position[0] - a.position[0]) < far / FRAMES


def test_a_step_is_at_rest_where_it_leaves_the_ground_and_where_it_comes_down():
    high = lifts(way(STANDING, moved((0.2, 0.0, 0.0)), 0))
    speeds = [b - a for a, b in pairwise(high)]
    rising = [i for i, speed in enumerate(speeds) if abs(speed) > 1e-9]
    assert abs(speeds[rising[0]]) < 0.1 * max(speeds)
    assert abs(speeds[rising[-1]]) < 0.1 * max(speeds)
    assert sum((a > 0.0) != (b > 0.0) for a, b in pairwise([speeds[i] for i in rising])) == 1, "up once, down once"


def test_one_foot_stands_while_the_other_steps_and_both_get_the_same_time():
    after = moved((0.2, 0.0, 0.0), (-0.2, 0.0, 0.0))
    left, right = ([p.position[1] > LEFT[1] + 1e-6 for p in way(STANDING, after, foot)] for foot in (0, 1))
    assert not any(a and b for a, b in zip(left, right, strict=True))
    assert sum(left) == pytest.approx(sum(right), rel=0.02)
    assert sum(left) > 0.4 * FRAMES


def test_a_foot_that_only_turns_is_lifted_too():
    turned = way(STANDING, moved((0.0, 0.0, 0.0), yaw=0.5), 0)
    assert max(place.position[1] for place in turned) > LEFT[1] + 0.03


def test_a_foot_that_only_rises_goes_straight_up():
    raised = way(STANDING, moved((0.0, 0.2, 0.0)), 0)
    assert max(place.position[1] for place in raised) == pytest.approx(LEFT[1] + 0.2)
    assert all(a.position[1] <= b.position[1] for a, b in pairwise(raised))


def test_a_foot_that_stays_is_not_lifted():
    assert set(way(STANDING, moved((0.3, 0.0, 0.0)), 1)) == {STANDING[1]}


@pytest.mark.parametrize(("raised", "first"), [((0.0, 0.2, 0.0), 1), ((0.0, 0.005, 0.0), 0)])
def test_the_foot_that_comes_down_to_the_ground_goes_first(raised, first):
    crossed = moved((0.0, 0.0, 0.0), raised)
    assert leading(crossed, STANDING) == first
    assert leading(STANDING, crossed) == 0


def test_in_far_walks_a_foot_is_never_more_than_a_stride_from_the_other():
    after = moved((0.0, 0.0, 3.0), (0.0, 0.0, 3.0))
    shown = [stepped(tuple(map(Foot, STANDING)), after, i / FRAMES, 0) for i in range(FRAMES + 1)]
    assert max(abs(left.place.position[2] - right.place.position[2]) for left, right in shown) < 0.6
    assert shown[-1] == tuple(map(Foot, after))


def test_it_is_known_how_much_of_a_foots_height_is_that_of_its_step():
    """Also of one that was in the air already: of that it has less the farther it goes."""
    start = (Foot(Place(add(LEFT, (0.0, 0.05, 0.0)), IDENTITY), lift=0.05), Foot(STANDING[1]))
    after = moved((0.2, 0.0, 0.0))
    for i in range(FRAMES + 1):
        left, right = stepped(start, after, minimum_jerk(i / FRAMES), 0)
        assert left.place.position[1] == pytest.approx(LEFT[1] + left.lift)
        assert right.lift == 0.0
    assert left.lift == pytest.approx(0.0)
