"""Properties of the default avatars on which the realizer and the page rely."""

import io
import json
import struct
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image
from scipy.spatial import cKDTree

from reactive_realizer.assembly.assets import Assets
from reactive_realizer.binding.mouth_shapes import VISEMES
from reactive_realizer.binding.viseme_binding import VisemeBinding
from reactive_realizer.embodiment.face_mesh import FaceMesh
from reactive_realizer.embodiment.face_names import BEYOND_ARKIT, OCULUS
from reactive_realizer.embodiment.glb_arrays import GlbArrays

AVATARS = Path(__file__).resolve().parents[2] / "reactive_realizer" / "assets" / "avatars"
PATHS = [AVATARS / "female.glb", AVATARS / "male.glb"]

TRUNK = ["Hips", "Spine", "Spine1", "Spine2", "Neck", "Head"]
ARM = ["Shoulder", "Arm", "ForeArm", "Hand"]
LEG = ["UpLeg", "Leg", "Foot", "ToeBase"]
FINGERS = [f"Hand{finger}{i}" for finger, i in product(["Thumb", "Index", "Middle", "Ring", "Pinky"], (1, 2, 3))]
JOINTS = {*TRUNK, *("".join(pair) for pair in product(["Left", "Right"], [*ARM, *FINGERS, *LEG, "Eye"]))}

SIDED_SHAPES = [
    "browDown",
    "browOuterUp",
    "cheekSquint",
    "eyeBlink",
    "eyeLookDown",
    "eyeLookIn",
    "eyeLookOut",
    "eyeLookUp",
    "eyeSquint",
    "eyeWide",
    "mouthDimple",
    "mouthFrown",
    "mouthLowerDown",
    "mouthPress",
    "mouthSmile",
    "mouthStretch",
    "mouthUpperUp",
    "noseSneer",
]
SINGLE_SHAPES = [
    "browInnerUp",
    "cheekPuff",
    "jawForward",
    "jawLeft",
    "jawOpen",
    "jawRight",
    "mouthClose",
    "mouthFunnel",
    "mouthLeft",
    "mouthPucker",
    "mouthRight",
    "mouthRollLower",
    "mouthRollUpper",
    "mouthShrugLower",
    "mouthShrugUpper",
    "tongueOut",
]
ARKIT_SHAPES = sorted([*SINGLE_SHAPES, *("".join(pair) for pair in product(SIDED_SHAPES, ["Left", "Right"]))])

Gltf = dict[str, Any]


@pytest.fixture(params=PATHS, ids=lambda path: path.stem)
def path(request: pytest.FixtureRequest) -> Path:
    path: Path = request.param
    return path


@pytest.fixture
def avatar(path: Path) -> Gltf:
    """The JSON of a GLB: its first chunk."""
    data = path.read_bytes()
    magic, version, length = struct.unpack_from("<4sII", data)
    size, kind = struct.unpack_from("<I4s", data, 12)
    assert (magic, version, length, kind) == (b"glTF", 2, len(data), b"JSON")
    gltf: Gltf = json.loads(data[20 : 20 + size])
    return gltf


def joints(avatar: Gltf) -> list[dict[str, Any]]:
    return [avatar["nodes"][node] for node in avatar["skins"][0]["joints"]]


def places(avatar: Gltf) -> dict[str, list[float]]:
    """Position of each joint in meters: at rest it is the sum of the translations above it."""
    nodes = avatar["nodes"]
    found: dict[str, list[float]] = {}

    def walk(node: int, origin: list[float]) -> None:
        place = [a + b for a, b in zip(origin, nodes[node]["translation"], strict=True)]
        found[nodes[node]["name"]] = place
        for child in nodes[node].get("children", []):
            walk(child, place)

    walk(avatar["skins"][0]["skeleton"], [0, 0, 0])
    return found


def material(avatar: Gltf, name: str) -> Gltf:
    found: Gltf = next(material for material in avatar["materials"] if material["name"] == name)
    return found


def picture(path: Path, avatar: Gltf, texture: int) -> Image.Image:
    """The picture of a texture."""
    view = avatar["bufferViews"][avatar["images"][avatar["textures"][texture]["source"]]["bufferView"]]
    (size,) = struct.unpack_from("<I", path.read_bytes(), 12)
    start = 20 + size + 8 + view["byteOffset"]
    return Image.open(io.BytesIO(path.read_bytes()[start : start + view["byteLength"]]))


def test_a_file_is_smaller_than_6_megabytes(path: Path) -> None:
    assert path.stat().st_size < 6_000_000


def test_the_skeleton_has_the_54_joints_of_mixamo_with_eyes(avatar: Gltf) -> None:
    names = [joint["name"] for joint in joints(avatar)]
    assert len(names) == 54
    assert set(names) == JOINTS


def test_no_joint_is_turned_or_scaled_at_rest(avatar: Gltf) -> None:
    assert not [joint["name"] for joint in joints(avatar) if {"rotation", "scale", "matrix"} & set(joint)]


def test_the_figure_stands_in_a_t_pose_and_faces_forward(avatar: Gltf) -> None:
    place = places(avatar)
    for side, sign in (("Left", 1), ("Right", -1)):
        shoulder, elbow, wrist = (place[side + joint] for joint in ("Arm", "ForeArm", "Hand"))
        assert 0 < shoulder[0] * sign < elbow[0] * sign < wrist[0] * sign
        assert wrist[1:] == pytest.approx(shoulder[1:], abs=1e-5)
        assert place[side + "ToeBase"][2] > place[side + "Foot"][2]
    assert 0.8 < place["Hips"][1] < place["Head"][1] < 1.7


def test_the_face_has_the_52_blend_shapes_of_arkit_in_the_order_of_their_names_and_others_after_them(
    avatar: Gltf,
) -> None:
    face, eyes = (next(mesh for mesh in avatar["meshes"] if mesh["name"] == name) for name in ("Face", "Eyes"))
    names = face["extras"]["targetNames"]
    assert len(ARKIT_SHAPES) == 52
    assert names[:52] == ARKIT_SHAPES
    assert names[-15:] == [*OCULUS]
    assert {*names[52:-15], *eyes["extras"]["targetNames"]} == {*BEYOND_ARKIT}
    assert {len(primitive["targets"]) for primitive in face["primitives"]} == {len(names)}


def test_blend_shapes_move_only_the_face_and_the_eyes(avatar: Gltf) -> None:
    deformed = {mesh["name"] for mesh in avatar["meshes"] for part in mesh["primitives"] if "targets" in part}
    assert deformed == {"Face", "Eyes"}


def test_the_visemes_of_oculus_are_the_mouth_shapes_of_lip_sync(path: Path) -> None:
    mesh = FaceMesh.read(path)
    shapes = VisemeBinding.read((), mesh.moves, Assets()).shapes
    for viseme, name in zip(VISEMES, OCULUS, strict=True):
        # Moves of less than 0.04 mm are left out of the file.
        assert mesh.moves[name] == pytest.approx(mesh.displacement(shapes[viseme].morphs), abs=4e-4)


def test_a_tongue_that_is_put_out_passes_between_the_teeth_and_over_the_lower_lip(path: Path) -> None:
    mesh = FaceMesh.read(path)
    shown = mesh.vertices + mesh.displacement({"jawOpen": 0.43, "tongueOut": 0.9})
    near = np.abs(mesh.vertices[:, 0]) < 0.008
    falls = -mesh.moves["jawOpen"][:, 1]
    lip = shown[near & (falls > 0.85 * falls.max()) & (mesh.vertices[:, 2] > mesh.vertices[falls.argmax(), 2] - 0.015)]
    tongue = shown[near & (np.linalg.norm(mesh.moves["tongueLeft"], axis=1) > 1e-4)]
    assert tongue[:, 2].max() > lip[:, 2].max() + 0.01, "it is seen in front of the lip"
    over = tongue[(tongue[:, 2] > lip[:, 2].min()) & (tongue[:, 2] < lip[:, 2].max())]
    assert over[:, 1].min() > lip[:, 1].max() - 0.001, "it does not cut the lip"


def test_a_dilated_pupil_is_wider_and_both_lids_stay(path: Path) -> None:
    mesh = FaceMesh.read(path)
    for side, sign in (("Left", 1.0), ("Right", -1.0)):
        moved = np.abs(mesh.moves[f"eyeDilation{side}"]).max(axis=1) > 1e-5
        edge = sign * mesh.vertices[moved]
        assert edge[:, 0].min() > 0.01, "only this eye moves"
        middle = mesh.vertices[moved].mean(axis=0)[:2]
        before = np.linalg.norm(mesh.vertices[moved][:, :2] - middle, axis=1)
        after = np.linalg.norm((mesh.vertices + mesh.moves[f"eyeDilation{side}"])[moved][:, :2] - middle, axis=1)
        assert (after > before).all()
        narrow = (mesh.vertices + mesh.moves[f"eyeConstrict{side}"])[moved][:, :2]
        assert (np.linalg.norm(narrow - middle, axis=1) < before).all()


def test_skin_has_color_occlusion_and_roughness_of_2048_pixels(path: Path, avatar: Gltf) -> None:
    for skin in (material(avatar, name) for name in ("Skin", "BodySkin")):
        surface = skin["pbrMetallicRoughness"]
        for texture in (surface["baseColorTexture"], surface["metallicRoughnessTexture"], skin["occlusionTexture"]):
            assert picture(path, avatar, texture["index"]).size == (2048, 2048)
        assert "normalTexture" in skin


def test_hair_fades_out_at_its_ends(path: Path, avatar: Gltf) -> None:
    hair = material(avatar, "Hair")
    assert hair["alphaMode"] == "MASK"
    alpha = picture(path, avatar, hair["pbrMetallicRoughness"]["baseColorTexture"]["index"]).getchannel("A")
    faint = sum(alpha.histogram()[20:235]) / (alpha.width * alpha.height)
    assert 0.05 < faint < 0.5


def test_the_trousers_under_the_shirt_move_as_it_does(path: Path) -> None:
    """Otherwise they would come through it when the thighs rise."""
    (shirt, shirt_shares), (trousers, shares) = worn(path, "Top"), worn(path, "Pants")
    under = trousers[:, 1] > shirt[:, 1].min() + 0.005
    nearest = cKDTree(shirt).query(trousers[under])[1]
    assert np.percentile(abs(shares[under] - shirt_shares[nearest]).max(axis=1), 95) < 0.15


def worn(path: Path, name: str) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The vertices of a garment, m, and the share of their motion that follows the left and the right leg, (V, 2)."""
    arrays = GlbArrays(path)
    nodes, bones = arrays.scene["nodes"], arrays.scene["skins"][0]["joints"]
    mesh = next(mesh for mesh in arrays.scene["meshes"] if mesh["name"] == name)
    place, weights, moved_by = (
        arrays[mesh["primitives"][0]["attributes"][attribute]] for attribute in ("POSITION", "WEIGHTS_0", "JOINTS_0")
    )
    legs = [{side + joint for joint in LEG} for side in ("Left", "Right")]
    of_leg = np.array([[nodes[bone]["name"] in leg for leg in legs] for bone in bones])
    shares = np.einsum("vk,vkl->vl", weights / weights.sum(axis=1, keepdims=True), of_leg[moved_by])
    return place.astype(float), shares


def test_vrm_names_a_bone_for_every_joint(avatar: Gltf) -> None:
    bones = avatar["extensions"]["VRMC_vrm"]["humanoid"]["humanBones"]
    named = {bone: avatar["nodes"][entry["node"]]["name"] for bone, entry in bones.items()}
    assert sorted(named.values()) == sorted(JOINTS)
    expected = {"hips": "Hips", "chest": "Spine1", "leftUpperArm": "LeftArm", "rightLowerLeg": "RightLeg"}
    expected |= {"leftThumbMetacarpal": "LeftHandThumb1", "rightLittleDistal": "RightHandPinky3"}
    assert named.items() >= expected.items()


def test_vrm_names_expressions_for_the_blend_shapes(avatar: Gltf) -> None:
    presets = avatar["extensions"]["VRMC_vrm"]["expressions"]["preset"]
    moods, mouths = {"happy", "angry", "sad", "relaxed", "surprised", "neutral"}, {"aa", "ih", "ou", "ee", "oh"}
    assert set(presets) == {*moods, *mouths, "blink", "blinkLeft", "blinkRight"}
    blink = presets["blink"]["morphTargetBinds"]
    assert {ARKIT_SHAPES[bind["index"]] for bind in blink} == {"eyeBlinkLeft", "eyeBlinkRight"}


def test_a_file_carries_its_notice(avatar: Gltf) -> None:
    meta = avatar["extensions"]["VRMC_vrm"]["meta"]
    for notice in (avatar["asset"]["copyright"], meta["copyrightInformation"]):
        assert notice.startswith("CC0 1.0.")
        assert "MakeHuman / MPFB" in notice
        assert "Mika Suominen" in notice
    assert meta["otherLicenseUrl"] == "https://creativecommons.org/publicdomain/zero/1.0/"


def test_the_license_beside_the_files_names_the_same_sources() -> None:
    text = (AVATARS / "LICENSE.md").read_text(encoding="utf-8")
    for name in ("CC0 1.0", "MakeHuman", "MPFB", "Mika Suominen", *(path.name for path in PATHS)):
        assert name in text


def test_both_figures_have_the_same_skeleton() -> None:
    texts = []
    for path in PATHS:
        data = path.read_bytes()
        document = json.loads(data[20 : 20 + struct.unpack_from("<I", data, 12)[0]])
        texts.append([joint["name"] for joint in joints(document)])
    assert texts[0] == texts[1]
