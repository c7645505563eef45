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
from reactive_realizer.embodiment.vector import Vec3, scale
from reactive_realizer.engines.animation.motion_unit import Moment, Resource
from reactive_realizer.engines.animation.moving import Moving
from reactive_realizer.engines.animation.trail import Trail
from reactive_realizer.engines.animation.transition.curves import CURVES, slerped
from reactive_realizer.engines.animation.transition.hermite_curve import HermiteCurve
from reactive_realizer.engines.animation.transition.transition_motion_unit import TransitionMotionUnit

X: Vec3 = (1.0, 0.0, 0.0)
STEP = 1e-5

turns = st.tuples(*(st.floats(-1.0, 1.0) for _ in range(3))).map(lambda angles: from_euler(*angles))
velocities = st.tuples(*(st.floats(-1.5, 1.5) for _ in range(3)))


def apart(a: Quat, b: Quat) -> float:
    return angle(difference(a, b))


def velocity(curve, u: float) -> Vec3:
    """In the axes of the joint, rad per unit of u."""
    return scale(rotation_vector(difference(curve(u), curve(u + STEP))), 1.0 / STEP)


@settings(max_examples=100, deadline=None, derandomize=True)
@given(turns, turns, velocities, velocities)
def test_a_hermite_curve_has_the_rotations_and_the_velocities_of_both_ends(start, goal, leaving, arriving):
    """M.-J. Kim, M.-S. Kim and S. Y. Shin (1995), section 4.2."""
    curve = HermiteCurve(start, goal, leaving, arriving)
    assert apart(curve(0.0), start) < 1e-6
    assert apart(curve(1.0), goal) < 1e-6
    assert velocity(curve, 0.0) == pytest.approx(leaving, abs=2e-3)
    assert velocity(curve, 1.0 - STEP) == pytest.approx(arriving, abs=2e-3)


def test_the_velocity_of_a_hermite_curve_changes_smoothly():
    """It is C2: the angular velocity has no corner anywhere."""
    curve = HermiteCurve(IDENTITY, from_euler(0.8, 0.4, -0.2), (1.0, 0.0, 0.5), (0.0, -1.0, 0.0))
    samples = [velocity(curve, i / 200) for i in range(200)]
    accelerations = [math.dist(a, b) * 200 for a, b in pairwise(samples)]
    assert max(abs(b - a) for a, b in pairwise(accelerations)) < 0.5


def test_a_velocity_that_would_swing_a_joint_around_itself_is_held_back():
    curve = HermiteCurve(IDENTITY, IDENTITY, (40.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    assert max(angle(curve(i / 50)) for i in range(51)) < 0.6


def test_a_slerp_goes_the_shortest_way_from_rest_to_rest():
    goal = from_axis_angle(X, 1.0)
    curve = slerped(IDENTITY, goal, (5.0, 5.0, 5.0), (5.0, 5.0, 5.0))
    assert [apart(curve(u), IDENTITY) for u in (0.0, 0.5, 1.0)] == pytest.approx([0.0, 0.5, 1.0], abs=1e-6)
    assert velocity(curve, 0.0) == pytest.approx((0.0, 0.0, 0.0), abs=1e-3)


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
    begin = Moving(Body(skeleton, {"r_elbow": from_axis_angle(X, -0.7)}), {"r_elbow": (0.5, 0.0, 0.0)})
    goal = Moving(Body(skeleton, {"r_elbow": from_axis_angle(X, -0.2)}), {"r_elbow": (-0.8, 0.0, 0.0)})
    unit = TransitionMotionUnit(frozenset({"r_elbow"}), CURVES["HermiteTransition"])
    unit.lead(begin, goal, 2.0)

    def elbow(seconds: float) -> float:
        w, x, _, _ = unit.pose(Moment(seconds / 2.0, 0.0, begin.body)).rotations["r_elbow"]
        return 2.0 * math.atan2(x, w)

    assert (elbow(0.0), elbow(2.0)) == pytest.approx((-0.7, -0.2))
    assert (elbow(0.001) - elbow(0.0)) / 0.001 == pytest.approx(0.5, abs=0.01)
    assert (elbow(2.0) - elbow(1.999)) / 0.001 == pytest.approx(-0.8, abs=0.01)


def test_a_body_goes_on_as_it_moved_in_the_last_two_frames(skeleton):
    trail = Trail()
    bodies = [Body(skeleton, {"r_elbow": from_axis_angle(X, -0.1 * i)}) for i in range(4)]
    for i, body in enumerate(bodies[:-1]):
        trail.frame(0.02 * (i + 1), body)  # shown in the frame before
    moving = trail.at(0.07, bodies[3])
    assert moving.velocity("r_elbow") == pytest.approx((-5.0, 0.0, 0.0))
    assert apart(moving.body.rotation("r_elbow"), from_axis_angle(X, -0.35)) < 1e-6
    assert moving.velocity("l_elbow") == (0.0, 0.0, 0.0)


def test_a_joint_that_was_put_elsewhere_does_not_go_on(skeleton):
    trail = Trail()
    there = Body(skeleton, {"r_elbow": from_axis_angle(X, -1.0)})
    trail.frame(0.02, Body(skeleton))
    trail.frame(0.04, Body(skeleton))
    assert trail.at(0.05, there) == Moving(there, {})


def test_of_a_body_that_was_not_watched_one_knows_no_more_than_its_pose(skeleton):
    trail, body = Trail(), Body(skeleton, {"r_elbow": from_axis_angle(X, -0.7)})
    assert trail.at(3.0, body) == Moving(body, {})
    trail.frame(1.0, Body(skeleton))
    assert trail.at(3.0, body) == Moving(body, {})
