"""Lexemes of stances and poses, and how postures combine."""

from pathlib import Path

import pytest

from reactive_realizer.assembly.faults import TwoAssets
from reactive_realizer.bml.vocabulary import PosePart, StanceType
from reactive_realizer.embodiment.body import Skeleton
from reactive_realizer.engines.animation.posture.posture_library import LEXEMES, PART_JOINTS, PostureLibrary
from reactive_realizer.errors import RealizerError

from .bodies import ASSET, apart, body_in, part_of, pose, posture


def test_a_lexeme_may_be_written_in_lower_case_and_with_hyphens(skeleton: Skeleton) -> None:
    assert body_in(skeleton, ARMS="arms-crossed").pose == body_in(skeleton, ARMS="ARMS_CROSSED").pose


def test_a_neutral_part_is_as_in_the_stance_alone(skeleton: Skeleton) -> None:
    arms = body_in(skeleton, "SITTING", ARMS="ARMS_CROSSED", RIGHT_ARM="ARMS_NEUTRAL")
    sitting = body_in(skeleton, "SITTING")
    assert all(apart(arms, sitting, joint) < 1e-9 for joint in PART_JOINTS[PosePart.RIGHT_ARM])
    assert apart(arms, sitting, "l_shoulder") > 0.1


def test_a_lexeme_without_a_file_is_refused_with_the_known_ones(skeleton: Skeleton) -> None:
    with pytest.raises(RealizerError) as refused:
        body_in(skeleton, ARMS="ARMS_WINGED")
    assert refused.value.fault.code == "no-posture"
    assert "ARMS_WINGED" in refused.value.fault.sentence
    assert "ARMS_AKIMBO, ARMS_CROSSED" in refused.value.fault.sentence


def test_a_pose_that_does_not_exist_in_a_stance_is_refused(skeleton: Skeleton) -> None:
    with pytest.raises(RealizerError, match="there is no LEGS pose 'LEGS_CROSSED' for CROUCHING") as refused:
        body_in(skeleton, "CROUCHING", LEGS="LEGS_CROSSED")
    _, _, known = refused.value.fault.sentence.partition("available: ")
    assert "LEGS_OPEN" in known
    assert "LEGS_CROSSED" not in known
    assert "ARMS_CROSSED" not in known


@pytest.mark.parametrize("lexeme", ["/etc/passwd", "", "a/b", "\x00"])
def test_an_invalid_lexeme_has_no_file(skeleton: Skeleton, lexeme: str) -> None:
    with pytest.raises(RealizerError) as refused:
        body_in(skeleton, ARMS=lexeme)
    assert refused.value.fault.code == "no-posture"


def test_no_lexeme_leads_outside_of_the_assets(skeleton: Skeleton) -> None:
    with pytest.raises(RealizerError, match="it must be a relative path inside the asset folders"):
        body_in(skeleton, ARMS="../humans/default")


def test_a_file_for_a_stance_takes_precedence_over_the_general_one(skeleton: Skeleton) -> None:
    def asset(name: str) -> Path:
        if name == "postures/sitting/arms_crossed.xml":
            raise RealizerError(TwoAssets(name=name, known=("this", "that")))
        return ASSET(name)

    library = PostureLibrary(skeleton, asset)
    library.body(posture(ARMS="ARMS_CROSSED"))
    with pytest.raises(RealizerError, match="this, that"):
        library.body(posture("SITTING", ARMS="ARMS_CROSSED"))


def test_a_lexeme_that_does_not_concern_a_part_is_refused_for_it(skeleton: Skeleton) -> None:
    with pytest.raises(RealizerError, match="arms_crossed"):
        body_in(skeleton, LEGS="ARMS_CROSSED")


@pytest.mark.parametrize("lexeme", [lexeme for lexeme in LEXEMES if not lexeme.endswith("NEUTRAL")])
def test_every_lexeme_of_the_package_has_a_file_and_an_effect(skeleton: Skeleton, lexeme: str) -> None:
    body, rest = body_in(skeleton, **{part_of(lexeme): lexeme}), body_in(skeleton)
    assert max(apart(body, rest, joint) for joint in skeleton.joints) > 0.05


def test_crossed_arms_stay_crossed_when_the_figure_sits_down() -> None:
    before = posture(ARMS="ARMS_CROSSED")
    assert before.changed(StanceType.SITTING, ()) == posture("SITTING", ARMS="ARMS_CROSSED")


def test_a_pose_replaces_poses_of_the_same_joints() -> None:
    before = posture(LEFT_ARM="ARMS_OPEN", LEGS="LEGS_OPEN")
    assert before.changed(None, [pose("ARMS", "ARMS_CROSSED")]) == posture(LEGS="LEGS_OPEN", ARMS="ARMS_CROSSED")
    assert before.changed(None, [pose("WHOLEBODY", "LEANING_FORWARD")]) == posture(WHOLEBODY="LEANING_FORWARD")


def test_a_pose_of_one_arm_keeps_the_pose_of_the_other(skeleton: Skeleton) -> None:
    after = posture(ARMS="ARMS_CROSSED").changed(None, [pose("LEFT_ARM", "ARMS_AKIMBO")])
    body, crossed = PostureLibrary(skeleton, ASSET).body(after), body_in(skeleton, ARMS="ARMS_CROSSED")
    assert apart(body, crossed, "r_shoulder") < 1e-9
    assert apart(body, body_in(skeleton, ARMS="ARMS_AKIMBO"), "l_shoulder") < 1e-9
