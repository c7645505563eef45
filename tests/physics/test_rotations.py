"""Parts of rotations."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive_realizer.embodiment.quaternion import angle, difference, from_rotation_vector, multiply
from reactive_realizer.physics.rotations import long_way, swing_and_twist, turned_about_y

ANGLE = st.floats(-3.0, 3.0)
SMALL = st.floats(-1.5, 1.5)


@given(x=SMALL, z=SMALL, twist=ANGLE)
def test_a_rotation_is_a_swing_after_a_twist(x: float, z: float, twist: float) -> None:
    rotation = multiply(from_rotation_vector((x, 0.0, z)), from_rotation_vector((0.0, twist, 0.0)))
    assert swing_and_twist(rotation) == pytest.approx((x, twist, z), abs=1e-6)


@given(x=st.floats(0.1, 1.5), z=SMALL, twist=ANGLE)
def test_a_swing_the_long_way_round_gives_the_same_rotation(x: float, z: float, twist: float) -> None:
    far_x, same, far_z = long_way((x, twist, z))
    assert math.hypot(far_x, far_z) == pytest.approx(2.0 * math.pi - math.hypot(x, z))
    assert same == twist
    assert angle(difference(*(from_rotation_vector((a, 0.0, b)) for a, b in ((x, z), (far_x, far_z))))) < 1e-6


def test_an_elbow_that_is_bent_and_turned_has_no_swing_about_z() -> None:
    rotation = multiply(from_rotation_vector((-1.5, 0.0, 0.0)), from_rotation_vector((0.0, 1.2, 0.0)))
    assert swing_and_twist(rotation) == pytest.approx((-1.5, 1.2, 0.0))


@given(turn=ANGLE, x=SMALL, z=SMALL)
def test_vectors_turn_about_y_as_by_a_quaternion(turn: float, x: float, z: float) -> None:
    about = from_rotation_vector((0.0, turn, 0.0))
    back = multiply(multiply(about, from_rotation_vector((x, 0.3, z))), from_rotation_vector((0.0, -turn, 0.0)))
    assert angle(difference(from_rotation_vector(turned_about_y((x, 0.3, z), turn)), back)) < 1e-6
