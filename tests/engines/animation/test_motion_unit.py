"""Resources and key positions of motions."""

import pytest

from reactive_realizer.engines.animation.motion_unit import (
    GESTURE_POINTS,
    Resource,
    resources_used,
    with_gesture_points,
)


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
def test_a_motion_owns_an_arm_with_any_of_its_joints_and_the_stance_with_any_of_a_leg_or_the_root(
    joints: set[str], owns: set[str]
) -> None:
    assert resources_used(frozenset(joints)) == owns


@pytest.mark.parametrize(
    "authored",
    [{}, {"stroke": 0.4}, {"ready": 0.2, "relax": 0.9}, {"strokeStart": 0.3, "strokeEnd": 0.5, "beat1": 0.7}],
)
def test_missing_points_coincide_with_their_neighbors_and_all_are_in_order(authored: dict[str, float]) -> None:
    keys = with_gesture_points(authored)
    assert [point for point in keys if point in GESTURE_POINTS] == list(GESTURE_POINTS)
    assert list(keys.values()) == sorted(keys.values())
    assert authored.items() <= keys.items()
    assert keys["ready"] == authored.get("ready", 0.0)
    assert keys["strokeEnd"] == authored.get("strokeEnd", keys["relax"])
