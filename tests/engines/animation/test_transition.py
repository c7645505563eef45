"""Transitions: the curves of rotations and what they lead to (thesis 4.2.4)."""

import math
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import (
    IDENTITY,
    Quat,
    angle,
    difference,
    from_axis_angle,
    from_euler,
    from_rotation_vector,
    rotation_vector,
)
from reactive_realizer.embodiment.vector import Vec3, scale, subtract
from reactive_realizer.engines.animation.motion_unit import Moment, Resource
from reactive_realizer.engines.animation.moving import Moving, Seen
from reactive_realizer.engines.animation.trail import Trail
from reactive_realizer.engines.animation.transition.curves import CURVES, slerped
from reactive_realizer.engines.animation.transition.hermite_curve import End, HermiteCurve
from reactive_realizer.engines.animation.transition.transition_motion_unit import TransitionMotionUnit

X: Vec3 = (1.0, 0.0, 0.0)
STEP = 2e-5

turns = st.tuples(*(st.floats(-1.0, 1.0) for _ in range(3))).map(lambda angles: from_euler(*angles))
velocities = st.tuples(*(st.floats(-4.0, 4.0) for _ in range(3)))
accelerations = st.tuples(*(st.floats(-20.0, 20.0) for _ in range(3)))
ends = st.builds(End, turns, velocities, accelerations)


def apart(a: Quat, b: Quat) -> float:
    return angle(difference(a, b))


def velocity(curve, u: float) -> Vec3:
    """In the axes of the joint, rad per unit of u, around u."""
    return scale(rotation_vector(difference(curve(u - 0.5 * STEP), curve(u + 0.5 * STEP))), 1.0 / STEP)


def acceleration(curve, u: float) -> Vec3:
    return scale(subtract(velocity(curve, u + STEP), velocity(curve, u - STEP)), 0.5 / STEP)


@settings(max_examples=100, deadline=None, derandomize=True)
@given(ends, ends)
def test_a_hermite_curve_has_rotations_velocities_and_accelerations_of_both_ends(start, goal):
    """M.-J. Kim, M.-S. Kim and S. Y. Shin (1995); thesis 4.2.4."""
    curve = HermiteCurve(start, goal)
    for end, u, inside in ((start, 0.0, 2 * STEP), (goal, 1.0, 1.0 - 2 * STEP)):
        assert apart(curve(u), end.rotation) < 1e-6
        assert velocity(curve, inside) == pytest.approx(end.velocity, abs=5e-3)
        assert acceleration(curve, inside) == pytest.approx(end.acceleration, abs=0.2)


@pytest.mark.parametrize("fast", [1.0, 8.0])
def test_between_its_ends_the_acceleration_of_a_hermite_curve_does_not_jump(fast):
    """What a joint that is fast brings along is over before the other end, and that is not felt either."""
    start = End(IDENTITY, scale((1.0, 0.0, 0.5), fast), (10.0, 0.0, 0.0))
    goal = End(from_euler(0.8, 0.4, -0.2), scale((0.0, -1.0, 0.0), fast), (0.0, 5.0, 5.0))
    curve = HermiteCurve(start, goal)
    samples = [acceleration(curve, i / 1000) for i in range(1, 1000)]
    steps = [math.dist(a, b) for a, b in pairwise(samples)]
    assert max(steps) < 0.05 * max(math.dist(a, (0.0, 0.0, 0.0)) for a in samples)


def test_however_fast_a_joint_is_it_does_not_swing_around_itself():
    for velocity_, acceleration_ in (((40.0, 0.0, 0.0), (0.0, 0.0, 0.0)), ((0.0, 0.0, 0.0), (900.0, 0.0, 0.0))):
        start = End(IDENTITY, velocity_, acceleration_)
        curve = HermiteCurve(start, End(IDENTITY))
        assert 0.45 < max(angle(curve(i / 500)) for i in range(501)) < 0.51
        assert velocity(curve, 2 * STEP) == pytest.approx(velocity_, abs=0.1)


def test_between_ends_at_rest_it_is_the_way_of_least_jerk():
    goal = from_axis_angle(X, 1.0)
    curve, same = (kind(End(IDENTITY), End(goal)) for kind in (HermiteCurve, slerped))
    assert [apart(curve(i / 20), same(i / 20)) for i in range(21)] == pytest.approx([0.0] * 21, abs=1e-7)


def test_a_slerp_goes_the_shortest_way_from_rest_to_rest():
    goal = from_axis_angle(X, 1.0)
    curve = slerped(End(IDENTITY, (5.0, 5.0, 5.0)), End(goal, (5.0, 5.0, 5.0)))
    assert [apart(curve(u), IDENTITY) for u in (0.0, 0.5, 1.0)] == pytest.approx([0.0, 0.5, 1.0], abs=1e-6)
    assert velocity(curve, STEP) == pytest.approx((0.0, 0.0, 0.0), abs=1e-3)


@settings(max_examples=100, deadline=None, derandomize=True)
@given(turns)
def test_a_rotation_is_the_turn_of_its_rotation_vector(turn):
    assert apart(from_rotation_vector(rotation_vector(turn)), turn) < 1e-6


def test_until_it_is_led_somewhere_the_joints_stay_where_they_were(skeleton):
    body = Body(skeleton, {"r_elbow": from_axis_angle(X, -0.7)})
    unit = TransitionMotionUnit(frozenset({"r_elbow"}), HermiteCurve)
    unit.start(body)
    assert unit.pose(Moment(0.7, 0.0, Body(skeleton))).rotations == {"r_elbow": body.rotation("r_elbow")}
    assert unit.resources == {Resource.RIGHT_ARM}


def test_it_leads_from_one_motion_into_another(skeleton):
    begin = Moving(
        Body(skeleton, {"r_elbow": from_axis_angle(X, -0.7)}),
        {"r_elbow": (0.5, 0.0, 0.0)},
        {"r_elbow": (2.0, 0.0, 0.0)},
    )
    goal = Moving(Body(skeleton, {"r_elbow": from_axis_angle(X, -0.2)}), {"r_elbow": (-0.8, 0.0, 0.0)}, {})
    unit = TransitionMotionUnit(frozenset({"r_elbow"}), CURVES["HermiteTransition"])
    unit.lead(begin, goal, 2.0)

    def elbow(seconds: float) -> float:
        w, x, _, _ = unit.pose(Moment(seconds / 2.0, 0.0, begin.body)).rotations["r_elbow"]
        return 2.0 * math.atan2(x, w)

    assert (elbow(0.0), elbow(2.0)) == pytest.approx((-0.7, -0.2))
    assert (elbow(0.001) - elbow(0.0)) / 0.001 == pytest.approx(0.5, abs=0.01)
    assert (elbow(2.0) - elbow(1.999)) / 0.001 == pytest.approx(-0.8, abs=0.01)
    assert (elbow(0.002) - 2 * elbow(0.001) + elbow(0.0)) / 0.001**2 == pytest.approx(2.0, abs=0.05)
    assert (elbow(2.0) - 2 * elbow(1.999) + elbow(1.998)) / 0.001**2 == pytest.approx(0.0, abs=0.05)


@pytest.mark.parametrize("step", [0.01, -0.01])
def test_a_joint_that_speeds_up_is_seen_to_do_so_from_before_and_from_after(skeleton, step):
    bodies = [Body(skeleton, {"r_elbow": from_axis_angle(X, 0.3 * t + 2.0 * t * t)}) for t in (2 * step, step, 0.0)]
    moving = Moving.through(*(Seen(t, body) for t, body in zip((2 * step, step, 0.0), bodies, strict=True)))
    assert moving.body is bodies[-1]
    assert moving.velocity("r_elbow") == pytest.approx((0.3, 0.0, 0.0))
    assert moving.acceleration("r_elbow") == pytest.approx((4.0, 0.0, 0.0))
    assert moving.velocity("l_elbow") == moving.acceleration("l_elbow") == (0.0, 0.0, 0.0)


class Followed:
    """A trail of a body that frames change."""

    def __init__(self, *frames: tuple[float, Body]) -> None:
        self.body = frames[0][1]
        self.trail = Trail(lambda: self.body)
        for time, body in frames:
            self.trail.frame(time)
            self.body = body


def test_a_body_goes_on_as_it_moved_in_the_last_two_frames(skeleton):
    bodies = [Body(skeleton, {"r_elbow": from_axis_angle(X, -0.1 * i)}) for i in range(4)]
    moving = Followed(*((0.02 * i, body) for i, body in enumerate(bodies))).trail.at(0.07)
    assert moving.velocity("r_elbow") == pytest.approx((-5.0, 0.0, 0.0))
    assert apart(moving.body.rotation("r_elbow"), from_axis_angle(X, -0.35)) < 1e-6
    assert moving.velocity("l_elbow") == (0.0, 0.0, 0.0)


def test_a_joint_that_was_put_elsewhere_does_not_go_on(skeleton):
    there = Body(skeleton, {"r_elbow": from_axis_angle(X, -1.0)})
    trail = Followed((0.02, Body(skeleton)), (0.04, there)).trail
    assert trail.at(0.05) == Moving(there, {}, {})


def test_of_a_body_that_was_not_watched_of_late_one_knows_no_more_than_its_pose(skeleton):
    there = Body(skeleton, {"r_elbow": from_axis_angle(X, -0.1)})
    never, once = Trail(lambda: there), Followed((0.02, Body(skeleton)), (0.04, there)).trail
    for trail in (never, once):
        assert trail.at(3.0) == Moving(there, {}, {})
        assert trail.last(3.0) is None
    assert once.at(0.05).velocities
    assert once.last(0.05) == (0.04, there)
    assert once.last(0.03) is None
