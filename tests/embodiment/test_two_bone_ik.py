"""Inverse kinematics of arms and legs."""

import math
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive_realizer.embodiment.quaternion import angle, conjugate, multiply, rotate
from reactive_realizer.embodiment.two_bone_ik import Arm, Leg, Limb
from reactive_realizer.embodiment.vector import Vec3, add, cross, distance, dot, length, scale, subtract, unit

STRAIGHT = Arm((0.0, -0.25, 0.0), (0.0, -0.23, 0.0))
CROOKED = Arm((0.02, -0.25, 0.03), (-0.03, -0.22, 0.04))

number = st.floats(-1.0, 1.0)
direction = st.tuples(number, number, number).filter(lambda v: length(v) > 0.1).map(unit)
forward = direction.filter(lambda v: v[2] > -0.9)
swivel = st.floats(-3.0, 3.0)
arms = st.sampled_from([STRAIGHT, CROOKED])


def reached(arm: Limb, goal: Vec3, swivel: float = 0.0) -> tuple[Vec3, Vec3]:
    """The positions of elbow and wrist."""
    shoulder, elbow = arm.solve(goal, swivel)
    at = rotate(shoulder, arm.upper)
    return at, add(at, rotate(multiply(shoulder, elbow), arm.lower))


@settings(derandomize=True)
@given(arms, forward, st.floats(0.3, 0.99), swivel)
def test_the_wrist_reaches_any_goal_in_reach_within_a_millimeter(
    arm: Arm, way: Vec3, share: float, swivel: float
) -> None:
    goal = scale(way, share * arm.reach)
    _, wrist = reached(arm, goal, swivel)
    assert distance(wrist, goal) < 0.001


@settings(derandomize=True)
@given(direction, st.floats(0.0, 3.0), swivel)
def test_the_elbow_never_bends_backward(way: Vec3, far: float, swivel: float) -> None:
    _, elbow = STRAIGHT.solve(scale(way, far), swivel)
    w, x, y, z = elbow
    assert (y, z) == pytest.approx((0.0, 0.0), abs=1e-9)
    # Flexion is a turn about -x, and a forearm folds up to 150 degrees.
    assert -1e-9 <= 2.0 * math.atan2(-x, w) <= math.radians(150.001)


@settings(derandomize=True)
@given(forward, st.floats(1.0, 5.0))
def test_the_arm_stretches_toward_a_goal_out_of_reach_and_keeps_the_direction(way: Vec3, share: float) -> None:
    goal = scale(way, share * STRAIGHT.reach)
    _, wrist = reached(STRAIGHT, goal)
    assert unit(wrist) == pytest.approx(way, abs=1e-6)
    assert STRAIGHT.reach - 1e-9 <= length(wrist) <= 0.48 + 1e-9


def test_the_elbow_opens_smoothly_toward_full_extension() -> None:
    goals = [(0.0, 0.0, 0.40 + 0.001 * i) for i in range(120)]
    bends = [angle(STRAIGHT.solve(goal)[1]) for goal in goals]
    steps = [before - after for before, after in pairwise(bends)]
    assert min(steps) > -1e-9
    assert max(steps) < math.radians(2.0)


@settings(derandomize=True)
@given(forward, st.floats(0.4, 0.9), swivel)
def test_the_elbow_lies_at_the_swivel_angle_about_the_line_to_the_goal(way: Vec3, share: float, swivel: float) -> None:
    goal = scale(way, share * STRAIGHT.reach)
    still, _ = reached(STRAIGHT, goal, 0.0)
    turned, _ = reached(STRAIGHT, goal, swivel)
    a, b = (unit(subtract(elbow, scale(way, dot(elbow, way)))) for elbow in (still, turned))
    assert math.atan2(-dot(cross(a, b), way), dot(a, b)) == pytest.approx(swivel, abs=1e-6)


def test_without_swivel_the_elbow_hangs_below_a_hand_in_front_and_is_behind_a_hand_below() -> None:
    in_front, _ = reached(STRAIGHT, (0.0, 0.0, 0.35))
    below, _ = reached(STRAIGHT, (0.0, -0.35, 0.0))
    assert in_front[1] < -0.1
    assert below[2] < -0.1


def test_positive_swivel_turns_the_elbow_to_the_figures_right() -> None:
    elbow, _ = reached(STRAIGHT, (0.0, 0.0, 0.35), 0.5)
    assert elbow[0] < -0.05


def test_a_goal_at_the_shoulder_folds_the_arm_in_front() -> None:
    _, wrist = reached(STRAIGHT, (0.0, 0.0, 0.0))
    assert wrist[2] > 0.05


@settings(derandomize=True)
@given(forward.filter(lambda v: v[2] > -0.5), st.floats(0.35, 1.2), swivel, direction)
def test_a_goal_that_moves_a_millimeter_moves_the_arm_a_little(
    way: Vec3, share: float, swivel: float, step: Vec3
) -> None:
    goal = scale(way, share * STRAIGHT.reach)
    shoulder, elbow = STRAIGHT.solve(goal, swivel)
    shoulder_after, elbow_after = STRAIGHT.solve(add(goal, scale(step, 0.001)), swivel)
    turn = angle(multiply(conjugate(shoulder), shoulder_after))
    assert turn < math.radians(3.0)
    assert abs(angle(elbow) - angle(elbow_after)) < math.radians(3.0)


THIGH_AND_SHANK = Leg((0.0, -0.43, 0.01), (0.0, -0.42, -0.02))
below = direction.filter(lambda v: v[1] < 0.5)


@settings(derandomize=True)
@given(below, st.floats(0.3, 0.999), swivel)
def test_the_ankle_reaches_any_goal_in_reach_within_a_millimeter(way: Vec3, share: float, swivel: float) -> None:
    goal = scale(way, share * THIGH_AND_SHANK.reach)
    _, ankle = reached(THIGH_AND_SHANK, goal, swivel)
    assert distance(ankle, goal) < 0.001


@settings(derandomize=True)
@given(direction, st.floats(0.0, 3.0), swivel)
def test_the_knee_never_bends_forward(way: Vec3, far: float, swivel: float) -> None:
    leg = Leg((0.0, -0.43, 0.0), (0.0, -0.42, 0.0))
    w, x, y, z = leg.solve(scale(way, far), swivel)[1]
    assert (y, z) == pytest.approx((0.0, 0.0), abs=1e-9)
    assert -1e-9 <= 2.0 * math.atan2(x, w) <= math.radians(150.001)


def test_without_swivel_the_knee_is_in_front_of_a_foot_below_and_above_one_in_front() -> None:
    goal_below, goal_in_front = (0.0, -0.6, 0.0), (0.0, 0.0, 0.6)
    assert reached(THIGH_AND_SHANK, goal_below)[0][2] > 0.2
    assert reached(THIGH_AND_SHANK, goal_in_front)[0][1] > 0.2


def test_positive_swivel_turns_the_knee_to_the_figures_left() -> None:
    knee, _ = reached(THIGH_AND_SHANK, (0.0, -0.6, 0.0), 0.5)
    assert knee[0] > 0.1


def test_a_standing_leg_is_almost_straight() -> None:
    leg = Leg((0.0, -0.43, 0.0), (0.0, -0.42, 0.0))
    assert distance(reached(leg, (0.0, -0.85, 0.0))[1], (0.0, -0.85, 0.0)) < 0.001


def test_a_limb_with_its_lower_half_along_its_hinge_stays_as_it_is() -> None:
    turn, end = Leg((0.0, -0.4, 0.0), (0.4, 0.0, 0.0)).bent(Leg.HINGE, 0.3)
    assert sum(part * part for part in turn) == pytest.approx(1.0)
    assert end == pytest.approx((0.4, -0.4, 0.0))
