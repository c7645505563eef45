"""Avatars and their bones."""

import json
import math
import re
import struct
from collections.abc import Callable
from dataclasses import replace
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.body import Body, JointRotations
from reactive_realizer.embodiment.face_names import ARKIT, BEYOND_ARKIT, OCULUS
from reactive_realizer.embodiment.frame import rotation_array
from reactive_realizer.embodiment.glb import read_binary, write_binary
from reactive_realizer.embodiment.humanoid import Humanoid
from reactive_realizer.embodiment.mixamo import JOINTS
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, from_axis_angle, multiply, rotate
from reactive_realizer.embodiment.rig import Bone
from reactive_realizer.embodiment.two_bone_ik import Arm
from reactive_realizer.embodiment.vector import Vec3, add, distance, subtract, unit
from reactive_realizer.errors import RealizerError

AVATARS = Path(str(files("reactive_realizer"))) / "assets" / "avatars"


@pytest.fixture(params=["female", "male"], scope="module")
def avatar(request: pytest.FixtureRequest) -> Avatar:
    return Avatar.read(AVATARS / f"{request.param}.glb")


def bone_places(avatar: Avatar, pose: JointRotations) -> dict[str, tuple[Vec3, Quat]]:
    """Forward kinematics on the avatar's own bones, as a renderer does it: name -> (position, rotation)."""
    rotations = avatar.bone_rotations(rotation_array(avatar.skeleton, pose))
    places: list[tuple[Vec3, Quat]] = []
    for bone, rotation in zip(avatar.bones, rotations.tolist(), strict=True):
        at, turn = places[bone.parent] if bone.parent >= 0 else ((0.0, 0.0, 0.0), IDENTITY)
        places.append((add(at, rotate(turn, bone.translation)), multiply(turn, tuple(rotation))))
    return {bone.name: place for bone, place in zip(avatar.bones, places, strict=True)}


@pytest.mark.parametrize("side", ["Left", "Right"])
def test_in_the_default_pose_wrists_hang_below_elbows_below_shoulders(avatar: Avatar, side: str) -> None:
    places = bone_places(avatar, {})
    shoulder, elbow, wrist, finger = (places[side + name][0] for name in ("Arm", "ForeArm", "Hand", "HandMiddle1"))
    assert shoulder[1] > elbow[1] + 0.2 > wrist[1] + 0.4
    assert finger[1] < wrist[1] - 0.05
    assert wrist == pytest.approx((shoulder[0], wrist[1], shoulder[2]), abs=0.01)


@pytest.mark.parametrize(("side", "inward"), [("Left", (-1.0, 0.0, 0.0)), ("Right", (1.0, 0.0, 0.0))])
def test_in_the_default_pose_palms_face_the_thighs_and_thumbs_point_forward(
    avatar: Avatar, side: str, inward: Vec3
) -> None:
    places = bone_places(avatar, {})
    hand, turn = places[f"{side}Hand"]
    # In the T-pose a palm faces the ground.
    assert rotate(turn, (0.0, -1.0, 0.0)) == pytest.approx(inward, abs=1e-9)
    assert places[f"{side}HandThumb2"][0][2] > hand[2]


def test_the_legs_stand_and_the_head_is_above_the_neck(avatar: Avatar) -> None:
    places = bone_places(avatar, {})
    for side in ("Left", "Right"):
        assert places[f"{side}UpLeg"][0][1] > places[f"{side}Leg"][0][1] > places[f"{side}Foot"][0][1] > 0.0
        assert places[f"{side}ToeBase"][0][2] > places[f"{side}Foot"][0][2]
    assert places["Head"][0][1] > places["Neck"][0][1] > places["Spine2"][0][1]


def test_the_figures_left_is_at_positive_x_and_it_faces_positive_z(avatar: Avatar) -> None:
    places = bone_places(avatar, {})
    assert places["LeftArm"][0][0] > 0.1 > -0.1 > places["RightArm"][0][0]
    assert places["LeftEye"][0][2] > places["Head"][0][2]


def test_every_joint_is_where_its_bone_is_in_any_pose(avatar: Avatar) -> None:
    turns = {
        joint: from_axis_angle(unit((i % 3 - 1.0, i % 5 - 2.0, 1.0)), 0.07 * (i % 11))
        for i, joint in enumerate(avatar.skeleton.joints)
    }
    places = bone_places(avatar, turns)
    positions = sorted(place[0] for place in places.values())
    body = Body(avatar.skeleton, turns)
    joints = sorted(body.transform(joint).position for joint in avatar.skeleton.joints)
    assert len(joints) == len(avatar.bones)
    assert np.allclose(positions, joints, atol=1e-9)


def test_an_elbow_bent_about_x_takes_the_hand_forward_on_both_sides(avatar: Avatar) -> None:
    bend = from_axis_angle((1.0, 0.0, 0.0), -math.pi / 2)
    places = bone_places(avatar, {"l_elbow": bend, "r_elbow": bend})
    for side in ("Left", "Right"):
        forearm = unit(subtract(places[f"{side}Hand"][0], places[f"{side}ForeArm"][0]))
        assert forearm == pytest.approx((0.0, 0.0, 1.0), abs=0.05)


def test_the_avatars_have_54_joints_and_the_52_arkit_targets(avatar: Avatar) -> None:
    assert len(avatar.skeleton.joints) == 54
    assert set(avatar.morphs) == {*ARKIT, *BEYOND_ARKIT, *OCULUS, "skinBlush", "skinPallor"}
    assert avatar.morphs[-2:] == ("skinBlush", "skinPallor")
    assert {"jawOpen", "eyeBlinkLeft", "mouthSmileRight"} <= set(avatar.morphs)
    assert avatar.skeleton.parent("l_elbow") == "l_shoulder"
    assert avatar.skeleton.chain("skullbase") == ("HumanoidRoot", "vl5", "vt10", "vt6", "vc4", "skullbase")


def bones() -> list[Bone]:
    chain = ["Hips", "Spine", "LeftShoulder", "Twist", "LeftArm", "LeftForeArm", "LeftHand"]
    places = [(name, i - 1, (0.1, 0.2, 0.0)) for i, name in enumerate(chain)]
    places += [("Head", 1, (0.0, 0.5, 0.0)), ("RightArm", 1, (-0.2, 0.3, 0.0))]
    places += [("RightForeArm", 8, (-0.3, 0.0, 0.0)), ("RightHand", 9, (-0.3, 0.0, 0.0))]
    return [Bone(name, parent, way, JOINTS.get(name)) for name, parent, way in places]


def test_a_bone_without_a_joint_stays_at_rest_and_its_length_counts_for_the_joint_below() -> None:
    avatar = Avatar.of_bones(bones(), [], "some.glb")
    assert "Twist" not in avatar.skeleton.joints
    assert distance(avatar.skeleton.offset("l_shoulder"), (0.2, 0.4, 0.0)) < 1e-9
    rotations = avatar.bone_rotations(rotation_array(avatar.skeleton, {}))
    assert rotations[3].tolist() == list(IDENTITY)


def test_an_avatar_without_an_arm_is_refused_by_name() -> None:
    with pytest.raises(RealizerError, match=r"some\.glb .* no bone for r_wrist"):
        Avatar.of_bones(bones()[:-1], [], "some.glb")


@pytest.mark.parametrize(("way", "said"), [((0.0, 0.0, 0.0), "0 m"), ((math.nan, 0.0, 0.0), "nan m")])
def test_a_forearm_without_a_length_is_refused_by_name(way: Vec3, said: str) -> None:
    *others, hand = bones()
    with pytest.raises(RealizerError, match=rf"some\.glb .* r_wrist is {said} from the joint above"):
        Avatar.of_bones([*others, replace(hand, translation=way)], [], "some.glb")


def test_other_bones_may_have_no_length() -> None:
    parts = [replace(bone, translation=(0.0, 0.0, 0.0)) if bone.name == "Spine" else bone for bone in bones()]
    skeleton = Avatar.of_bones(parts, [], "some.glb").skeleton
    body = Body(skeleton, {"vl5": from_axis_angle((0.0, 1.0, 0.0), 0.5)})
    assert body.transform("vl5").position == body.transform("HumanoidRoot").position
    Arm.of(skeleton, "l").solve((0.0, 0.0, 0.0))


def glb(scene: dict[str, object] | bytes) -> bytes:
    text = scene if isinstance(scene, bytes) else json.dumps(scene).encode()
    return struct.pack("<4sIII4s", b"glTF", 2, 20 + len(text), len(text), b"JSON") + text


TWO_BONES: dict[str, object] = {"skins": [{"joints": [0, 1]}], "meshes": []}


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (b"", "too short"),
        (b"<html>no avatar here</html>", "not a binary glTF 2"),
        (glb(b"{nonsense"), "cannot be read"),
        (glb(b"[" * 1_000_000), "cannot be read: maximum recursion depth"),
        (struct.pack("<4sIII4s", b"glTF", 2, 2**31, 2**30, b"JSON"), "its JSON chunk is over 16777216 bytes"),
        (glb(b"[]"), "not an object"),
        (glb({})[:-1], "cut off: 21 of 22 bytes are there"),
        (struct.pack("<4sIII4s", b"glTF", 2, 500 * 2**20, 2, b"JSON") + b"{}", "it has 500 MiB; at most 256 are read"),
        (glb({"nodes": []}), "no skin"),
        (glb({"nodes": [{"name": "Hips"}], "skins": [{"joints": [0]}], "meshes": [None]}), "unusable skin or mesh"),
        (
            glb({"nodes": [{"name": n, "children": [1 - i]} for i, n in enumerate("ab")], **TWO_BONES}),
            "own ancestor",
        ),
        (
            glb({"nodes": [{"children": [1]}, {"children": [1]}], **TWO_BONES}),
            "the node 1 has two nodes above it, 0 and 1",
        ),
        (glb({"nodes": [{"children": [-1]}, {}], **TWO_BONES}), "the node 0 has a child, -1, that does not exist"),
        (glb({"nodes": [{}], "skins": [{"joints": [-1]}], "meshes": []}), "it has a bone that is none of its nodes"),
        (glb({"nodes": [{"name": "Hips"}], "skins": [{"joints": [0] * 1001}]}), "more than 1000 bones"),
        (glb({"nodes": [{"name": "Hips"}], "skins": [{"joints": [7]}], "meshes": []}), "unusable skin or mesh"),
        (glb({"nodes": [{"name": "Hips"}], "skins": [{"joints": [0]}], "meshes": []}), "no bone for skullbase"),
    ],
)
def test_an_invalid_avatar_file_is_refused_with_its_name_and_the_reason(
    tmp_path: Path, content: bytes, reason: str
) -> None:
    path = tmp_path / "wrong.glb"
    path.write_bytes(content)
    with pytest.raises(RealizerError, match=rf"wrong\.glb cannot be used as an avatar: .*{reason}"):
        Avatar.read(path)


def test_a_large_file_is_refused_before_it_is_read(tmp_path: Path) -> None:
    path = tmp_path / "huge.glb"
    path.write_bytes(glb({}))
    with path.open("r+b") as file:
        file.truncate(500 * 2**20)
    with pytest.raises(RealizerError, match=r"huge\.glb cannot be used as an avatar: it has 500 MiB"):
        Avatar.read(path)


def test_what_the_page_cannot_show_is_noted(tmp_path: Path) -> None:
    path = tmp_path / "small.glb"
    size = int.from_bytes((AVATARS / "female.glb").read_bytes()[12:16], "little")
    scene = json.loads((AVATARS / "female.glb").read_bytes()[20 : 20 + size])
    path.write_bytes(glb({**scene, "extensionsRequired": ["KHR_draco_mesh_compression"]}))
    assert Avatar.read(path).notes == (
        "the page cannot show it, because it is compressed with KHR_draco_mesh_compression; export it without",
    )


def changed_female(path: Path, change: Callable[[dict[str, Any]], object]) -> Path:
    """A copy of the package's avatar whose description is changed."""
    scene, data = read_binary(AVATARS / "female.glb")
    change(scene)
    write_binary(path, scene, data)
    return path


def counted(count: int) -> Callable[[dict[str, Any]], object]:
    """A change of the number of vertices of the first mesh."""
    return lambda scene: scene["accessors"][scene["meshes"][0]["primitives"][0]["attributes"]["POSITION"]].update(
        count=count
    )


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (counted(999_999), r"the accessor 0, POSITION of the mesh Face, has 999999 elements; .* room for 3854"),
        (counted(12), r"the vertices of the mesh Face .* 12 POSITION \(accessor 0\), 3854 JOINTS_0 \(accessor 3\)"),
        (lambda scene: scene["skins"][0].pop("inverseBindMatrices"), r"the skin 0 has no inverse bind matrices"),
        (lambda scene: scene["skins"][0]["joints"].append(0), r"the skin 0 has 55 bones, but 54 inverse bind matrices"),
        (lambda scene: scene["meshes"][0]["primitives"][0]["attributes"].pop("WEIGHTS_0"), r"without WEIGHTS_0"),
        (lambda scene: scene["accessors"].clear(), r"the skin of the node Face cannot be read"),
    ],
    ids=["too many vertices", "too few vertices", "no matrices", "too few matrices", "no weights", "no accessors"],
)
def test_a_skin_that_cannot_be_shown_as_meant_is_noted_and_the_figure_plays(
    tmp_path: Path, change: Callable[[dict[str, Any]], object], said: str
) -> None:
    avatar = Avatar.read(changed_female(tmp_path / "odd.glb", change))
    assert re.search(said, " | ".join(avatar.notes))
    assert Humanoid(avatar).shown.transform("l_wrist").position == pytest.approx(
        Humanoid(Avatar.read(AVATARS / "female.glb")).shown.transform("l_wrist").position
    )


def test_the_skins_of_the_package_have_no_faults() -> None:
    assert Avatar.read(AVATARS / "female.glb").notes == Avatar.read(AVATARS / "male.glb").notes == ()


def test_a_bone_that_is_far_away_is_refused_by_name(tmp_path: Path) -> None:
    def away(scene: dict[str, Any]) -> None:
        next(node for node in scene["nodes"] if node["name"] == "LeftHand")["translation"] = [1e30, 0, 0]

    with pytest.raises(RealizerError, match=r"far\.glb .*: the bone LeftHand is 1e\+30 m away from the origin"):
        Avatar.read(changed_female(tmp_path / "far.glb", away))
