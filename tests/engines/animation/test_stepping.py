"""Steps: paths of feet, one foot at a time."""

import math
from itertools import pairwise

import pytest

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Transform
from reactive_realizer.embodiment.quaternion import IDENTITY, from_euler
from reactive_realizer.embodiment.vector import Vec3, add
from reactive_realizer.engines.animation.easing import minimum_jerk
from reactive_realizer.engines.animation.posture.stepping import Foot, FootAlternation, leading, stepped, swung

LEFT, RIGHT = (0.1, 0.08, 0.0), (-0.1, 0.08, 0.0)
STANDING = (Transform(LEFT, IDENTITY), Transform(RIGHT, IDENTITY))
FRAMES = 1000


def moved(left: Vec3, right: Vec3 = (0.0, 0.0, 0.0), yaw: float = 0.0) -> tuple[Transform, Transform]:
    """Both feet displaced, m, with the left one turned outward, rad."""
    return Transform(add(LEFT, left), from_euler(0.0, yaw, 0.0)), Transform(add(RIGHT, right), IDENTITY)


def way(before: tuple[Transform, Transform], after: tuple[Transform, Transform], foot: int) -> list[Transform]:
    """Where a foot is on its way, in equal times of an eased weight."""
    leader = leading(before, after)
    start = tuple(map(Foot, before))
    return [stepped(start, after, minimum_jerk(i / FRAMES), leader)[foot].place for i in range(FRAMES + 1)]


def lifts(places: list[Transform]) -> list[float]:
    """How high a foot is above the straight line of its way, m."""
    start, goal = places[0].position, places[-1].position
    far = math.dist((start[0], start[2]), (goal[0], goal[2]))
    gone = [math.dist((start[0], start[2]), (p.position[0], p.position[2])) / far for p in places]
    return [p.position[1] - start[1] - g * (goal[1] - start[1]) for p, g in zip(places, gone, strict=True)]


def test_a_longer_step_is_lifted_higher_up_to_ten_centimeters() -> None:
    highest = [max(lifts(way(STANDING, moved((far, 0.0, 0.0)), 0))) for far in (0.01, 0.03, 0.08, 0.2, 0.5)]
    assert highest == sorted(highest)
    assert highest == pytest.approx([0.011, 0.027, 0.05, 0.071, 0.086], abs=0.001)


@pytest.mark.parametrize("far", [0.06, 0.2, 0.5])
def test_a_foot_is_a_centimeter_above_the_ground_while_it_moves_over_it(far: float) -> None:
    places = way(STANDING, moved((far, 0.0, 0.0)), 0)
    for a, b in pairwise(places):
        if max(a.position[1], b.position[1]) < LEFT[1] + 0.01:
            assert abs(b.position[0] - a.position[0]) < far / FRAMES


def test_a_step_starts_and_ends_at_rest() -> None:
    high = lifts(way(STANDING, moved((0.2, 0.0, 0.0)), 0))
    speeds = [b - a for a, b in pairwise(high)]
    rising = [i for i, speed in enumerate(speeds) if abs(speed) > 1e-9]
    assert abs(speeds[rising[0]]) < 0.1 * max(speeds)
    assert abs(speeds[rising[-1]]) < 0.1 * max(speeds)
    assert sum((a > 0.0) != (b > 0.0) for a, b in pairwise([speeds[i] for i in rising])) == 1, "up once, down once"


def test_feet_step_in_turn_for_equal_times() -> None:
    after = moved((0.2, 0.0, 0.0), (-0.2, 0.0, 0.0))
    left, right = ([p.position[1] > LEFT[1] + 1e-6 for p in way(STANDING, after, foot)] for foot in (0, 1))
    assert not any(a and b for a, b in zip(left, right, strict=True))
    assert sum(left) == pytest.approx(sum(right), rel=0.02)
    assert sum(left) > 0.4 * FRAMES


def test_a_foot_that_only_turns_is_lifted_too() -> None:
    turned = way(STANDING, moved((0.0, 0.0, 0.0), yaw=0.5), 0)
    assert max(place.position[1] for place in turned) > LEFT[1] + 0.03


def test_a_foot_that_only_rises_goes_straight_up() -> None:
    raised = way(STANDING, moved((0.0, 0.2, 0.0)), 0)
    assert max(place.position[1] for place in raised) == pytest.approx(LEFT[1] + 0.2)
    assert all(a.position[1] <= b.position[1] for a, b in pairwise(raised))


def test_a_foot_that_stays_is_not_lifted() -> None:
    assert set(way(STANDING, moved((0.3, 0.0, 0.0)), 1)) == {STANDING[1]}


@pytest.mark.parametrize(("raised", "first"), [((0.0, 0.2, 0.0), 1), ((0.0, 0.005, 0.0), 0)])
def test_the_foot_that_comes_down_to_the_ground_goes_first(raised: Vec3, first: int) -> None:
    crossed = moved((0.0, 0.0, 0.0), raised)
    assert leading(crossed, STANDING) == first
    assert leading(STANDING, crossed) == 0


def test_feet_stay_within_a_stride_on_long_walks() -> None:
    after = moved((0.0, 0.0, 3.0), (0.0, 0.0, 3.0))
    shown = [stepped(tuple(map(Foot, STANDING)), after, i / FRAMES, 0) for i in range(FRAMES + 1)]
    assert max(abs(left.place.position[2] - right.place.position[2]) for left, right in shown) < 0.6
    assert shown[-1] == tuple(map(Foot, after))


def test_a_foot_knows_the_lift_of_its_step() -> None:
    """Also of a foot that was in the air: its earlier lift decreases on the way."""
    start = (Foot(Transform(add(LEFT, (0.0, 0.05, 0.0)), IDENTITY), lift=0.05), Foot(STANDING[1]))
    after = moved((0.2, 0.0, 0.0))
    frames = [stepped(start, after, minimum_jerk(i / FRAMES), 0) for i in range(FRAMES + 1)]
    for left, right in frames:
        assert left.place.position[1] == pytest.approx(LEFT[1] + left.lift)
        assert right.lift == 0.0
    assert frames[-1][0].lift == pytest.approx(0.0)


HIGH = 0.08
"""Height of the ankle of a standing foot, m."""

FRAME = 0.02


def at(x: float) -> Foot:
    return Foot(Transform((x, HIGH, 0.0), IDENTITY))


def stepping(begin: float, end: float, start: float, goal: float, now: float) -> Foot:
    """A foot that steps from one place to another within a time, s."""
    return swung(at(start), at(goal), min(1.0, max(0.0, (now - begin) / (end - begin))))


def shown(left: tuple[float, float], right: tuple[float, float], until: float = 2.5) -> list[tuple[Transform, ...]]:
    """Frames of two feet with requested side steps, each from one time to another, s."""
    carrying = FootAlternation()
    times = [GlobalTime(FRAME * i) for i in range(round(until / FRAME))]
    return [carrying((stepping(*left, 0.1, 0.3, t), stepping(*right, -0.1, -0.3, t)), t) for t in times]


def lifted(place: Transform) -> bool:
    return place.position[1] > HIGH + 0.01


def test_feet_that_step_in_turn_follow_their_goals() -> None:
    left, right = (0.2, 0.8), (0.8, 1.4)
    for i, (one, other) in enumerate(shown(left, right)):
        now = FRAME * i
        assert (one, other) == (stepping(*left, 0.1, 0.3, now).place, stepping(*right, -0.1, -0.3, now).place)


@pytest.mark.parametrize("begin", [0.2, 0.22, 0.4, 0.7])
def test_a_foot_waits_while_the_other_is_in_the_air(begin: float) -> None:
    feet = shown((0.2, 0.8), (begin, begin + 0.6))
    assert not any(lifted(left) and lifted(right) for left, right in feet)
    assert any(lifted(left) for left, _ in feet)
    assert any(lifted(right) for _, right in feet)


def test_a_delayed_foot_follows_with_a_step_of_its_own() -> None:
    feet = [right for _, right in shown((0.2, 0.8), (0.4, 1.0))]
    assert feet[-1].position == pytest.approx((-0.3, HIGH, 0.0))
    for a, b in pairwise(feet):
        assert lifted(a) or lifted(b) or abs(b.position[0] - a.position[0]) < 1e-3


def test_feet_are_settled_when_both_have_arrived() -> None:
    carrying = FootAlternation()
    settled = []
    for i in range(100):
        now = GlobalTime(FRAME * i)
        carrying((stepping(0.2, 0.8, 0.1, 0.3, now), stepping(0.4, 1.0, -0.1, -0.3, now)), now)
        settled.append(carrying.settled)
    assert settled[0]
    assert settled[-1]
    assert not all(settled)


def test_feet_shown_long_ago_have_no_effect() -> None:
    carrying = FootAlternation()
    carrying((at(0.1), at(-0.1)), GlobalTime(0.0))
    wanted = (Foot(Transform((0.2, 0.15, 0.0), IDENTITY), 0.07), Foot(Transform((-0.2, 0.15, 0.0), IDENTITY), 0.07))
    assert carrying(wanted, GlobalTime(5.0)) == tuple(foot.place for foot in wanted)
