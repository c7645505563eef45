"""Avatars with their motion in GLB files, read again: where an animation of glTF puts bones and morph targets."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from reactive_realizer.__main__ import main
from reactive_realizer.assembly.assets import PACKAGE_ASSETS
from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.glb import read_binary, write_binary
from reactive_realizer.testing.pilot import block

FEMALE = PACKAGE_ASSETS / "avatars" / "female.glb"
PLAYED = block("b", '<gesture id="g" lexeme="WAVE" end="2"/><faceLexeme id="f" lexeme="OPEN_MOUTH" end="2"/>')


def performance(path: Path) -> tuple[dict[str, Any], dict[tuple[str, str], NDArray[np.float64]]]:
    """The scene of a file, and the values of its only animation by names of nodes and of what is animated."""
    scene, data = read_binary(path)

    def values(index: int) -> NDArray[np.float64]:
        accessor = scene["accessors"][index]
        size = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[accessor["type"]]
        start = scene["bufferViews"][accessor["bufferView"]]["byteOffset"]
        return np.frombuffer(data, "<f4", accessor["count"] * size, start).reshape(-1, size).astype(float)

    (animation,) = scene["animations"]
    found = {}
    for channel in animation["channels"]:
        sampler, target = animation["samplers"][channel["sampler"]], channel["target"]
        found[scene["nodes"][target["node"]]["name"], target["path"]] = values(sampler["output"])
        found["", "time"] = values(sampler["input"])
    assert scene["buffers"][0]["byteLength"] <= len(data)
    return scene, found


def matrix(node: Mapping[str, Any]) -> NDArray[np.float64]:
    """The transform of a node of translation, rotation and scale, (4, 4)."""
    x, y, z, w = node.get("rotation", (0.0, 0.0, 0.0, 1.0))
    turn = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
    place = np.eye(4)
    place[:3, :3], place[:3, 3] = turn * node.get("scale", (1.0, 1.0, 1.0)), node.get("translation", (0.0, 0.0, 0.0))
    return place


def places(scene: Mapping[str, Any], animated: Mapping[tuple[str, str], Any], frame: int) -> dict[str, Any]:
    """Where the nodes are in a frame."""
    parents = {child: i for i, node in enumerate(scene["nodes"]) for child in node.get("children", ())}

    def world(i: int) -> NDArray[np.float64]:
        node = scene["nodes"][i]
        moved = {path: animated[node["name"], path][frame] for path in TRS if (node["name"], path) in animated}
        above = world(parents[i]) if i in parents else np.eye(4)
        return above @ matrix({**node, **moved})

    return {node["name"]: world(i)[:3, 3] for i, node in enumerate(scene["nodes"])}


TRS = ("translation", "rotation")


def in_centimeters(path: Path) -> None:
    """Write the avatar of the package below a node that is turned and in centimeters, its hips placed by a matrix."""
    scene, data = read_binary(FEMALE)
    hips = scene["nodes"][0]
    x, y, z = hips.pop("translation")
    # Inside the node, which is turned by a quarter about x, y is -z and z is y.
    hips["matrix"] = [1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 100 * x, -100 * z, 100 * y, 1]
    for node in scene["nodes"][1:54]:
        node["translation"] = [100 * each for each in node["translation"]]
    half = 0.5**0.5
    above = {"name": "Armature", "children": [0], "rotation": [-half, 0, 0, half], "scale": [0.01, 0.01, 0.01]}
    scene["nodes"][-1]["children"].remove(0)
    scene["scenes"][0]["nodes"].append(len(scene["nodes"]))
    scene["nodes"].append(above)
    scene["animations"] = [{"channels": [], "samplers": []}]
    write_binary(path, scene, data)


@pytest.mark.parametrize("make", [lambda path: path.write_bytes(FEMALE.read_bytes()), in_centimeters])
def test_bones_and_morph_targets_are_where_those_of_the_frames_are(
    bml: Callable[..., str], tmp_path: Path, make: Callable[[Path], object]
) -> None:
    (tmp_path / "avatars").mkdir()
    make(tmp_path / "avatars" / "anna.glb")
    human, glb, npz = tmp_path / "human.toml", tmp_path / "out.glb", tmp_path / "out.npz"
    human.write_text('[character.alice]\navatar = "avatars/anna.glb"\nposition = [1.0, 0.0, 0.5]\nheading = 30\n')
    files = ["--human", str(human), "--assets", str(tmp_path), "--glb", str(glb), "--frames", str(npz)]
    assert main(["realize", bml(PLAYED), "--voice", "text", *files]) == 0
    frames, (scene, animated) = np.load(npz), performance(glb)
    assert animated["", "time"][:, 0] == pytest.approx(frames["time"], abs=1e-6)
    skeleton = Avatar.read(glb).skeleton
    assert list(frames["joints"]) == list(skeleton.joints)
    for frame in (0, 40, 80):
        turns = {joint: tuple(turn) for joint, turn in zip(skeleton.joints, frames["rotations"][frame], strict=True)}
        moved = frames["root"][frame] - np.array(skeleton.offset("HumanoidRoot"))
        body, shown = Body(skeleton, turns, tuple(moved.tolist())), places(scene, animated, frame)
        for bone, joint in (("Hips", "HumanoidRoot"), ("RightHand", "r_wrist"), ("LeftToeBase", "l_midtarsal")):
            assert shown[bone] == pytest.approx(body.transform(joint).position, abs=1e-4)
    jaw = scene["meshes"][0]["extras"]["targetNames"].index("jawOpen")
    weights = animated["Face", "weights"].reshape(len(frames["time"]), -1)
    assert weights[:, jaw] == pytest.approx(frames["weights"][:, list(frames["morphs"]).index("jawOpen")], abs=1e-6)
    assert weights[:, jaw].max() > 0.3


def test_each_of_two_characters_has_a_file(bml: Callable[..., str], tmp_path: Path, tests_data: Path) -> None:
    human = str(tests_data / "humans" / "two.toml")
    files = ["--human", human, "--glb", str(tmp_path / "out.glb"), "--until", "0.2"]
    main(["realize", bml(PLAYED), "--voice", "text", *files])
    assert sorted(file.name for file in tmp_path.glob("*.glb")) == ["out.alice.glb", "out.bob.glb"]
