"""Captures in common variants: joint names, rest poses and axes.

Each variant occurs in a published file; the figures here are made for the tests.
"""

import math
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.body import JointRotations
from reactive_realizer.embodiment.quaternion import angle, difference, from_axis_angle, normalize, rotate
from reactive_realizer.embodiment.vector import UP
from reactive_realizer.engines.animation.keyframe.bvh_reader import read_capture
from reactive_realizer.engines.animation.keyframe.clip import Clip
from reactive_realizer.engines.animation.keyframe.retarget import retargeted
from reactive_realizer.errors import RealizerError

from .capturing import T_POSE, Turns, assert_same_directions, bvh, with_axes
from .conftest import ASSETS

SKELETON = Avatar.read(ASSETS / "avatars" / "female.glb").skeleton
LENGTH = -SKELETON.offset("l_knee")[1] / 44.0
"""Meters of our figure for each centimeter of the captured one."""

POSE: Turns = {"LeftArm": (30.0, 20.0, 10.0), "RightLeg": (0.0, 40.0, 0.0), "Spine": (0.0, 10.0, 0.0)}
Z_UP = from_axis_angle((1.0, 0.0, 0.0), 1.5707963267948966)

MIDDLE = {"Hips": "Hips", "Spine": "Spine", "Spine1": "Chest", "Neck": "Neck", "Head": "Head"}
PARTS = ("Shoulder", "Arm", "ForeArm", "Hand", "UpLeg", "Leg", "Foot")
MAYA = ("Shoulder", "UpperArm", "LowerArm", "Hand", "UpperLeg", "LowerLeg", "Foot")
ACCLAIM = ("clavicle", "humerus", "radius", "hand", "femur", "tibia", "foot")
BIPED = ("Clavicle", "UpperArm", "Forearm", "Hand", "Thigh", "Calf", "Foot")


def called(left: str, right: str, parts: tuple[str, ...], **middle: str) -> dict[str, str]:
    """Names for the joints, with the part where the braces are."""
    sides = {"Left": left, "Right": right}
    limbs = {
        f"{side}{own}": how.format(part) for side, how in sides.items() for own, part in zip(PARTS, parts, strict=True)
    }
    return MIDDLE | limbs | middle


NAMES = {
    "Mixamo": {name: f"mixamorig:{name}" for name, _, _ in T_POSE},
    "Biovision": called("Left{}", "Right{}", ("Collar", "Shoulder", "Elbow", "Wrist", "Hip", "Knee", "Ankle")),
    "Poser": called(
        "l{}", "r{}", ("Collar", "Shldr", "ForeArm", "Hand", "Thigh", "Shin", "Foot"), Hips="hip", Spine="abdomen"
    ),
    "Bandai Namco": called("{}_L", "{}_R", MAYA),
    "Rokoko": called("Left{}", "Right{}", ("Shoulder", "Arm", "ForeArm", "Hand", "Thigh", "Shin", "Foot")),
    "3ds Max": called("Bip01 L {}", "Bip01 R {}", BIPED, Hips="Bip01 Pelvis", Head="Bip01 Head"),
    "Unreal": called("{}_l", "{}_r", tuple(map(str.lower, BIPED)), Hips="pelvis", Head="head"),
    "Acclaim": called("l{}", "r{}", ACCLAIM, Hips="root", Spine="lowerback", Spine1="thorax", Neck="neck", Head="head"),
    "EMBR": called("{}.Left", "{}.Right", ACCLAIM, Hips="root", Spine="spine1", Spine1="spine2", Head="head"),
    "VRoid": called("J_Bip_L_{}", "J_Bip_R_{}", MAYA, Head="J_Bip_C_Head"),
}


@pytest.fixture
def clip(tmp_path: Path) -> Callable[[str], Clip]:
    def read(text: str) -> Clip:
        path = tmp_path / "some.bvh"
        path.write_text(text)
        return retargeted(read_capture(path), SKELETON)

    return read


@pytest.mark.parametrize("kind", NAMES)
def test_joint_names_of_several_vendors_are_known(clip: Callable[[str], Clip], kind: str) -> None:
    found = clip(bvh(POSE, POSE, names=NAMES[kind]))
    assert_same_directions(found, 0.0, SKELETON, POSE)
    assert {"HumanoidRoot", "vl5", "vt6", "vc4", "skullbase"} <= set(found.joints)


def test_fingers_may_be_numbered_from_the_thumb_as_in_poses_of_embr(clip: Callable[[str], Clip]) -> None:
    finger = [(f"2{bone}.Left", (2.0, 0.0, 0.0)) for bone in ("Cp", "Mcp", "Prox", "Dist")]
    above = ["LeftHand", *(name for name, _ in finger)]
    bones = (*T_POSE, *((name, up, offset) for (name, offset), up in zip(finger, above, strict=False)))
    found = clip(bvh({}, {"2Prox.Left": (-60.0, 0.0, 0.0)}, bones=bones))
    assert {"l_index1", "l_index2", "l_index3"} <= set(found.joints)
    straight, bent = (found.rotations_at(time) for time in (0.0, 1.0))
    turns = {joint: math.degrees(angle(difference(straight[joint], bent[joint]))) for joint in straight}
    assert turns["l_index2"] == pytest.approx(60.0)
    assert turns["l_index1"] == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize(
    ("spine", "ours"),
    [
        (["Chest"], ["vl5"]),
        (["Spine", "Spine1", "Spine2"], ["vl5", "vt10", "vt6"]),
        (["Chest", "Chest2", "Chest3", "Chest4"], ["vl5", "vt10", "vt6"]),
    ],
)
def test_a_spine_with_any_number_of_joints_is_mapped(
    clip: Callable[[str], Clip], spine: list[str], ours: list[str]
) -> None:
    """The lowest, a middle and the highest joint are mapped, with any names."""
    bones = [bone for bone in T_POSE if bone[0] not in ("Spine", "Spine1")]
    trunk = [(name, above, (0.0, 8.0, 0.0)) for name, above in zip(spine, ["Hips", *spine], strict=False)]
    body = [(name, spine[-1] if above == "Spine1" else above, offset) for name, above, offset in bones[1:]]
    found = clip(bvh({}, {}, bones=(bones[0], *trunk, *body)))
    assert [joint for joint in found.joints if joint in ("vl5", "vt10", "vt6")] == ours


def test_extra_joints_between_pelvis_and_thigh_and_in_the_neck_are_ignored(
    clip: Callable[[str], Clip],
) -> None:
    """As in B. Hahne's conversion of the captures of Carnegie Mellon University."""
    between = (("LHipJoint", "Hips", (0.0, 0.0, 0.0)), ("Neck1", "Neck", (0.0, 5.0, 0.0)))
    moved = {"LeftUpLeg": "LHipJoint", "Head": "Neck1"}
    bones = (T_POSE[0], *between[:1], *T_POSE[1:4], *between[1:], *T_POSE[4:])
    bones = tuple((name, moved.get(name, above), offset) for name, above, offset in bones)
    assert_same_directions(clip(bvh(POSE, POSE, bones=bones)), 0.0, SKELETON, POSE)


def test_the_root_follows_the_pelvis_below_an_extra_root_joint(
    clip: Callable[[str], Clip],
) -> None:
    """Bandai Namco's joint_Root, MotionBuilder's Reference."""
    bones = (("Reference", None, (0.0, 0.0, 0.0)), ("Hips", "Reference", (0.0, 98.0, 0.0)), *T_POSE[1:])
    found = clip(bvh(POSE, POSE, bones=bones, places=[(0.0, 98.0, 5.0), (0.0, 98.0, 25.0)]))
    assert found.root_at(0.01) == pytest.approx((0.0, 0.0, 20.0 * LENGTH), abs=0.002)
    assert_same_directions(found, 0.0, SKELETON, POSE)


def test_position_channels_of_all_joints_are_accepted(
    clip: Callable[[str], Clip],
) -> None:
    """Mixamo's, as some converters write them."""
    found = clip(bvh(POSE, POSE, moved=[name for name, _, _ in T_POSE]))
    assert_same_directions(found, 0.0, SKELETON, POSE)


def test_a_capture_without_positions_stays_in_place(
    clip: Callable[[str], Clip],
) -> None:
    found = clip(bvh(POSE, POSE, moved=()))
    assert found.root_at(0.01) == (0.0, 0.0, 0.0)
    assert_same_directions(found, 0.0, SKELETON, POSE)


def test_a_file_with_z_up_is_turned(
    clip: Callable[[str], Clip],
) -> None:
    bones, frames = with_axes(T_POSE, [{}, POSE], Z_UP, {})
    places = [rotate(Z_UP, place) for place in ((0.0, 98.0, 0.0), (0.0, 98.0, 20.0))]
    found = clip(bvh(*frames, bones=bones, places=places))
    assert_same_directions(found, 0.01, SKELETON, POSE)
    assert found.root_at(0.01) == pytest.approx((0.0, 0.0, 20.0 * LENGTH), abs=0.002)


# By less than 90 degrees: beyond, a figure without rotations may by chance look like one that stands the other way.
turns = st.tuples(st.just(1.0), *(st.floats(-0.55, 0.55) for _ in range(3)))
axes = st.fixed_dictionaries({name: turns.map(normalize) for name, _, _ in T_POSE})


@settings(max_examples=40, deadline=None, derandomize=True)
@given(axes)
def test_joints_with_axes_of_their_own_are_read_relative_to_the_first_frame(
    tmp_path_factory: pytest.TempPathFactory, own: JointRotations
) -> None:
    """Of Maya, of Rokoko: without rotations this figure is a heap of bones."""
    bones, frames = with_axes(T_POSE, [{}, POSE], from_axis_angle(UP, 0.0), own)
    path = tmp_path_factory.mktemp("capture") / "some.bvh"
    path.write_text(bvh(*frames, bones=bones))
    found = retargeted(read_capture(path), SKELETON)
    assert_same_directions(found, 0.0, SKELETON, {})
    assert_same_directions(found, 0.01, SKELETON, POSE)


def test_a_figure_without_rotations_whose_left_and_right_hips_are_swapped_is_no_reference(
    clip: Callable[[str], Clip],
) -> None:
    own = {"Hips": from_axis_angle((0.0, 0.0, 1.0), math.radians(120))}
    bones, frames = with_axes(T_POSE, [{}, POSE], from_axis_angle(UP, 0.0), own)
    assert_same_directions(clip(bvh(*frames, bones=bones)), 0.01, SKELETON, POSE)


def test_the_error_names_the_missing_joints(
    clip: Callable[[str], Clip],
) -> None:
    names = {"LeftUpLeg": "thing"}
    with pytest.raises(RealizerError, match="known name for HumanoidRoot, l_hip, skullbase"):
        clip(bvh(POSE, POSE, names=names))
