"""Motions and skeletons in SmartBody's formats, ``.skm`` and ``.sk``: reading and retargeting."""

import logging
import math
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.quaternion import Quat, from_axis_angle, multiply, rotation_vector
from reactive_realizer.embodiment.vector import Vec3, unit
from reactive_realizer.engines.animation.keyframe.clip import Clip
from reactive_realizer.engines.animation.keyframe.clip_files import load_clip, skeleton_beside
from reactive_realizer.errors import RealizerError

from .capturing import T_POSE, Turns, assert_same_directions, captured_directions, directions
from .conftest import ASSETS
from .smartbody_files import NAMES, STANDARD, sk, skm, skmb

SKELETON = Avatar.read(ASSETS / "avatars" / "female.glb").skeleton
AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
POSE: Turns = {"LeftArm": (30.0, 20.0, 10.0), "RightLeg": (0.0, 40.0, 0.0), "Spine": (0.0, 10.0, 0.0)}
ALONG = {
    f"{side}{bone}": from_axis_angle((0.0, 0.6, 0.8), 1.2) for side in ("Left", "Right") for bone in ("Arm", "Leg")
}
"""Axes of some joints that are not those of the figure."""


def load(folder: Path, motion: str, skeleton: str | None = sk()) -> Clip:
    """The clip of a motion, with its skeleton beside it or without one."""
    if skeleton is not None:
        (folder / "Figure.sk").write_text(skeleton)
    path = folder / "Figure@Move01.skm"
    path.write_text(motion)
    return load_clip(path, SKELETON, None)


angles = st.tuples(*(st.floats(-80.0, 80.0) for _ in range(3)))
ways = st.tuples(*(st.floats(0.1, 1.0) for _ in range(3)))
axes = st.builds(lambda way, angle: from_axis_angle(unit(way), angle), ways, st.floats(-3.0, 3.0))
joints = st.sampled_from([name for name, parent, _ in T_POSE if parent])


@settings(max_examples=60, deadline=None, derandomize=True)
@given(st.dictionaries(joints, angles), st.dictionaries(st.sampled_from(list(NAMES)), axes))
def test_bones_point_where_those_of_the_motion_do_whatever_the_axes_of_its_joints(
    tmp_path_factory: pytest.TempPathFactory, frame: dict[str, Vec3], turned: dict[str, Quat]
) -> None:
    folder = tmp_path_factory.mktemp("motion")
    clip = load(folder, skm(frame, frame, axes=turned), sk(turned))
    assert_same_directions(clip, 0.0, SKELETON, frame)


def test_the_root_moves_from_its_offset_by_the_lengths_of_the_thighs(tmp_path: Path) -> None:
    """In meters or centimeters: the lengths of the skeleton and of the motion have the same unit."""
    leg = -SKELETON.offset("l_knee")[1] / 0.44
    for size in (1.0, 0.01):
        clip = load(tmp_path, skm({}, {}, places=[(0.0, 0.0, 0.0), (0.0, 0.0, 100.0 * size)]), sk(size=size))
        assert clip.root_at(0.0) == (0.0, 0.0, 0.0)
        assert clip.root_at(0.1) == pytest.approx((0.0, 0.0, leg), abs=0.02)


def test_a_motion_without_places_leaves_the_root_where_it_is(tmp_path: Path) -> None:
    clip = load(tmp_path, skm({}, POSE))
    assert clip.root_at(0.1) == pytest.approx((0.0, 0.0, 0.0))


def test_only_joints_with_channels_move(tmp_path: Path) -> None:
    pose = {joint: turns for joint, turns in POSE.items() if joint == "LeftArm"}
    clip = load(tmp_path, skm({}, pose, turned=("LeftArm", "LeftForeArm"), axes=ALONG), sk(ALONG))
    assert set(clip.joints) == {"l_shoulder", "l_elbow"}
    assert clip.roots is None
    assert directions(clip, 0.1, SKELETON)["LeftArm", "LeftForeArm"] == pytest.approx(
        captured_directions(pose)["LeftArm", "LeftForeArm"], abs=1e-5
    )


END = """
ready time: 0.1
strokeStart time: 0.15
emphasis time: 0.2
stroke time: 0.25
relax time: 0.3

noise_joints: "l_shoulder stroke"
"""


@pytest.mark.parametrize(
    "end",
    [
        END,
        END.replace("strokeStart", "stroke_start")
        .replace("emphasis", "stroke_emphasis")
        .replace("stroke t", "stroke_end t"),
        "readyTime 0.1\nstrokeStartTime 0.15\nemphasisTime: 0.2\nstrokeTime 0.25\nrelaxTime: 0.3",
    ],
    ids=["deprecated names", "names of BML", "one word"],
)
def test_sync_points_of_a_motion_are_those_of_bml(tmp_path: Path, end: str) -> None:
    """Its emphasis is the stroke of BML, and its stroke the end of that."""
    clip = load(tmp_path, skm({}, POSE, POSE, {}, {}, end=end))
    found = {sync: point.time for sync, point in clip.points.items()}
    assert found == {"ready": 0.1, "strokeStart": 0.15, "stroke": 0.2, "strokeEnd": 0.25, "relax": 0.3}


@pytest.mark.parametrize(
    ("end", "found"),
    [
        ("", [0.0, 0.0, 0.0, 0.4, 0.4]),
        ("stroke time: 0.2", [0.0, 0.0, 0.0, 0.2, 0.4]),
        ("ready time: 0.1\nrelax time: 0.3", [0.1, 0.1, 0.1, 0.3, 0.3]),
        ("strokeStart time: 0.2", [0.0, 0.2, 0.2, 0.4, 0.4]),
    ],
)
def test_sync_points_that_a_motion_lacks_coincide_with_others(tmp_path: Path, end: str, found: list[float]) -> None:
    clip = load(tmp_path, skm({}, POSE, POSE, {}, {}, end=end))
    names = ("ready", "strokeStart", "stroke", "strokeEnd", "relax")
    assert [clip.points[name].time for name in names] == found


def test_sync_points_that_are_not_set_or_not_in_the_motion_are_left_out(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    end = "ready time: -1\nstroke time: 0.12\nrelax time: 7\n"
    with caplog.at_level(logging.WARNING):
        clip = load(tmp_path, skm({}, POSE, end=end))
    assert {sync: point.time for sync, point in clip.points.items() if point.time} == {"strokeEnd": 0.1, "relax": 0.1}
    assert "Figure@Move01.skm, line 32: relax at 7 s is outside of the motion" in caplog.text


def test_frames_may_begin_later_and_be_unevenly_spaced(tmp_path: Path) -> None:
    text = skm({}, POSE, {}).replace("frames", "start_kt 2\nframes").replace("kt 0.200000", "kt 0.700000")
    assert load(tmp_path, text).times == pytest.approx((2.0, 2.1, 2.7))


def test_a_motion_of_one_frame_is_a_pose(tmp_path: Path) -> None:
    clip = load(tmp_path, skm(POSE))
    assert_same_directions(clip, clip.times[0], SKELETON, POSE)
    assert_same_directions(clip, clip.times[-1], SKELETON, POSE)


def test_the_twist_of_a_forearm_belongs_to_the_elbow(tmp_path: Path) -> None:
    wrist = "joint JtWristLf\n"
    twist = "joint JtForearmTwistLf\n{ offset 13 0 0\n"
    before, _, after = sk().partition(wrist)
    hand, _, rest = after.partition("}\n")
    twisted = f"{before}{twist}{wrist}{hand.replace('26.0', '13.0')}}}\n}}\n{rest}"
    text = skm({}, {"LeftHand": (0.0, 60.0, 0.0)}).replace("JtWristLf Quat", "JtForearmTwistLf Quat")
    end = load(tmp_path, text, twisted).rotations_at(0.1)
    assert math.degrees(math.hypot(*rotation_vector(end["l_elbow"]))) == pytest.approx(60.0)
    assert "l_wrist" not in end


# --- finding the skeleton


@pytest.mark.parametrize(
    ("files", "found"),
    [
        (["Brad.sk", "Rachel.sk"], "Brad.sk"),
        (["../skeletons/Brad.sk", "Rachel.sk"], "../skeletons/Brad.sk"),
        (["../skeletons/Rachel.sk", "../Other.sk"], "../skeletons/Rachel.sk"),
        (["../skeletons/Rachel.sk", "../skeletons/Other.sk"], None),
        (["../Brad.sk"], "../Brad.sk"),
        (["Other.sk"], "Other.sk"),
        (["Other.sk", "Rachel.sk"], None),
        (["../Other.sk"], None),
        (["Bra.sk", "Brad.sk", "../Brad.sk"], "Brad.sk"),
    ],
)
def test_a_motion_is_for_the_skeleton_that_its_name_begins_with_or_for_the_only_one(
    tmp_path: Path, files: list[str], found: str | None
) -> None:
    folder = tmp_path / "motions"
    folder.mkdir()
    (tmp_path / "skeletons").mkdir()
    for file in files:
        (folder / file).write_text("")
    expected = None if found is None else (folder / found).resolve()
    assert skeleton_beside(folder / "Brad@Wave01.skm") == expected


def test_without_a_skeleton_the_standard_one_is_assumed_and_said(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    with caplog.at_level(logging.WARNING):
        clip = load(tmp_path, skm(POSE, POSE, names=STANDARD), None)
    assert_same_directions(clip, 0.0, SKELETON, POSE)
    assert "Figure@Move01.skm: no skeleton is beside it; SmartBody's standard skeleton is assumed" in caplog.text


@pytest.mark.parametrize(("header", "way"), [("", 80.0), ("# Units: m\n", 0.8)])
def test_lengths_for_the_standard_skeleton_are_in_centimeters_unless_the_file_says_otherwise(
    tmp_path: Path, header: str, way: float
) -> None:
    clip = load(tmp_path, header + skm({}, {}, names=STANDARD, places=[(0.0, 0.0, 0.0), (0.0, 0.0, way)]), None)
    ahead = clip.root_at(0.1)
    assert ahead is not None
    assert 0.6 < ahead[2] < 0.9


def test_a_changed_skeleton_is_read_again(tmp_path: Path) -> None:
    motion = skm({}, {}, places=[(0.0, 0.0, 0.0), (0.0, 0.0, 50.0)])
    small = load(tmp_path, motion).root_at(0.1)
    large = load(tmp_path, motion, sk(size=2.0)).root_at(0.1)
    assert small is not None
    assert large is not None
    assert small[2] == pytest.approx(2.0 * large[2])


def test_angles_turn_a_joint_about_y_then_x_then_z(tmp_path: Path) -> None:
    """As SmartBody's usual Euler joints do, in the axes of the joint as it is turned."""
    head = "SkMotion channels 3\nJtShoulderLf XRot\nJtShoulderLf YRot\nJtShoulderLf ZRot\nframes 2\n"
    row = "fr 20 30 40\n"
    angled = load(tmp_path, f"{head}kt 0 {row}kt 0.1 {row}", sk(ALONG)).rotations_at(0.0)
    x, y, z = (from_axis_angle(axis, math.radians(angle)) for axis, angle in zip(AXES, (20, 30, 40), strict=True))
    quat = " ".join(f"{value:.9f}" for value in rotation_vector(multiply(multiply(z, x), y)))
    head = "SkMotion channels 1\nJtShoulderLf Quat\nframes 2\n"
    turned = load(tmp_path, f"{head}kt 0 fr {quat}\nkt 0.1 fr {quat}\n", sk(ALONG)).rotations_at(0.0)
    assert angled.keys() == turned.keys()
    for joint, rotation in turned.items():
        assert angled[joint] == pytest.approx(rotation, abs=1e-6)


# --- the binary format


def load_binary(folder: Path, message: bytes) -> Clip:
    """The clip of a motion in the binary format."""
    (folder / "Figure.sk").write_text(sk())
    path = folder / "Figure@Move01.skmb"
    path.write_bytes(message)
    return load_clip(path, SKELETON, None)


@pytest.mark.parametrize("packed", [False, True])
def test_a_motion_in_the_binary_format_is_that_of_its_text(tmp_path: Path, packed: bool) -> None:
    text = skm(POSE, {}, POSE, places=[(0.0, 0.0, 0.0), (0.0, 0.0, 10.0), (5.0, 0.0, 20.0)])
    text = text.replace("JtSpineA Quat", "JtSpineA XRot\nJtSpineA YRot\nJtSpineA ZRot")
    text = text.replace("channels 22", "channels 24")
    points = (0.0, 0.05, 0.1, 0.12, -1.0, 0.15, 0.2)
    written = load(tmp_path, f"{text}ready time: 0.05\nstrokeStart time: 0.1\nemphasis time: 0.12\nrelax time: 0.15")
    clip = load_binary(tmp_path, skmb(text, points, packed=packed))
    assert clip.joints == written.joints
    assert clip.times == pytest.approx(written.times)
    assert clip.rotations == pytest.approx(written.rotations, abs=1e-5)
    assert clip.roots == pytest.approx(written.roots, abs=1e-5)
    assert {sync: point.time for sync, point in clip.points.items()} == pytest.approx(
        {sync: point.time for sync, point in written.points.items()}
    )


BINARY = skmb(skm({}, POSE))


@pytest.mark.parametrize(
    ("message", "reason"),
    [
        (b"", "0 names of joints are for 0 channels"),
        (BINARY[:-300], "it ends unexpectedly"),
        (b"\x0b" + BINARY, "a field of the type 3"),
        (b"\xff" * 20, "a number is too long"),
        (skmb(skm({}, POSE).replace("Quat", "Twist", 1)), "a channel Twist, which SmartBody does not play either"),
        (skmb(skm({}, POSE, step=0.0)), "the times of the frames do not increase"),
        (skmb(skm({}, POSE).replace("kt 0.100000", "kt inf")), "values that are no numbers up to"),
        (b"\x22\x01\x63" + BINARY, "there is no kind of channels 99"),
        (b"\x35" + bytes(4) + BINARY, "values are not those of 3 frames"),
    ],
    ids=["empty", "cut", "group", "varint", "twist", "times", "infinite", "kind", "frames"],
)
def test_errors_of_a_binary_motion_say_what_is_wrong(tmp_path: Path, message: bytes, reason: str) -> None:
    with pytest.raises(RealizerError, match=reason) as raised:
        load_binary(tmp_path, message)
    assert str(raised.value).startswith("Figure@Move01.skmb: ")


# --- bad files

MOTION = skm({}, POSE)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "line 1: the motion ends unexpectedly"),
        (MOTION.replace("SkMotion", "Motion"), "line 2: the file should begin with SkMotion"),
        (MOTION.replace("channels", "channel"), "line 6: found 'channel' instead of channels"),
        (MOTION.replace("channels 19", "channels many"), "line 6: 'many' is not a count"),
        ("SkMotion channels 0 frames 1 kt 0 fr", "line 1: there are no channels"),
        (
            MOTION.replace("JtSpineA Quat", "JtSpineA XTurn"),
            "line 9: the channel before is none of XPos, YPos, ZPos, XRot, YRot, ZRot and",
        ),
        (MOTION.replace("JtSpineA Quat", "JtSpineA Swing"), "line 8: it has a channel Swing, which SmartBody does not"),
        (MOTION.replace("frames 2", "frame 2"), "line 27: found 'frame' instead of frames"),
        (MOTION.replace("frames 2", "frames 3"), "line 29: the motion ends unexpectedly"),
        (MOTION.replace("frames 2", "frames 0"), "line 27: there are no frames"),
        (MOTION.replace("kt 0.100000", "kt 0.0"), "line 29: the times of the frames do not increase: 0, 0"),
        (MOTION.replace("fr 0.0", "fr zero", 1), "line 28: 'zero00000000' is not a number"),
        (MOTION.replace("fr 0.0", "fr 1e300 0.0", 1), "line 28: '1e300' is not a number up to 1e.09"),
        (MOTION.replace("fr 0.0", "fr nan 0.0", 1), "line 28: 'nan' is not a number"),
        (MOTION.replace("fr 0.000000000", "fr", 1), "line 29: 'kt' is not a number"),
        (MOTION + "ready time: soon", "line 30: 'soon' is not a number up to"),
    ],
)
def test_errors_of_a_motion_name_the_line(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(RealizerError, match=message) as raised:
        load(tmp_path, text)
    assert raised.value.fault.code == "bad-capture"
    assert str(raised.value).startswith("Figure@Move01.skm, line ")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("# nothing", "line 1: there is no 'skeleton', 'root' and the name of a joint"),
        (sk().replace("root JtRoot", "joint JtRoot"), "line 4: found 'joint' instead of root"),
        (sk().replace("offset 0.0", "offset zero", 1), "line 5: 'zero00000' is not a number up to"),
        (sk().replace("ang", "angle", 1), "line 6: found 'angle' instead of ang"),
        (sk().replace("visgeo", "align pre 1 0 0", 1), "line 7: 'align' is not supported"),
        (sk()[:400], r"line \d+: the skeleton ends unexpectedly"),
    ],
)
def test_errors_of_a_skeleton_name_its_line(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(RealizerError, match=message) as raised:
        load(tmp_path, MOTION, text)
    assert raised.value.fault.code == "bad-capture"
    assert str(raised.value).startswith("Figure.sk, line ")


WORDS = ("", "0", "-1", "1e9", "1e-300", "nan", "}", "{", "kt", "joint", "Quat")


@settings(max_examples=200, deadline=None, derandomize=True)
@given(st.data())
def test_a_file_with_any_other_words_is_read_or_refused(
    tmp_path_factory: pytest.TempPathFactory, data: st.DataObject
) -> None:
    texts = [skm({}, POSE, places=[(0.0, 0.0, 0.0), (0.0, 0.0, 9.0)], end=END), sk()]
    for number, text in enumerate(texts):
        words = text.split(" ")
        for at in data.draw(st.lists(st.integers(0, len(words) - 1), max_size=3)):
            words[at] = data.draw(st.sampled_from(WORDS))
        texts[number] = " ".join(words)
    with suppress(RealizerError):
        clip = load(tmp_path_factory.mktemp("motion"), *texts)
        assert np.isfinite(clip.rotations).all()
        assert clip.roots is None or np.isfinite(clip.roots).all()


def test_a_motion_of_a_face_is_refused(tmp_path: Path) -> None:
    with pytest.raises(RealizerError, match="it moves no joint that the figure has, such as one of a face"):
        load(tmp_path, skm({}, turned=("Head",), names={"Head": "JtCheek"}), sk().replace("JtNeckA", "JtCheek"))
    with pytest.raises(RealizerError, match="it moves no joint that the figure has"):
        load(tmp_path, skm({}, turned=("Head",), names={"Head": "JtEyeLf"}), sk().replace("JtNeckA", "JtEyeLf"))


def test_a_motion_for_another_skeleton_is_refused(tmp_path: Path) -> None:
    with pytest.raises(RealizerError, match=r"such as JtRoot, are not those of SmartBody's standard skeleton"):
        load(tmp_path, MOTION, None)
    with pytest.raises(RealizerError, match=r"such as base, are not those of Figure\.sk"):
        load(tmp_path, skm({}, names=STANDARD))
