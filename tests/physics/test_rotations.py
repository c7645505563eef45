"""Rotations as arrays."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive_realizer.embodiment.quaternion import angle, difference, from_rotation_vector, multiply
from reactive_realizer.physics.rotations import swing_and_twist, turned_about_y

ANGLE = st.floats(-3.0, 3.0)
SMALL = st.floats(-1.5, 1.5)


@given(x=SMALL, z=SMALL, twist=ANGLE)
def test_a_rotation_is_a_swing_after_a_twist(x: float, z: float, twist: float) -> None:
    rotation = multiply(from_rotation_vector((x, 0.0, z)), from_rotation_vector((0.0, twist, 0.0)))
    (swing,), (turn,) = swing_and_twist(np.array([rotation]))
    assert swing == pytest.approx((x, 0.0, z), abs=1e-6)
    assert turn == pytest.approx((0.0, twist, 0.0), abs=1e-6)


def test_an_elbow_that_is_bent_and_turned_has_no_swing_about_z() -> None:
    rotation = multiply(from_rotation_vector((-1.5, 0.0, 0.0)), from_rotation_vector((0.0, 1.2, 0.0)))
    (swing,), _ = swing_and_twist(np.array([rotation]))
    assert swing[2] == pytest.approx(0.0)


@given(turn=ANGLE, x=SMALL, z=SMALL)
def test_vectors_turn_about_y_as_by_a_quaternion(turn: float, x: float, z: float) -> None:
    (turned,) = turned_about_y(np.array([(x, 0.3, z)]), np.array([turn]))
    about = from_rotation_vector((0.0, turn, 0.0))
    back = multiply(multiply(about, from_rotation_vector((x, 0.3, z))), from_rotation_vector((0.0, -turn, 0.0)))
    assert angle(difference(from_rotation_vector(tuple(turned)), back)) < 1e-6
