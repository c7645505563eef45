"""What of a body a motion owns follows from the joints that it moves."""

import pytest

from reactive_realizer.engines.animation.motion_unit import Resource, owned


@pytest.mark.parametrize(
    ("joints", "owns"),
    [
        ({"l_sternoclavicular"}, {Resource.LEFT_ARM}),
        ({"r_middle3", "r_wrist"}, {Resource.RIGHT_ARM}),
        ({"l_midtarsal"}, {Resource.STANCE}),
        ({"r_hip", "l_elbow"}, {Resource.STANCE, Resource.LEFT_ARM}),
        ({"HumanoidRoot"}, {Resource.STANCE}),
        ({"l_eyeball_joint", "vc4", "vl5"}, set()),
    ],
)
def test_an_arm_is_owned_with_any_of_its_joints_and_the_stance_with_any_of_a_leg_or_the_root(joints, owns):
    assert owned(frozenset(joints)) == owns
