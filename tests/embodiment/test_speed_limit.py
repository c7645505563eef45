"""The last safety net: nothing on the figure jumps."""

from importlib.resources import files
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.quaternion import IDENTITY, angle, conjugate, from_axis_angle, from_euler, multiply
from reactive_realizer.embodiment.speed_limit import SpeedLimit
from reactive_realizer.embodiment.vector import distance

SKELETON = Avatar.read(Path(str(files("reactive_realizer"))) / "assets" / "avatars" / "male.glb").skeleton
LIMIT = SpeedLimit(SKELETON)
FRAME = 0.02

radians = st.floats(-3.0, 3.0)
MOVING = ("vl5", "vt6", "l_sternoclavicular", "l_shoulder", "l_elbow", "r_shoulder", "r_elbow", "skullbase")
pose = st.fixed_dictionaries({joint: st.builds(from_euler, radians, radians, radians) for joint in MOVING})


@settings(max_examples=50)
@given(pose, pose)
def test_no_wrist_moves_5_cm_in_20_ms_whatever_is_asked_for(shown, wanted):
    limited = LIMIT(shown, wanted, FRAME)
    for wrist in ("l_wrist", "r_wrist"):
        assert distance(SKELETON.place(shown, wrist).position, SKELETON.place(limited, wrist).position) < 0.05


def test_a_small_step_passes_unchanged():
    wanted = {joint: from_axis_angle((1.0, 0.0, 0.0), 0.01) for joint in MOVING}
    limited = LIMIT({}, wanted, FRAME)
    assert {joint: limited[joint] for joint in MOVING} == wanted


def test_a_pose_far_away_is_reached_after_a_while_and_kept():
    wanted = {"l_shoulder": from_axis_angle((1.0, 0.0, 0.0), -2.5), "skullbase": from_axis_angle((0.0, 1.0, 0.0), 1.0)}
    shown = dict.fromkeys(SKELETON.joints, IDENTITY)
    for _ in range(60):
        shown = LIMIT(shown, wanted, FRAME)
    assert shown["l_shoulder"] == pytest.approx(wanted["l_shoulder"])
    assert shown["skullbase"] == pytest.approx(wanted["skullbase"])


def test_the_head_turns_no_faster_than_a_neck_can():
    limited = LIMIT({}, {"skullbase": from_axis_angle((0.0, 1.0, 0.0), 1.5)}, FRAME)
    assert angle(multiply(conjugate(IDENTITY), limited["skullbase"])) == pytest.approx(8.0 * FRAME)
