"""Avatars of other tools: other names, axes, units, sizes, rest poses, and missing bones."""

import math
from pathlib import Path
from typing import Any

import pytest

from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.frame import rotation_array
from reactive_realizer.embodiment.mixamo import JOINTS
from reactive_realizer.embodiment.quaternion import from_axis_angle
from reactive_realizer.embodiment.rig_names import VRM_0_JOINTS, VRM_1_JOINTS
from reactive_realizer.embodiment.vector import Vec3, distance, subtract, unit
from reactive_realizer.errors import RealizerError

from .rigs import OWN, Rig, bone_places, write

MIXAMO = {joint: f"mixamorig:{bone}" for bone, joint in JOINTS.items()}
NUMBERED = {joint: f"mixamorig7:{bone}" for bone, joint in JOINTS.items()}
UNITY = {joint: bone for bone, joint in VRM_0_JOINTS.items()}


def without_fingers_and_toes(joint: str) -> str | None:
    return None if joint[-1] in "123" or joint.endswith("midtarsal") else joint


RIGS = {
    "the own axes": Rig(),
    "Mixamo in centimeters": Rig(MIXAMO.__getitem__, rotated=True, units=0.01),
    "Mixamo with a number in the prefix": Rig(NUMBERED.__getitem__, units=0.01),
    "Unity names": Rig(UNITY.__getitem__, rotated=True),
    "small": Rig(size=0.8, rotated=True),
    "tall": Rig(size=1.3, lowered=0.2),
    "arms lowered": Rig(lowered=math.radians(45), rotated=True),
    "facing back": Rig(heading=math.pi, rotated=True),
    "facing left": Rig(heading=0.5 * math.pi, lowered=0.7),
    "without fingers and toes": Rig(without_fingers_and_toes, rotated=True),
}


@pytest.fixture(params=RIGS, scope="module")
def rig(request: pytest.FixtureRequest) -> Rig:
    return RIGS[request.param]


def shown(rig: Rig, avatar: Avatar, body: Body) -> dict[str, Vec3]:
    rotations = rotation_array(avatar.skeleton, body.pose)
    return bone_places(rig.scene(), avatar, body.transform("HumanoidRoot").position, rotations)


@pytest.fixture
def avatar(rig: Rig, tmp_path: Path) -> Avatar:
    return Avatar.read(write(tmp_path / "rig.glb", rig.scene()))


def test_a_renderer_shows_every_joint_where_the_realizer_has_it(rig: Rig, avatar: Avatar) -> None:
    joints = avatar.skeleton.joints
    body = Body(
        avatar.skeleton,
        {
            joint: from_axis_angle(unit((i % 3 - 1.0, i % 5 - 2.0, 1.0)), 0.07 * (i % 11))
            for i, joint in enumerate(joints)
        },
    )
    places = shown(rig, avatar, body)
    assert set(places) == set(joints)
    assert max(distance(places[joint], body.transform(joint).position) for joint in joints) < 1e-6


def test_a_pose_looks_as_that_of_the_default_avatar(rig: Rig, avatar: Avatar) -> None:
    turns = {
        "HumanoidRoot": from_axis_angle((0.0, 1.0, 0.0), 0.4),
        "vt10": from_axis_angle((1.0, 0.0, 0.0), 0.3),
        "l_shoulder": from_axis_angle((0.0, 0.0, 1.0), 0.9),
        "r_elbow": from_axis_angle((1.0, 0.0, 0.0), -1.4),
        "l_wrist": from_axis_angle((1.0, 0.0, 0.0), 0.5),
    }
    places, own = shown(rig, avatar, Body(avatar.skeleton, turns)), Body(OWN.skeleton, turns)
    for joint, end in (("l_shoulder", "l_elbow"), ("r_elbow", "r_wrist"), ("l_hip", "l_knee"), ("vt6", "skullbase")):
        way = unit(subtract(places[end], places[joint]))
        expected = unit(subtract(own.transform(end).position, own.transform(joint).position))
        assert distance(way, expected) < 1e-3


def test_a_rig_has_the_joints_of_its_bones(rig: Rig, avatar: Avatar) -> None:
    assert set(avatar.skeleton.joints) == {joint for joint in OWN.skeleton.joints if rig.name(joint) is not None}


@pytest.mark.parametrize("version", [0, 1])
def test_a_vrm_file_says_which_bone_is_which_whatever_their_names(tmp_path: Path, version: int) -> None:
    scene = Rig(rotated=True, heading=math.pi if version == 0 else 0.0).scene()
    table = {joint: bone for bone, joint in (VRM_0_JOINTS if version == 0 else VRM_1_JOINTS).items()}
    humans = {table[node["name"]]: i for i, node in enumerate(scene["nodes"]) if node["name"] in table}
    for i, node in enumerate(scene["nodes"]):
        node["name"] = f"bone {i}"
    if version == 0:
        listed = [{"bone": bone, "node": node} for bone, node in humans.items()]
        scene["extensions"] = {"VRM": {"humanoid": {"humanBones": listed}}}
    else:
        named = {bone: {"node": node} for bone, node in humans.items()}
        scene["extensions"] = {"VRMC_vrm": {"humanoid": {"humanBones": named}}}
    avatar = Avatar.read(write(tmp_path / "anna.vrm", scene))
    assert avatar.skeleton.joints == OWN.skeleton.joints
    wrist = Body(avatar.skeleton).transform("l_wrist").position
    assert distance(wrist, Body(OWN.skeleton).transform("l_wrist").position) < 1e-6


def test_two_skins_are_one_skeleton(tmp_path: Path) -> None:
    scene = Rig().scene()
    (joints,) = (skin["joints"] for skin in scene["skins"])
    scene["skins"] = [{"joints": joints[30:]}, {"joints": joints[:40]}]
    assert set(Avatar.read(write(tmp_path / "two.glb", scene)).skeleton.joints) == set(OWN.skeleton.joints)


def test_of_two_figures_in_a_file_the_first_is_used(tmp_path: Path) -> None:
    scene = Rig().scene()
    (skin,), nodes = scene["skins"], scene["nodes"]
    first = len(nodes)
    others = [{**node, "children": [first + i for i in node.get("children", ())]} for node in nodes]
    others[0] = {**others[0], "translation": [2.0, 0.0, 0.0]}
    both = {**scene, "nodes": [*nodes, *others], "skins": [skin, {"joints": [first + i for i in skin["joints"]]}]}
    avatar, alone = (Avatar.read(write(tmp_path / "both.glb", each)) for each in (both, scene))
    assert avatar.skeleton == alone.skeleton
    assert avatar.bones == alone.bones


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"translation": [math.nan, 0.0, 0.0]}, "HumanoidRoot is nowhere at rest"),
        ({"scale": [1.0, 2.0, 1.0]}, "HumanoidRoot is scaled unevenly or mirrored"),
        ({"scale": [-1.0, 1.0, 1.0]}, "HumanoidRoot is scaled unevenly or mirrored"),
        ({"scale": [100.0, 100.0, 100.0]}, "its head is .* m above its hips; it must stand upright, y up, in meters"),
        ({"rotation": [0.7071, 0.0, 0.0, 0.7071]}, "it must stand upright"),
        ({"rotation": [0.0, 0.0, 0.0, 0.0]}, "nowhere at rest: its rotation is zero"),
        ({"name": "thing"}, "no bone for HumanoidRoot"),
    ],
)
def test_a_rest_pose_that_cannot_be_used_is_refused_with_the_reason(
    tmp_path: Path, change: dict[str, Any], reason: str
) -> None:
    scene = Rig().scene()
    scene["nodes"][1] |= change
    with pytest.raises(RealizerError, match=rf"bad\.glb cannot be used as an avatar: .*{reason}"):
        Avatar.read(write(tmp_path / "bad.glb", scene))
