from collections import Counter

import pytest

from reactive_realizer.embodiment.joints import (
    EYES,
    HEAD,
    JAW,
    LEFT_ARM,
    LEFT_LEG,
    RIGHT_ARM,
    RIGHT_LEG,
    TRUNK,
    other_side,
)
from reactive_realizer.embodiment.mixamo import JOINTS

PARTS = (TRUNK, HEAD, (JAW,), EYES, LEFT_ARM, RIGHT_ARM, LEFT_LEG, RIGHT_LEG)


def test_each_joint_of_an_avatar_belongs_to_one_part_of_the_body() -> None:
    assert Counter(joint for part in PARTS for joint in part) == Counter(JOINTS.values())


@pytest.mark.parametrize(
    ("name", "other"), [("l_wrist", "r_wrist"), ("r_eyeball_joint", "l_eyeball_joint"), ("vl5", "vl5"), ("l", "r")]
)
def test_other_side_exchanges_left_and_right(name: str, other: str) -> None:
    assert other_side(name) == other
    assert other_side(other) == name


def test_arms_and_legs_of_both_sides_have_the_same_joints() -> None:
    assert set(map(other_side, LEFT_ARM)) == RIGHT_ARM
    assert set(map(other_side, LEFT_LEG)) == RIGHT_LEG
