"""The last safety net: nothing on the figure jumps."""

from importlib.resources import files
from itertools import pairwise
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.quaternion import IDENTITY, angle, conjugate, from_axis_angle, from_euler, multiply
from reactive_realizer.embodiment.speed_limit import SpeedLimit
from reactive_realizer.embodiment.vector import distance

SKELETON = Avatar.read(Path(str(files("reactive_realizer"))) / "assets" / "avatars" / "male.glb").skeleton
FRAME = 0.02

radians = st.floats(-3.0, 3.0)
MOVING = ("vl5", "vt6", "l_sternoclavicular", "l_shoulder", "l_elbow", "r_shoulder", "r_elbow", "skullbase")
pose = st.fixed_dictionaries({joint: st.builds(from_euler, radians, radians, radians) for joint in MOVING})


@settings(max_examples=50)
@given(pose, pose)
def test_no_wrist_moves_5_cm_in_20_ms_whatever_is_asked_for(shown, wanted):
    limit = SpeedLimit(SKELETON)
    for _ in range(6):
        before, shown = shown, limit(shown, wanted, FRAME)
        for wrist in ("l_wrist", "r_wrist"):
            assert distance(SKELETON.place(before, wrist).position, SKELETON.place(shown, wrist).position) < 0.05


def test_a_small_step_passes_unchanged():
    wanted = {joint: from_axis_angle((1.0, 0.0, 0.0), 0.003) for joint in MOVING}
    limited = SpeedLimit(SKELETON)({}, wanted, FRAME)
    assert {joint: limited[joint] for joint in MOVING} == wanted


def test_a_pose_far_away_is_reached_after_a_while_and_kept():
    wanted = {"l_shoulder": from_axis_angle((1.0, 0.0, 0.0), -2.5), "skullbase": from_axis_angle((0.0, 1.0, 0.0), 1.0)}
    limit, shown = SpeedLimit(SKELETON), dict.fromkeys(SKELETON.joints, IDENTITY)
    for _ in range(60):
        shown = limit(shown, wanted, FRAME)
    assert shown["l_shoulder"] == pytest.approx(wanted["l_shoulder"])
    assert shown["skullbase"] == pytest.approx(wanted["skullbase"])


def test_the_head_turns_no_faster_than_a_neck_can():
    limited = SpeedLimit(SKELETON)({}, {"skullbase": from_axis_angle((0.0, 1.0, 0.0), 1.5)}, FRAME)
    assert angle(multiply(conjugate(IDENTITY), limited["skullbase"])) == pytest.approx(8.0 * FRAME)


@settings(max_examples=25)
@given(st.lists(st.tuples(pose, st.integers(1, 4)), min_size=2, max_size=3))
def test_a_wrist_never_goes_much_faster_than_before_however_often_it_is_called_elsewhere(calls):
    limit, shown = SpeedLimit(SKELETON), dict.fromkeys(SKELETON.joints, IDENTITY)
    steps = {"l_wrist": [0.0], "r_wrist": [0.0]}
    for wanted, frames in calls:
        for _ in range(frames):
            before, shown = shown, limit(shown, wanted, FRAME)
            for wrist, moved in steps.items():
                moved.append(distance(SKELETON.place(before, wrist).position, SKELETON.place(shown, wrist).position))
    for moved in steps.values():
        assert max(after - before for before, after in pairwise(moved)) < 0.0151


@settings(max_examples=10)
@given(pose)
def test_a_wrist_comes_to_where_it_is_wanted_and_never_goes_past(wanted):
    limit, shown = SpeedLimit(SKELETON), dict.fromkeys(SKELETON.joints, IDENTITY)
    shares = []
    for _ in range(60):
        shown = limit(shown, wanted, FRAME)
        shares.append(angle(multiply(conjugate(shown["r_elbow"]), wanted["r_elbow"])))
    assert all(after < before + 1e-9 for before, after in pairwise(shares))
    assert shares[-1] < 1e-6


def test_a_wrist_that_is_called_back_sets_out_anew():
    limit, shown = SpeedLimit(SKELETON), dict.fromkeys(SKELETON.joints, IDENTITY)
    there = {"r_elbow": from_axis_angle((1.0, 0.0, 0.0), -2.0)}
    places = [SKELETON.place(shown, "r_wrist").position]
    for wanted in [there] * 5 + [{}] * 2:
        shown = limit(shown, wanted, FRAME)
        places.append(SKELETON.place(shown, "r_wrist").position)
    steps = [distance(a, b) for a, b in pairwise(places)]
    assert steps[0] < 0.0151
    assert steps[4] > 0.04, "at full speed"
    assert steps[5] < 0.0151, "and back slowly"


def test_a_hand_turns_about_its_wrist_so_slowly_that_its_fingertips_move_less_than_3_cm():
    limited = SpeedLimit(SKELETON)({}, {"r_wrist": from_axis_angle((1.0, 0.0, 0.0), 1.5)}, FRAME)
    assert distance(SKELETON.place({}, "r_middle3").position, SKELETON.place(limited, "r_middle3").position) < 0.03
