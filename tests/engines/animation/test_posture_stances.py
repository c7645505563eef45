"""Bodies in stances and poses."""

import math

import pytest

from reactive_realizer.bml.vocabulary import PosePart, StanceType
from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.quaternion import angle, rotate
from reactive_realizer.embodiment.vector import UP, distance, subtract, unit
from reactive_realizer.engines.animation.posture.posture_library import LEXEMES, PART_JOINTS

from .bodies import SOLES, apart, body_in, height, part_of

POSSIBLE = [(stance.value, lexeme) for stance in StanceType for lexeme in LEXEMES]
POSSIBLE.remove(("CROUCHING", "LEGS_CROSSED"))


def slope(body: Body, start: str, end: str) -> float:
    """How far the way from one joint to another is from level, degrees."""
    return math.degrees(math.asin(unit(subtract(body.transform(end).position, body.transform(start).position))[1]))


def test_a_standing_figure_has_its_pelvis_as_in_the_default_pose(skeleton: Skeleton) -> None:
    assert body_in(skeleton).root == pytest.approx((0.0, 0.0, 0.0), abs=1e-9)


def test_a_sitting_figure_has_level_thighs_upright_shanks_and_an_upright_trunk(skeleton: Skeleton) -> None:
    body = body_in(skeleton, "SITTING")
    for side in "lr":
        assert abs(slope(body, f"{side}_hip", f"{side}_knee")) < 6.0
        assert slope(body, f"{side}_knee", f"{side}_ankle") < -80.0
    assert slope(body, "HumanoidRoot", "vc4") > 80.0


def test_a_sitting_figure_has_its_hands_on_the_thighs(skeleton: Skeleton) -> None:
    body = body_in(skeleton, "SITTING")
    for side in "lr":
        wrist, hip, knee = (body.transform(f"{side}_{joint}").position for joint in ("wrist", "hip", "knee"))
        assert hip[2] < wrist[2] < knee[2]
        assert 0.03 < wrist[1] - hip[1] < 0.2
        assert abs(wrist[0] - hip[0]) < 0.08


@pytest.mark.parametrize("stance", ["STANDING", "SITTING", "CROUCHING"])
def test_a_figure_on_its_feet_has_both_soles_flat_on_the_ground_under_the_same_place(
    skeleton: Skeleton, stance: str
) -> None:
    body, default = body_in(skeleton, stance), Body(skeleton)
    for joint in SOLES:
        assert height(body, joint) == pytest.approx(height(default, joint), abs=0.02)
    for side in "lr":
        assert rotate(body.transform(f"{side}_ankle").rotation, UP)[1] > math.cos(math.radians(8.0))
    middle = [sum(each) / 2 for each in zip(*(body.transform(s).position for s in SOLES[:2]), strict=True)]
    assert middle[0] == pytest.approx(0.0, abs=0.02)
    assert middle[2] == pytest.approx(default.transform("l_ankle").position[2], abs=0.01)


def test_a_crouching_figure_is_lower_than_a_sitting_one_and_bends_its_knees(skeleton: Skeleton) -> None:
    crouching, sitting = body_in(skeleton, "CROUCHING"), body_in(skeleton, "SITTING")
    assert height(crouching, "skullbase") < height(sitting, "skullbase")
    assert angle(crouching.rotation("l_knee")) > math.radians(100.0)


def test_a_lying_figure_lies_on_its_back(skeleton: Skeleton) -> None:
    body = body_in(skeleton, "LYING")
    assert max(height(body, joint) for joint in ("HumanoidRoot", "vt6", "skullbase", "l_wrist", "r_wrist")) < 0.3
    assert rotate(body.transform("skullbase").rotation, (0.0, 0.0, 1.0))[1] > 0.9


@pytest.mark.parametrize(("stance", "lexeme"), POSSIBLE)
def test_no_stance_or_pose_goes_below_the_ground(skeleton: Skeleton, stance: str, lexeme: str) -> None:
    body = body_in(skeleton, stance, **{part_of(lexeme): lexeme})
    lowest = min(skeleton.joints, key=lambda joint: height(body, joint))
    # Of the default pose the toes are lowest.
    assert height(body, lowest) > min(height(Body(skeleton), joint) for joint in SOLES) - 0.015, lowest


def test_crossed_arms_have_each_hand_at_the_other_arm_in_front_of_the_chest(skeleton: Skeleton) -> None:
    body = body_in(skeleton, ARMS="ARMS_CROSSED")
    for side, other in ("lr", "rl"):
        wrist, elbow, shoulder = (
            body.transform(joint).position for joint in (f"{side}_wrist", f"{other}_elbow", f"{side}_shoulder")
        )
        assert wrist[0] * shoulder[0] < 0.0
        assert wrist[2] > body.transform("vt6").position[2] + 0.08
        assert distance(body.transform(f"{side}_middle1").position, elbow) < 0.18
    assert height(body, "r_wrist") > height(body, "l_wrist")


def test_arms_akimbo_have_the_hands_at_the_hips_and_the_elbows_outside(skeleton: Skeleton) -> None:
    body = body_in(skeleton, ARMS="ARMS_AKIMBO")
    for side in "lr":
        wrist, elbow, hip = (body.transform(f"{side}_{joint}").position for joint in ("wrist", "elbow", "hip"))
        assert distance(wrist, hip) < 0.19
        assert abs(elbow[0]) > abs(wrist[0]) + 0.1


def test_hands_stay_at_the_hips_while_the_trunk_leans(skeleton: Skeleton) -> None:
    upright = body_in(skeleton, ARMS="ARMS_AKIMBO")
    leaning = body_in(skeleton, ARMS="ARMS_AKIMBO", WHOLEBODY="LEANING_FORWARD")
    for wrist in ("l_wrist", "r_wrist"):
        assert distance(upright.transform(wrist).position, leaning.transform(wrist).position) < 0.02
    assert distance(upright.transform("vc4").position, leaning.transform("vc4").position) > 0.05


@pytest.mark.parametrize(("lexeme", "way"), [("LEANING_FORWARD", 1.0), ("LEANING_BACKWARD", -1.0)])
def test_a_leaning_figure_looks_straight_ahead(skeleton: Skeleton, lexeme: str, way: float) -> None:
    body = body_in(skeleton, WHOLEBODY=lexeme)
    assert way * (body.transform("skullbase").position[2] - body_in(skeleton).transform("skullbase").position[2]) > 0.03
    assert rotate(body.transform("skullbase").rotation, UP)[1] > math.cos(math.radians(6.0))


def test_open_legs_are_apart_with_flat_soles_and_a_lower_pelvis(skeleton: Skeleton) -> None:
    body, standing = body_in(skeleton, LEGS="LEGS_OPEN"), body_in(skeleton)
    left, right = (body.transform(ankle).position for ankle in SOLES[:2])
    assert left[0] - right[0] > 1.4 * (2 * standing.transform("l_ankle").position[0])
    assert body.root[1] < -0.01
    assert rotate(body.transform("l_ankle").rotation, UP)[1] > 0.999


@pytest.mark.parametrize("stance", ["STANDING", "SITTING"])
def test_crossed_legs_have_one_foot_in_front_of_the_other_on_its_other_side(skeleton: Skeleton, stance: str) -> None:
    body = body_in(skeleton, stance, LEGS="LEGS_CROSSED")
    left, right = (body.transform(ankle).position for ankle in SOLES[:2])
    assert right[0] > left[0] - 0.05
    assert right[2] > left[2]


def test_a_pose_of_one_arm_leaves_the_other_alone(skeleton: Skeleton) -> None:
    body, both, rest = (
        body_in(skeleton, LEFT_ARM="ARMS_CROSSED"),
        body_in(skeleton, ARMS="ARMS_CROSSED"),
        body_in(skeleton),
    )
    assert all(apart(body, rest, joint) < 1e-9 for joint in PART_JOINTS[PosePart.RIGHT_ARM])
    assert all(apart(body, both, joint) < 1e-9 for joint in PART_JOINTS[PosePart.LEFT_ARM])
