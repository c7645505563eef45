"""Laws of quaternions, and conventions of files."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive_realizer.embodiment import quaternion as q
from reactive_realizer.embodiment.quaternion import Quat
from reactive_realizer.embodiment.vector import FORWARD, UP, Vec3, cross, dot, length, rejected, unit

number = st.floats(-1.0, 1.0)
angle = st.floats(-3.0, 3.0)
direction = st.tuples(number, number, number).filter(lambda v: length(v) > 0.1).map(unit)
rotation = st.builds(q.from_axis_angle, direction, angle)
fraction = st.floats(0.0, 1.0)


def same(a: q.Quat, b: q.Quat) -> bool:
    return abs(abs(sum(x * y for x, y in zip(a, b, strict=True))) - 1.0) < 1e-9


def near(a: Vec3, b: Vec3) -> bool:
    return a == pytest.approx(b, abs=1e-9)


@given(rotation, rotation, direction)
def test_a_product_turns_by_its_right_factor_first(a: Quat, b: Quat, v: Vec3) -> None:
    assert near(q.rotate(q.multiply(a, b), v), q.rotate(a, q.rotate(b, v)))


@given(rotation, direction)
def test_the_conjugate_turns_back(a: Quat, v: Vec3) -> None:
    assert near(q.rotate(q.conjugate(a), q.rotate(a, v)), v)


@given(rotation, rotation)
def test_a_rotation_followed_by_its_difference_to_another_is_the_other(a: Quat, b: Quat) -> None:
    assert same(q.multiply(a, q.difference(a, b)), b)


def test_a_turn_about_y_by_the_right_hand_takes_forward_to_the_figures_left() -> None:
    assert near(q.rotate(q.from_axis_angle(UP, math.pi / 2), FORWARD), (1.0, 0.0, 0.0))


@given(angle, angle, angle)
def test_euler_angles_turn_about_z_then_x_then_y(x: float, y: float, z: float) -> None:
    about = [q.from_axis_angle(axis, a) for axis, a in (((0, 1, 0), y), ((1, 0, 0), x), ((0, 0, 1), z))]
    assert same(q.from_euler(x, y, z), q.multiply(about[0], q.multiply(about[1], about[2])))


@given(rotation, rotation, fraction)
def test_slerp_covers_a_fraction_of_the_shorter_way(a: Quat, b: Quat, t: float) -> None:
    way = q.angle(q.difference(a, b))
    gone = q.angle(q.difference(a, q.slerp(a, b, t)))
    assert gone == pytest.approx(t * way, abs=1e-6)


@given(rotation, rotation)
def test_slerp_takes_opposite_quaternions_for_the_same_rotation(a: Quat, b: Quat) -> None:
    opposite = (-b[0], -b[1], -b[2], -b[3])
    assert same(q.slerp(a, b, 0.3), q.slerp(a, opposite, 0.3)) or q.angle(q.difference(a, b)) > 3.1


@given(direction, direction)
def test_between_is_the_smallest_turn_from_one_direction_to_another(a: Vec3, b: Vec3) -> None:
    turn = q.between(a, b)
    nearly_opposite = dot(a, b) < -1.0 + 1e-9  # half a turn then, about any perpendicular axis
    assert q.rotate(turn, a) == pytest.approx(b, abs=5e-5 if nearly_opposite else 1e-9)
    assert q.angle(turn) == pytest.approx(
        math.acos(max(-1.0, min(1.0, dot(a, b)))), abs=5e-5 if nearly_opposite else 1e-6
    )


@pytest.mark.parametrize("v", [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, -1.0), unit((1.0, 2.0, 3.0))])
def test_between_opposite_directions_is_half_a_turn(v: Vec3) -> None:
    assert near(q.rotate(q.between(v, (-v[0], -v[1], -v[2])), v), (-v[0], -v[1], -v[2]))


@given(rotation, direction, direction.filter(lambda v: abs(v[1]) < 0.9))
def test_from_frames_finds_the_rotation_that_moved_a_frame(a: Quat, v: Vec3, helper: Vec3) -> None:
    side = unit(rejected(helper if abs(dot(helper, v)) < 0.9 else cross(v, UP), v))
    assert same(q.from_frames(v, side, q.rotate(a, v), q.rotate(a, side)), a)


@given(rotation, direction)
def test_the_swing_does_not_turn_about_the_axis(a: Quat, axis: Vec3) -> None:
    twist = q.twist(a, axis)
    swing = q.multiply(a, q.conjugate(twist))
    assert abs(swing[1] * axis[0] + swing[2] * axis[1] + swing[3] * axis[2]) < 1e-9
    assert same(q.multiply(swing, twist), a)
