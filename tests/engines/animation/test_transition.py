"""Transitions (thesis 4.2.4)."""

import math
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body, Skeleton
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
from reactive_realizer.engines.animation.kinematics import KinematicState
from reactive_realizer.engines.animation.motion_unit import Moment, Resource
from reactive_realizer.engines.animation.motions.rotation_curves import (
    CURVES,
    Curve,
    CurveEnd,
    GrowingArcs,
    HermiteCurve,
    slerped,
)
from reactive_realizer.engines.animation.motions.transition import TransitionMotionUnit

X: Vec3 = (1.0, 0.0, 0.0)
STEP = 2e-5

turns = st.tuples(*(st.floats(-1.0, 1.0) for _ in range(3))).map(lambda angles: from_euler(*angles))
velocities = st.tuples(*(st.floats(-4.0, 4.0) for _ in range(3)))
accelerations = st.tuples(*(st.floats(-20.0, 20.0) for _ in range(3)))
ends = st.builds(CurveEnd, turns, velocities, accelerations)


def apart(a: Quat, b: Quat) -> float:
    return angle(difference(a, b))


def velocity(curve: Curve, u: float) -> Vec3:
    """In the axes of the joint, rad per unit of u, around u."""
    return scale(rotation_vector(difference(curve(u - 0.5 * STEP), curve(u + 0.5 * STEP))), 1.0 / STEP)


def acceleration(curve: Curve, u: float) -> Vec3:
    return scale(subtract(velocity(curve, u + STEP), velocity(curve, u - STEP)), 0.5 / STEP)


@settings(max_examples=100, deadline=None, derandomize=True)
@given(ends, ends)
def test_a_hermite_curve_has_rotations_velocities_and_accelerations_of_both_ends(
    start: CurveEnd, goal: CurveEnd
) -> None:
    """M.-J. Kim, M.-S. Kim and S. Y. Shin (1995); thesis 4.2.4."""
    curve = HermiteCurve(start, goal)
    for end, u, inside in ((start, 0.0, 2 * STEP), (goal, 1.0, 1.0 - 2 * STEP)):
        assert apart(curve(u), end.rotation) < 1e-6
        assert velocity(curve, inside) == pytest.approx(end.velocity, abs=5e-3)
        assert acceleration(curve, inside) == pytest.approx(end.acceleration, abs=0.2)


@pytest.mark.parametrize("fast", [1.0, 8.0])
def test_between_its_ends_the_acceleration_of_a_hermite_curve_does_not_jump(fast: float) -> None:
    """What a joint that is fast brings along is over before the other end, and that is not felt either."""
    start = CurveEnd(IDENTITY, scale((1.0, 0.0, 0.5), fast), (10.0, 0.0, 0.0))
    goal = CurveEnd(from_euler(0.8, 0.4, -0.2), scale((0.0, -1.0, 0.0), fast), (0.0, 5.0, 5.0))
    curve = HermiteCurve(start, goal)
    samples = [acceleration(curve, i / 1000) for i in range(1, 1000)]
    steps = [math.dist(a, b) for a, b in pairwise(samples)]
    assert max(steps) < 0.05 * max(math.dist(a, (0.0, 0.0, 0.0)) for a in samples)


def test_a_fast_joint_does_not_loop() -> None:
    for velocity_, acceleration_ in (((40.0, 0.0, 0.0), (0.0, 0.0, 0.0)), ((0.0, 0.0, 0.0), (900.0, 0.0, 0.0))):
        start = CurveEnd(IDENTITY, velocity_, acceleration_)
        curve = HermiteCurve(start, CurveEnd(IDENTITY))
        assert 0.45 < max(angle(curve(i / 500)) for i in range(501)) < 0.51
        assert velocity(curve, 2 * STEP) == pytest.approx(velocity_, abs=0.1)


def test_a_hermite_curve_between_ends_at_rest_has_minimum_jerk() -> None:
    goal = from_axis_angle(X, 1.0)
    curve, same = (kind(CurveEnd(IDENTITY), CurveEnd(goal)) for kind in (HermiteCurve, slerped))
    assert [apart(curve(i / 20), same(i / 20)) for i in range(21)] == pytest.approx([0.0] * 21, abs=1e-7)


def test_a_slerp_goes_the_shortest_way_from_rest_to_rest() -> None:
    goal = from_axis_angle(X, 1.0)
    curve = slerped(CurveEnd(IDENTITY, (5.0, 5.0, 5.0)), CurveEnd(goal, (5.0, 5.0, 5.0)))
    assert [apart(curve(u), IDENTITY) for u in (0.0, 0.5, 1.0)] == pytest.approx([0.0, 0.5, 1.0], abs=1e-6)
    assert velocity(curve, STEP) == pytest.approx((0.0, 0.0, 0.0), abs=1e-3)


@settings(max_examples=100, deadline=None, derandomize=True)
@given(turns)
def test_a_rotation_is_the_turn_of_its_rotation_vector(turn: Quat) -> None:
    assert apart(from_rotation_vector(rotation_vector(turn)), turn) < 1e-6


def test_joints_stay_until_the_goal_is_known(skeleton: Skeleton) -> None:
    body = Body(skeleton, {"r_elbow": from_axis_angle(X, -0.7)})
    unit = TransitionMotionUnit(frozenset({"r_elbow"}), HermiteCurve)
    unit.start(body)
    assert unit.pose(Moment(0.7, GlobalTime(0.0), Body(skeleton))).rotations == {"r_elbow": body.rotation("r_elbow")}
    assert unit.resources == {Resource.RIGHT_ARM}


def test_a_transition_leads_from_one_motion_to_another(skeleton: Skeleton) -> None:
    begin = KinematicState(
        Body(skeleton, {"r_elbow": from_axis_angle(X, -0.7)}),
        {"r_elbow": (0.5, 0.0, 0.0)},
        {"r_elbow": (2.0, 0.0, 0.0)},
    )
    goal = KinematicState(Body(skeleton, {"r_elbow": from_axis_angle(X, -0.2)}), {"r_elbow": (-0.8, 0.0, 0.0)}, {})
    unit = TransitionMotionUnit(frozenset({"r_elbow"}), CURVES["HermiteTransition"])
    unit.connect(begin, goal, 2.0)

    def elbow(seconds: float) -> float:
        w, x, _, _ = unit.pose(Moment(seconds / 2.0, GlobalTime(0.0), begin.body)).rotations["r_elbow"]
        return 2.0 * math.atan2(x, w)

    assert (elbow(0.0), elbow(2.0)) == pytest.approx((-0.7, -0.2))
    assert (elbow(0.001) - elbow(0.0)) / 0.001 == pytest.approx(0.5, abs=0.01)
    assert (elbow(2.0) - elbow(1.999)) / 0.001 == pytest.approx(-0.8, abs=0.01)
    assert (elbow(0.002) - 2 * elbow(0.001) + elbow(0.0)) / 0.001**2 == pytest.approx(2.0, abs=0.05)
    assert (elbow(2.0) - 2 * elbow(1.999) + elbow(1.998)) / 0.001**2 == pytest.approx(0.0, abs=0.05)


def test_an_arc_to_a_goal_that_moves_grows_beyond_half_a_turn_and_does_not_jump() -> None:
    arcs, before = GrowingArcs(), IDENTITY
    for degrees in range(0, 300, 5):
        here = arcs("r_shoulder", IDENTITY, from_axis_angle(X, math.radians(degrees)), 0.5)
        assert apart(before, here) < math.radians(3.0)
        before = here
    assert apart(before, from_axis_angle(X, math.radians(147.5))) < 1e-6


def test_an_arc_is_the_shorter_one_at_first() -> None:
    there = from_axis_angle(X, math.radians(200.0))
    assert apart(GrowingArcs()("r_shoulder", IDENTITY, there, 0.5), from_axis_angle(X, math.radians(-80.0))) < 1e-6
