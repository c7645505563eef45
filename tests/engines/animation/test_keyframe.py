"""Keyframe animations: files and playback."""

import math
from pathlib import Path

import numpy as np
import pytest

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, angle, from_axis_angle, multiply
from reactive_realizer.engines.animation.keyframe.clip import Clip, KeyPoint
from reactive_realizer.engines.animation.keyframe.keyframe_files import (
    read_interpolator_file,
    read_interpolator_text,
    read_skeleton_pose,
)
from reactive_realizer.engines.animation.motion_unit import Moment, Resource
from reactive_realizer.engines.animation.motions.keyframe import KeyframeMotionUnit
from reactive_realizer.errors import RealizerError

X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def clip(rows: str, attributes: str = 'parts="skullbase" encoding="R" rotationEncoding="axisangles"') -> Clip:
    return read_interpolator_text(f"<SkeletonInterpolator {attributes}>{rows}</SkeletonInterpolator>", "shake")


def arm_clip() -> Clip:
    """The right arm up and down in two seconds, then at rest for one."""
    return clip(
        "1 1 0 0 0  2 1 0 0 -1.2  3 1 0 0 0  4 1 0 0 0",
        'parts="r_shoulder" encoding="R" rotationEncoding="axisangles"',
    )


def about_y(rotation: Quat) -> float:
    return 2.0 * math.atan2(rotation[2], rotation[0])


def test_between_keys_a_joint_turns_evenly_along_the_shortest_arc() -> None:
    turning = clip("0 0 1 0 0   1 0 1 0 1   3 0 1 0 0.5")
    turns = [about_y(turning.rotations_at(time)["skullbase"]) for time in (0.0, 0.25, 1.0, 2.0, 3.0)]
    assert turns == pytest.approx([0.0, 0.25, 1.0, 0.75, 0.5])
    assert turning.rotations_at(-1.0) == turning.rotations_at(0.0)
    assert about_y(turning.rotations_at(9.0)["skullbase"]) == pytest.approx(0.5)


def test_a_file_may_use_either_sign_of_a_quaternion() -> None:
    turning = clip("0 1 0 0 0  1 -0.9689124 0 -0.247404 0", 'parts="skullbase" encoding="R"')
    assert about_y(turning.rotations_at(0.5)["skullbase"]) == pytest.approx(0.25, abs=1e-6)


@pytest.mark.parametrize(
    ("encoding", "numbers"),
    [("quaternions", "2 0 2 0"), ("Quat", "1 0 1 0"), ("XYZW", "0 1 0 1"), ("axisangles", "0 3 0 1.5707963")],
)
def test_rotations_have_several_encodings(encoding: str, numbers: str) -> None:
    turning = clip(f"0 {numbers}  1 {numbers}", f'parts="vl5" encoding="R" rotationEncoding="{encoding}"')
    assert turning.rotations_at(0.0)["vl5"] == pytest.approx(from_axis_angle(Y, math.pi / 2), abs=1e-6)


def test_an_axis_without_a_length_is_valid_for_angle_0() -> None:
    assert clip("0 0 0 0 0  1 0 1 0 1").rotations_at(0.0)["skullbase"] == IDENTITY


def test_the_root_is_displaced_relative_to_the_first_row() -> None:
    walking = clip(
        "0 5 0.95 7 1 0 0 0  2 5 0.85 9 1 0 0 0", 'parts="HumanoidRoot" encoding="T1R" rotationEncoding="quaternions"'
    )
    assert walking.root_at(0.0) == (0.0, 0.0, 0.0)
    assert walking.root_at(1.0) == pytest.approx((0.0, -0.05, 1.0))


def test_mirroring_exchanges_left_and_right() -> None:
    turning = clip(
        "0 0 0 1 0.4  1 0 0 1 0.4", 'parts="l_shoulder" encoding="R" rotationEncoding="axisangles"'
    ).mirrored()
    assert turning.rotations_at(0.0) == {"r_shoulder": pytest.approx(from_axis_angle(Z, -0.4))}


def test_a_selection_moves_the_root_only_if_it_is_included() -> None:
    whole = clip(
        "0 0 0.9 0 1 0 0 0 1 0 0 0  1 0 0.9 1 1 0 0 0 1 0 0 0",
        'parts="HumanoidRoot l_hip" encoding="T1R" rotationEncoding="quaternions"',
    )
    assert whole.only({"l_hip"}).joints == ("l_hip",)
    assert whole.only({"l_hip"}).root_at(1.0) is None
    assert whole.only({"HumanoidRoot"}).root_at(1.0) == (0.0, 0.0, 1.0)


def test_a_filter_keeps_slow_motion_removes_fast_motion_and_adds_no_delay() -> None:
    """Thesis 3.2.2.2, equations 3.10 to 3.12: at the cutoff a sine keeps 1/sqrt(2) of its height, there and back."""
    times = tuple(np.arange(601) / 120.0)
    heights = {}
    for frequency in (1.0, 20.0, 45.0):
        angles = 0.2 * np.sin(2.0 * np.pi * frequency * np.array(times))
        rotations = np.stack([np.cos(angles / 2), np.sin(angles / 2), 0 * angles, 0 * angles], axis=-1)[:, np.newaxis]
        smooth = Clip("sine", times, ("vl5",), rotations).filtered(20.0)
        out = 2.0 * np.arctan2(smooth.rotations[:, 0, 1], smooth.rotations[:, 0, 0])[150:450]
        kept = angles[150:450]
        heights[frequency] = float(out @ kept / (kept @ kept))
        assert np.allclose(np.linalg.norm(smooth.rotations, axis=-1), 1.0)
    assert heights[1.0] == pytest.approx(1.0, abs=0.01)
    assert heights[20.0] == pytest.approx(math.sqrt(0.5), abs=0.02)
    assert abs(heights[45.0]) < 0.05


def test_a_filter_ignores_the_sign_of_quaternions() -> None:
    """Thesis 3.2.2.1, equations 3.8 and 3.9."""
    halves = [0.4 * math.sin(2.0 * math.pi * i / 60) for i in range(60)]

    def smooth(signs: list[float]) -> list[float]:
        keys = enumerate(zip(signs, halves, strict=True))
        rows = " ".join(f"{i / 60} {sign * math.cos(half)} {sign * math.sin(half)} 0 0" for i, (sign, half) in keys)
        filtered = clip(rows, 'parts="vl5" encoding="R"').filtered(6.0)
        return [angle(filtered.rotations_at(i / 60)["vl5"]) for i in range(60)]

    assert smooth([(-1.0) ** (i // 3) for i in range(60)]) == pytest.approx(smooth([1.0] * 60))


@pytest.mark.parametrize("cutoff", [1e-300, 0.09])
def test_a_too_low_cutoff_is_refused(cutoff: float) -> None:
    with pytest.raises(RealizerError, match=r"shake: the cutoff must be at least 0\.1 Hz, not"):
        clip("0 0 1 0 0  1 0 1 0 1  2 0 1 0 0").filtered(cutoff)


def test_only_evenly_spaced_keys_can_be_filtered() -> None:
    with pytest.raises(RealizerError, match="shake: only evenly spaced keys"):
        clip("0 0 1 0 0  1 0 1 0 1  3 0 1 0 0").filtered(0.1)


def test_a_cutoff_above_the_sample_rate_filters_nothing() -> None:
    turning = clip("0 0 1 0 0  1 0 1 0 1  2 0 1 0 0")
    assert np.array_equal(turning.filtered(20.0).rotations, turning.rotations)


def test_a_file_names_sync_points_and_exits() -> None:
    turning = clip(
        '<KeyPosition id="beat" time="0.5"/>0 0 1 0 0 <KeyPosition id="out" time="1" leave="true"/> 2 0 1 0 1'
    )
    assert turning.points == {"beat": KeyPoint(0.5), "out": KeyPoint(1.0, leave=True)}


def test_points_of_a_file_are_sync_points_of_its_motion(skeleton: Skeleton) -> None:
    named = clip('<KeyPosition id="late" time="3"/><KeyPosition id="out" time="2" leave="true"/>1 0 1 0 0  5 0 1 0 1')
    unit = KeyframeMotionUnit(named, Body(skeleton))
    assert list(unit.key_positions.items()) == [("start", 0.0), ("out", 0.25), ("late", 0.5), ("end", 1.0)]
    assert unit.exits == ("out",)
    assert unit.preferred_duration == 4.0


def test_a_keyframe_motion_that_starts_at_the_current_body_is_not_changed(skeleton: Skeleton) -> None:
    unit = KeyframeMotionUnit(arm_clip(), Body(skeleton))
    body = Body(skeleton, {})
    unit.start(body)
    for phase in (0.0, 0.02, 0.05, 0.5):
        expected = arm_clip().rotations_at(1.0 + 3.0 * phase)["r_shoulder"]
        assert unit.pose(Moment(phase, GlobalTime(0.0), body)).rotations["r_shoulder"] == pytest.approx(expected)


def test_a_motion_owns_the_arms_that_it_moves_and_with_a_leg_the_stance(skeleton: Skeleton) -> None:
    legs = clip("0 1 0 0 0  1 1 0 0 0", 'parts="l_knee" encoding="R"')
    assert KeyframeMotionUnit(arm_clip(), Body(skeleton)).resources == {Resource.RIGHT_ARM}
    assert KeyframeMotionUnit(legs, Body(skeleton)).resources == {Resource.STANCE}
    assert KeyframeMotionUnit(clip("0 0 1 0 0  1 0 1 0 0"), Body(skeleton)).resources == frozenset()


def test_a_crouch_made_for_another_body_stands_on_the_ground(skeleton: Skeleton) -> None:
    """The file says 0.7 m of a body whose height nobody knows: here the feet decide."""
    bend = "0 0.7 0 1 0 0 0 1 0 0 -1.2 1 0 0 -1.2 1 0 0 2.4 1 0 0 2.4 1 0 0 -1.2 1 0 0 -1.2"
    crouch = clip(
        f"0 {bend} 1 {bend}",
        'parts="HumanoidRoot l_hip r_hip l_knee r_knee l_ankle r_ankle" encoding="T1R" rotationEncoding="axisangles"',
    )
    posed = KeyframeMotionUnit(crouch, Body(skeleton)).pose(Moment(0.5, GlobalTime(0.0), Body(skeleton)))
    body = Body(skeleton).posed(posed.rotations, posed.root)
    for ankle in ("l_ankle", "r_ankle"):
        height = Body(skeleton).transform(ankle).position[1]
        assert body.transform(ankle).position[1] == pytest.approx(height, abs=0.01)


@pytest.mark.parametrize(
    ("rows", "attributes", "message"),
    [
        ("0 0 1 0 0", 'parts="vl5"', "the attribute encoding is missing"),
        ("0 0 1 0 0", 'parts="vl5" encoding="TRSVW"', "encoding='TRSVW' is not supported; known are R and T1R"),
        ("0 0 1 0 0", 'parts="vl5 vl5" encoding="R"', "parts names a joint twice"),
        ("0 0 1 0", 'parts="vl5" encoding="R"', "4 numbers do not form rows of 5"),
        ("", 'parts="vl5" encoding="R"', "0 numbers do not form rows of 5"),
        ("0 0 1 0 x", 'parts="vl5" encoding="R"', "could not convert string to float: 'x'"),
        ("0 1 0 0 0 1 0 1 0 1e999", 'parts="vl5" encoding="R"', "a number in row 2 is beyond 1e\\+100, or undefined"),
        ("0 1 0 0 0 1 0 1e200 0 0", 'parts="vl5" encoding="R"', "a number in row 2 is beyond 1e\\+100, or undefined"),
        ("0 nan 0 0 0 1 0 1 0 0", 'parts="vl5" encoding="R"', "a number in row 1 is beyond 1e\\+100, or undefined"),
        ("0 1 0 0 0 1 0 1 0 0", 'parts=" " encoding="R"', "parts names no joint"),
        ("0 0 1 0 0", 'parts="vl5" encoding="R"', "a motion needs two rows"),
        ("1 0 1 0 0 1 0 1 0 0", 'parts="vl5" encoding="R"', "the times of the rows do not increase"),
        ("0 0 1 0 0 1e9 0 1 0 0", 'parts="vl5" encoding="R"', "it would last longer than 86400 s"),
        ("0 7 0 9 1 0 0 0 1 7 0 20 1 0 0 0", 'parts="vl5" encoding="T1R"', "the root moves further than 10 m"),
        ("0 0 1 0 0 1 0 0 0 0", 'parts="vl5" encoding="R"', "the rotation of part 1 in row 2 has the length 0"),
        ("", 'parts="vl5" encoding="R" rotationEncoding="euler"', "0 numbers"),
        ("0 0 1 0 0", 'parts="vl5" encoding="R" rotationEncoding="euler"', "rotationEncoding='euler' is not supported"),
        ("<Key/>0 0 1 0 0 1 0 1 0 0", 'parts="vl5" encoding="R"', "only KeyPosition is allowed in"),
        ('<KeyPosition id="a" time="2"/>0 0 1 0 0 1 0 1 0 0', 'parts="vl5" encoding="R"', "a at 2 s: it lasts from"),
        ('<KeyPosition id="end" time="0.5"/>0 0 1 0 0 1 0 1 0 0', 'parts="vl5" encoding="R"', "end at 0.5 s: it lasts"),
        ('<KeyPosition id="start" time="1"/>0 0 1 0 0 1 0 1 0 0', 'parts="vl5" encoding="R"', "start at 1 s: it lasts"),
        ('<KeyPosition id="a b" time="1"/>0 0 1 0 0 1 0 1 0 0', 'parts="vl5" encoding="R"', "id='a b' cannot name"),
        (
            '<KeyPosition id="a" time="0"/><KeyPosition id="a" time="1"/>0 0 1 0 0 1 0 1 0 0',
            'parts="vl5" encoding="R"',
            "a second KeyPosition with id='a'",
        ),
        ('<KeyPosition id="" time="1"/>0 0 1 0 0 1 0 1 0 0', 'parts="vl5" encoding="R"', "id='' cannot name"),
        ('<KeyPosition id="id" time="1"/>0 0 1 0 0 1 0 1 0 0', 'parts="vl5" encoding="R"', "id='id' cannot name"),
    ],
)
def test_errors_name_the_position(rows: str, attributes: str, message: str) -> None:
    with pytest.raises(RealizerError, match=message) as with_reached_root:
        clip(rows, attributes)
    assert with_reached_root.value.fault.code == "bad-asset"
    assert "shake, line 1" in str(with_reached_root.value)


def test_start_and_end_may_be_named_at_their_positions(skeleton: Skeleton) -> None:
    rows = '<KeyPosition id="end" time="2"/><KeyPosition id="zoom" time="2"/><KeyPosition id="start" time="1"/>'
    motion = KeyframeMotionUnit(clip(f"1 1 0 0 0 2 0 1 0 0{rows}", 'parts="vl5" encoding="R"'), Body(skeleton))
    assert list(motion.key_positions.items()) == [("start", 0.0), ("zoom", 1.0), ("end", 1.0)]


def test_a_file_that_is_no_animation_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "some.xml"
    path.write_text("<SkeletonPose/>")
    with pytest.raises(RealizerError, match=r"some\.xml, line 1, <SkeletonPose>: the file should begin with"):
        read_interpolator_file(path)


def test_a_pose_file_is_one_row_without_a_time(tmp_path: Path) -> None:
    path = tmp_path / "rest.xml"
    path.write_text(
        '<SkeletonPose rotationEncoding="axisangles" parts="HumanoidRoot l_shoulder" encoding="T1R">'
        "0 0.98 0  1 0 0 0  0 0 1 0.2</SkeletonPose>"
    )
    turned = pytest.approx(from_axis_angle(Z, 0.2))
    assert read_skeleton_pose(path) == {"HumanoidRoot": IDENTITY, "l_shoulder": turned}


def test_a_pose_file_with_several_rows_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "rest.xml"
    path.write_text('<SkeletonPose parts="vl5" encoding="R">1 0 0 0 1 0 0 0</SkeletonPose>')
    with pytest.raises(RealizerError, match="2 rows; a pose has one"):
        read_skeleton_pose(path)


def test_a_file_has_rows_of_the_rotations_of_several_joints(tmp_path: Path) -> None:
    path = tmp_path / "grip.xml"
    path.write_text(
        """<?xml version="1.0" encoding="UTF-8"?>
        <SkeletonInterpolator rotationEncoding="axisangles" parts="r_thumb1 r_index1 l_index1" encoding="R">
          0 1 0 0 0.0 0 0 1 0 0 0 1 0
          2 1 0 0 0.5 0 0 1 1.4 0 0 1 -1.4
        </SkeletonInterpolator>"""
    )
    grip = read_interpolator_file(path)
    assert (grip.duration, grip.joints) == (2.0, ("r_thumb1", "r_index1", "l_index1"))
    assert grip.rotations_at(2.0) == {
        "r_thumb1": pytest.approx(from_axis_angle(X, 0.5)),
        "r_index1": pytest.approx(from_axis_angle(Z, 1.4)),
        "l_index1": pytest.approx(from_axis_angle(Z, -1.4)),
    }


def test_the_peers_files_are_read(shared_cases: Path) -> None:
    fists = read_interpolator_file(shared_cases / "asap" / "keyframe" / "clench_fists.xml")
    assert (fists.duration, len(fists.joints)) == (1.0, 22)
    assert angle(fists.rotations_at(1.0)["r_index1"]) == pytest.approx(1.57)
    rotations = read_skeleton_pose(shared_cases / "asap" / "restposes" / "looselyhangingarms.xml")
    assert angle(rotations["l_shoulder"]) == pytest.approx(0.2)


def test_the_shortest_duration_of_a_turn_does_not_depend_on_its_number_of_keys(skeleton: Skeleton) -> None:
    def shortest(count: int) -> float:
        rows = " ".join(f"{k / count} 1 0 0 {-1.2 * k / count}" for k in range(count + 1))
        arm = clip(rows, 'parts="r_shoulder" encoding="R" rotationEncoding="axisangles"')
        return KeyframeMotionUnit(arm, Body(skeleton)).shortest["end"]

    assert shortest(2) == pytest.approx(shortest(200), rel=0.05)
    assert 0.1 < shortest(200) < 1.0


def test_vertebrae_turn_for_those_that_a_figure_lacks(skeleton: Skeleton) -> None:
    whole = clip(
        "0 1 0 0 0.1 0 1 0 0.2 1 0 0 0.3  1 1 0 0 0.2 0 1 0 0.2 1 0 0 0.3",
        'parts="vl5 vl2 tail" encoding="R" rotationEncoding="axisangles"',
    )
    folded = whole.folded(skeleton.joints)
    assert set(folded.joints) == {"vl5", "tail"}
    low, high = from_axis_angle((1.0, 0.0, 0.0), 0.2), from_axis_angle((0.0, 1.0, 0.0), 0.2)
    assert folded.rotations_at(1.0)["vl5"] == pytest.approx(multiply(low, high))
    assert whole.folded({"vl5", "vl2"}) is whole
