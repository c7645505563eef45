"""Posture files of a user."""

import math
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from reactive_realizer.assembly.assets import Assets
from reactive_realizer.binding.gesture_binding import RestPose
from reactive_realizer.bml.vocabulary import PosePart, StanceType
from reactive_realizer.embodiment.body import Skeleton
from reactive_realizer.embodiment.quaternion import angle
from reactive_realizer.engines.animation.posture.posture_library import BodyPosture, PostureLibrary
from reactive_realizer.errors import RealizerError

from .bodies import ASSET, apart, body_in, posture
from .capturing import Turns, bvh
from .smartbody_files import sk, skm


@pytest.fixture
def own(tmp_path: Path) -> Path:
    """A folder of assets with postures of a user."""
    (tmp_path / "postures").mkdir()
    return tmp_path


def test_a_file_of_the_user_is_a_new_word(skeleton: Skeleton, own: Path) -> None:
    shutil.copy(ASSET("postures/arms_akimbo.xml"), own / "postures" / "hands_up.xml")
    library = PostureLibrary(skeleton, Assets((own,)))
    assert library.body(posture(ARMS="HANDS_UP")).pose == body_in(skeleton, ARMS="ARMS_AKIMBO").pose


def test_a_stance_of_the_user_replaces_that_of_the_package_and_may_place_the_pelvis(
    skeleton: Skeleton, own: Path
) -> None:
    (own / "postures" / "sitting.xml").write_text(
        '<ProcAnimation prefDuration="1">'
        '<EndEffector target="HumanoidRoot" local="true" translation="0;-0.2;0.1"/>'
        '<Rotation target="l_knee" rotation="1;0;0"/></ProcAnimation>'
    )
    library = PostureLibrary(skeleton, Assets((own,)))
    for body in (library.body(posture("SITTING")), library.body(posture("SITTING", ARMS="ARMS_CROSSED"))):
        assert body.root == pytest.approx((0.0, -0.2, 0.1))
        assert angle(body.rotation("l_knee")) == pytest.approx(1.0)


def test_a_changed_file_is_read_again(skeleton: Skeleton, own: Path) -> None:
    file = own / "postures" / "arms_up.xml"
    text = '<ProcAnimation prefDuration="1"><Rotation target="l_elbow" rotation="{};0;0"/></ProcAnimation>'
    library = PostureLibrary(skeleton, Assets((own,)))
    seen = []
    for bend in (-0.5, -1.5):
        file.write_text(text.format(bend))
        seen.append(angle(library.body(posture(ARMS="ARMS_UP")).rotation("l_elbow")))
    assert seen == pytest.approx([0.5, 1.5])


def test_an_invalid_posture_file_is_refused_with_its_line(skeleton: Skeleton, own: Path) -> None:
    (own / "postures" / "arms_up.xml").write_text('<ProcAnimation prefDuration="1">\n<Rotation target="l_elbow"/>')
    with pytest.raises(RealizerError) as refused:
        PostureLibrary(skeleton, Assets((own,))).body(posture(ARMS="ARMS_UP"))
    assert refused.value.fault.code == "bad-asset"


REST_POSE = """<SkeletonPose rotationEncoding="axisangles" parts="HumanoidRoot r_shoulder l_shoulder" encoding="T1R">
0 1.9 0 1 0 0 0 0 0 1 -0.4 0 0 1 0.4</SkeletonPose>"""


def test_a_binding_may_set_a_rest_pose_and_the_feet_stay_on_the_ground(skeleton: Skeleton, own: Path) -> None:
    (own / "mine.xml").write_text(REST_POSE)
    library = PostureLibrary(skeleton, Assets((own,)), [RestPose(StanceType.STANDING, {}, "mine.xml")])
    body = library.body(BodyPosture())
    assert angle(body.rotation("l_shoulder")) == pytest.approx(0.4)
    assert body.root == pytest.approx((0.0, 0.0, 0.0), abs=1e-9)
    assert apart(body, body_in(skeleton), "l_elbow") < 1e-9


def test_a_rest_pose_with_poses_is_only_for_postures_with_these(skeleton: Skeleton, own: Path) -> None:
    (own / "mine.xml").write_text(REST_POSE)
    spread = RestPose(StanceType.STANDING, {PosePart.ARMS: "ARMS_WIDE"}, "mine.xml")
    library = PostureLibrary(skeleton, Assets((own,)), [spread])
    assert library.body(BodyPosture()).pose == body_in(skeleton).pose
    body = library.body(posture(ARMS="arms-wide", LEGS="LEGS_OPEN"))
    assert angle(body.rotation("l_shoulder")) == pytest.approx(0.4)
    assert body.rotation("l_hip") == body_in(skeleton, LEGS="LEGS_OPEN").rotation("l_hip")
    with pytest.raises(RealizerError, match="ARMS_WIDE"):
        library.check(posture("SITTING", ARMS="ARMS_WIDE"))


def test_a_rest_pose_that_is_missing_is_logged_and_the_default_is_used(
    skeleton: Skeleton, caplog: pytest.LogCaptureFixture
) -> None:
    library = PostureLibrary(skeleton, ASSET, [RestPose(StanceType.SITTING, {}, "nowhere.xml")])
    said = ["the default rest pose of SITTING is used: there is no asset named 'nowhere.xml'"]
    assert [record.getMessage() for record in caplog.records] == said, "before anybody sits"
    assert library.body(posture("SITTING")).pose == body_in(skeleton, "SITTING").pose
    assert len(caplog.records) == 1


def test_a_posture_file_that_moves_the_root_too_far_is_refused(skeleton: Skeleton, own: Path) -> None:
    (own / "postures" / "arms_up.xml").write_text(
        '<ProcAnimation prefDuration="1"><EndEffector target="HumanoidRoot" local="true" translation="0;0;1e300"/>'
        '<Rotation target="l_elbow" rotation="1;0;0"/></ProcAnimation>'
    )
    with pytest.raises(RealizerError, match="HumanoidRoot's place"):
        PostureLibrary(skeleton, Assets((own,))).body(posture(WHOLEBODY="ARMS_UP"))


CROUCH: Turns = {f"{side}UpLeg": (0.0, -60.0, 0.0) for side in ("Left", "Right")} | {
    f"{side}Leg": (0.0, 120.0, 0.0) for side in ("Left", "Right")
}


@pytest.mark.parametrize(("suffix", "written"), [("bvh", bvh), ("skm", skm)])
def test_the_name_of_a_capture_is_the_pose_of_its_first_frame(
    skeleton: Skeleton, own: Path, suffix: str, written: Callable[..., str]
) -> None:
    pose: Turns = {**CROUCH, "LeftArm": (-60.0, 0.0, 0.0), "Head": (0.0, 20.0, 0.0)}
    (own / "clips").mkdir()
    (own / "clips" / "Brad.sk").write_text(sk())
    (own / "clips" / f"Brad@Crouch01.{suffix}").write_text(written(pose, {}))
    library = PostureLibrary(skeleton, Assets((own,)))
    body = library.body(posture(WHOLEBODY="Brad@Crouch01"))
    assert angle(body.rotation("skullbase")) == pytest.approx(math.radians(20.0))
    assert body.transform("l_knee").position[2] > body.transform("l_hip").position[2] + 0.2
    assert body.root[1] < -0.1
    arms = library.body(posture(ARMS="Brad@Crouch01"))
    assert arms.rotation("l_shoulder") == pytest.approx(body.rotation("l_shoulder"))
    assert arms.rotation("skullbase") == library.body(posture()).rotation("skullbase")


def test_a_capture_that_cannot_be_read_is_refused_as_a_pose(skeleton: Skeleton, own: Path) -> None:
    (own / "bad.skm").write_text("SkMotion\nchannels")
    with pytest.raises(RealizerError, match=r"bad\.skm, line 2: the motion ends unexpectedly"):
        PostureLibrary(skeleton, Assets((own,))).body(posture(WHOLEBODY="bad"))
