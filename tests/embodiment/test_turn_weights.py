"""Weights that turn joints, beside those of morph targets."""

import pytest

from reactive_realizer.embodiment.quaternion import rotation_vector
from reactive_realizer.embodiment.turn_weights import turn_weights, turned_joint, turns, weights_of_joint


def test_a_rotation_becomes_weights_and_a_rotation_again() -> None:
    weights = turn_weights("skullbase", (0.2, -0.5, 0.0))
    assert weights == {"skullbase+x": 0.2, "skullbase-y": 0.5}
    assert weights.keys() <= set(weights_of_joint("skullbase"))
    assert rotation_vector(turns(weights, {"skullbase"})["skullbase"]) == pytest.approx((0.2, -0.5, 0.0))


def test_weights_to_opposite_sides_cancel_out() -> None:
    assert turns({"skullbase+x": 0.3, "skullbase-x": 0.3}, {"skullbase"})["skullbase"] == pytest.approx((1, 0, 0, 0))


def test_morph_targets_and_joints_that_do_not_turn_are_left_out() -> None:
    assert turns({"jawOpen": 1.0, "": 1.0, "mouth-x": 1.0, "l_eyeball_joint+y": 1.0}, {"skullbase"}) == {}
    assert [turned_joint(name) for name in ("jawOpen", "x", "vc4-z")] == [None, None, "vc4"]
