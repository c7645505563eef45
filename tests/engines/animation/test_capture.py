"""Motion captures in BVH: reading and retargeting."""

from collections.abc import Callable
from itertools import permutations
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.quaternion import rotate
from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.engines.animation.keyframe.bvh_reader import read_capture
from reactive_realizer.engines.animation.keyframe.capture import Capture
from reactive_realizer.engines.animation.keyframe.clip_files import load_clip
from reactive_realizer.engines.animation.keyframe.retarget import retargeted
from reactive_realizer.engines.animation.motion_unit import Moment
from reactive_realizer.engines.animation.motions.keyframe import KeyframeMotionUnit
from reactive_realizer.errors import RealizerError

from .capturing import T_POSE, Turns, assert_same_directions, bvh
from .conftest import ASSETS


@pytest.fixture
def capture(tmp_path: Path) -> Callable[[str], Capture]:
    def read(text: str) -> Capture:
        path = tmp_path / "some.bvh"
        path.write_text(text, newline="")
        return read_capture(path)

    return read


def test_a_capture_resting_in_a_t_pose_without_rotations_gives_a_t_pose(
    capture: Callable[[str], Capture], skeleton: Skeleton
) -> None:
    clip = retargeted(capture(bvh({}, {})), skeleton)
    assert_same_directions(clip, 0.0, skeleton, {})
    body = Body(skeleton).posed(clip.rotations_at(0.0))
    # Palms down: in the default pose the left palm faces the thigh, -x.
    assert rotate(body.transform("l_wrist").rotation, (-1.0, 0.0, 0.0)) == pytest.approx((0.0, -1.0, 0.0), abs=0.2)


_FEMALE = Avatar.read(ASSETS / "avatars" / "female.glb").skeleton
angles = st.tuples(*(st.floats(-80.0, 80.0) for _ in range(3)))
limbs = st.dictionaries(st.sampled_from([name for name, parent, _ in T_POSE if parent]), angles)


@settings(max_examples=60, deadline=None, derandomize=True)
@given(limbs)
def test_bones_point_where_the_captured_ones_do(
    tmp_path_factory: pytest.TempPathFactory, frame: dict[str, Vec3]
) -> None:
    path = tmp_path_factory.mktemp("capture") / "some.bvh"
    path.write_text(bvh(frame, frame))
    assert_same_directions(retargeted(read_capture(path), _FEMALE), 0.0, _FEMALE, frame)


@pytest.mark.parametrize("order", ["".join(axes) for axes in permutations("XYZ")])
def test_rotations_are_applied_in_the_order_of_the_channels(
    capture: Callable[[str], Capture], skeleton: Skeleton, order: str
) -> None:
    frame: Turns = {"LeftArm": (50.0, 40.0, 30.0), "RightUpLeg": (-20.0, 60.0, 10.0)}
    clip = retargeted(capture(bvh(frame, frame, order=order)), skeleton)
    assert_same_directions(clip, 0.0, skeleton, frame, order)


@pytest.mark.parametrize(
    "rewritten",
    [
        lambda text: text.replace("\n", "\r\n"),
        lambda text: text.replace("\n", "\r"),
        lambda text: text.replace(" ", "\t"),
        lambda text: "\ufeff" + text,
        lambda text: text.replace("OFFSET", "    OFFSET").replace("\n", " \n"),
    ],
    ids=["Windows", "old Macintosh", "tabs", "a byte order mark", "spaces"],
)
def test_white_space_in_a_file_has_no_effect(
    capture: Callable[[str], Capture], rewritten: Callable[[str], str]
) -> None:
    text = bvh({}, {"LeftArm": (50.0, 40.0, 30.0)})
    plain, other = capture(text), capture(rewritten(text))
    assert (other.joints, other.times, other.turns.tolist()) == (plain.joints, plain.times, plain.turns.tolist())


def test_the_figure_starts_where_it_stands_and_faces(capture: Callable[[str], Capture], skeleton: Skeleton) -> None:
    """The captured figure starts 3 m away, turned to its right, and walks one meter straight ahead."""
    frame: Turns = {"Hips": (0.0, 0.0, -90.0)}
    walk = bvh(frame, frame, places=[(300.0, 98.0, 0.0), (200.0, 98.0, 0.0)])
    clip = retargeted(capture(walk), skeleton)
    leg = -skeleton.offset("l_knee")[1] / 0.44
    assert clip.root_at(0.0) == (0.0, 0.0, 0.0)
    assert clip.root_at(0.01) == pytest.approx((0.0, 0.0, leg), abs=0.02)
    assert_same_directions(clip, 0.0, skeleton, {})


def test_a_captured_figure_facing_another_way_is_turned_first(
    capture: Callable[[str], Capture], skeleton: Skeleton
) -> None:
    aside = tuple((name, above, (z, y, -x)) for name, above, (x, y, z) in T_POSE)  # a quarter to its left
    clip = retargeted(capture(bvh({}, {}, bones=aside)), skeleton)
    assert_same_directions(clip, 0.0, skeleton, {})


def test_a_figure_that_starts_in_a_crouch_has_its_feet_on_the_ground(
    capture: Callable[[str], Capture], skeleton: Skeleton
) -> None:
    crouch: Turns = {f"{side}UpLeg": (0.0, -70.0, 0.0) for side in ("Left", "Right")}
    crouch |= {f"{side}Leg": (0.0, 140.0, 0.0) for side in ("Left", "Right")}
    crouch |= {f"{side}Foot": (0.0, -70.0, 0.0) for side in ("Left", "Right")}
    clip = retargeted(capture(bvh(crouch, crouch, places=[(0.0, 50.0, 0.0)] * 2)), skeleton)
    posed = KeyframeMotionUnit(clip, Body(skeleton)).pose(Moment(0.5, GlobalTime(0.0), Body(skeleton)))
    body = Body(skeleton).posed(posed.rotations, posed.root)
    assert body.transform("l_ankle").position[1] == pytest.approx(
        Body(skeleton).transform("l_ankle").position[1], abs=0.01
    )


def test_a_capture_is_filtered_by_default(tmp_path: Path, skeleton: Skeleton) -> None:
    """Thesis 3.2.2.2."""
    path = tmp_path / "noisy.bvh"
    frames: list[Turns] = [{"LeftArm": (0.0, 0.0, 10.0 + 2.0 * (-1.0) ** i)} for i in range(240)]
    path.write_text(bvh(*frames, step=1 / 120))

    def tremble(cutoff: float | None) -> float:
        clip = load_clip(path, skeleton, cutoff)
        turns = clip.rotations[60:180, clip.joints.index("l_shoulder"), :]
        return float(np.abs(np.diff(turns, axis=0)).max())

    assert tremble(None) < 0.001 < 0.02 < tremble(0.0)


def test_a_changed_file_is_read_again(tmp_path: Path, skeleton: Skeleton) -> None:
    path = tmp_path / "some.bvh"
    path.write_text(bvh({}, {}))
    assert load_clip(path, skeleton, None).duration == pytest.approx(0.01)
    path.write_text(bvh({}, {}, {}))
    assert load_clip(path, skeleton, None).duration == pytest.approx(0.02)


GOOD = bvh({}, {})


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "line 1: there is no MOTION"),
        (GOOD.replace("HIERARCHY", "HIERARCH"), "line 1: found 'HIERARCH' instead of HIERARCHY"),
        (GOOD.replace("OFFSET 0.0 12.0", "OFFSET 0.0 twelve"), r"line \d+: 'twelve' is not a number"),
        (GOOD.replace("OFFSET 0.0 12.0", "OFFSET 0.0 nan"), r"line \d+: 'nan' is not a number"),
        (GOOD.replace("CHANNELS 3", "CHANNELS three", 1), "line 9: 'three' is not a count"),
        (GOOD.replace("CHANNELS 3", "CHANNELS 9" + 9000 * "9", 1), "is not a count"),
        (GOOD.replace("Zrotation", "Wrotation", 1), "line 5: there is no channel 'Wrotation'"),
        (GOOD.replace("JOINT Spine\n", "BONE Spine\n"), "found 'BONE' instead of JOINT, End Site or }"),
        (GOOD.replace("}\nMOTION", "MOTION"), "the HIERARCHY ends unexpectedly"),
        (GOOD.replace("Frames: 2", "Frames: 4"), "numbers are not 4 frames of 60 numbers up to 1e"),
        (GOOD.replace("Frames: 2", "Frames 2"), "'Frames: N' and 'Frame Time: s' must follow MOTION"),
        (GOOD.replace("Frame Time: 0.01", "Frame Time: 0"), "are not 2 frames of 60 numbers up to 1e.09, 0 s apart"),
        (GOOD.rstrip().removesuffix("0.000000") + "oops\n", "could not convert string to float: 'oops'"),
        (GOOD.rstrip().removesuffix("0.000000") + "inf\n", "numbers up to 1e"),
        (GOOD.rstrip().removesuffix("0.000000") + "1e300\n", "numbers up to 1e"),
        (GOOD.replace("OFFSET 0.0 12.0", "OFFSET 0.0 1e300"), r"line \d+: '1e300' is not a number"),
        (GOOD.rstrip().removesuffix("0.000000") + "nan\n", "numbers up to 1e"),
        (bvh(), "the 0 numbers are not 0 frames of 60 numbers"),
        (bvh({}), "not 1 frames of 60 numbers up to 1e.09, 0.01 s apart, or there are fewer than two"),
    ],
)
def test_errors_name_the_line(capture: Callable[[str], Capture], text: str, message: str) -> None:
    with pytest.raises(RealizerError, match=message) as with_reached_root:
        capture(text)
    assert with_reached_root.value.fault.code == "bad-capture"
    assert str(with_reached_root.value).startswith("some.bvh, line ")


def test_a_file_that_counts_one_frame_more_than_it_has_is_read(capture: Callable[[str], Capture]) -> None:
    assert len(capture(bvh({}, {}, {}).replace("Frames: 3", "Frames: 4")).times) == 3


def test_a_capture_with_unknown_joints_is_refused(capture: Callable[[str], Capture], skeleton: Skeleton) -> None:
    strange = {name: f"bone{i}" for i, (name, _, _) in enumerate(T_POSE)}
    with pytest.raises(RealizerError, match="no joint has a known name for HumanoidRoot, l_hip"):
        retargeted(capture(bvh({}, {}, names=strange)), skeleton)


def test_a_capture_that_moves_too_far_is_refused(capture: Callable[[str], Capture], skeleton: Skeleton) -> None:
    text = bvh({}, {}, places=[(0.0, 95.0, 0.0), (0.0, 95.0, 1e7)])
    with pytest.raises(RealizerError, match="the root moves further than 10 m, scaled by the length of the thighs"):
        retargeted(capture(text), skeleton)


def test_a_figure_that_lies_at_rest_and_in_the_first_frame_is_refused(
    capture: Callable[[str], Capture], skeleton: Skeleton
) -> None:
    lying = tuple((name, above, (y, x, z)) for name, above, (x, y, z) in T_POSE)
    with pytest.raises(RealizerError, match="stands upright neither without rotations nor in its first frame"):
        retargeted(capture(bvh({}, {}, bones=lying)), skeleton)


def test_a_file_of_too_many_joints_and_frames_is_refused(capture: Callable[[str], Capture]) -> None:
    idle = "JOINT a\n{\nOFFSET 0 0 0\nCHANNELS 0\nEnd Site\n{\nOFFSET 0 0 0\n}\n}\n" * 900
    text = f"HIERARCHY\nROOT a\n{{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n{idle}}}\nMOTION\nFrames: 5000\nFrame Time: 1\n"
    with pytest.raises(RealizerError, match="5000 frames of 901 joints are more than 1000000 rotations"):
        capture(text + "0 " * 5000)


def test_a_figure_of_too_many_joints_is_refused(capture: Callable[[str], Capture]) -> None:
    joints = "JOINT a\n{\nOFFSET 0 0 0\nCHANNELS 0\n" * 1000 + "}\n" * 1000
    text = f"HIERARCHY\nROOT a\n{{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n{joints}}}\nMOTION\nFrames: 2\nFrame Time: 1\n"
    with pytest.raises(RealizerError, match="1001 joints are more than 1000"):
        capture(text + "0 0")


def test_a_file_of_100_mb_is_refused_before_it_is_read(tmp_path: Path) -> None:
    path = tmp_path / "big.bvh"
    with path.open("wb") as file:
        file.truncate(100_000_000)
    with pytest.raises(RealizerError) as with_reached_root:
        read_capture(path)
    assert with_reached_root.value.fault.code == "asset-too-big"
