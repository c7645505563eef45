"""Motion in BVH files, read again by the reader of captures."""

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from reactive_realizer.__main__ import main
from reactive_realizer.engines.animation.keyframe.bvh_reader import read_capture
from reactive_realizer.export.bvh import euler_angles
from reactive_realizer.testing.pilot import block

WAVE = block("b", '<gesture id="g" lexeme="WAVE" end="2"/><gaze id="l" target="bluebox" influence="WAIST" start="0"/>')


def rotated(q: NDArray[np.float64], vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    w, v = q[..., :1], q[..., 1:]
    out: NDArray[np.float64] = vectors + 2.0 * np.cross(v, np.cross(v, vectors) + w * vectors)
    return out


def product(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    w = a[..., :1] * b[..., :1] - (a[..., 1:] * b[..., 1:]).sum(-1, keepdims=True)
    v = a[..., :1] * b[..., 1:] + b[..., :1] * a[..., 1:] + np.cross(a[..., 1:], b[..., 1:])
    return np.concatenate((w, v), axis=-1)


def test_the_joints_of_the_file_are_where_those_of_the_frames_are(bml: Callable[..., str], tmp_path: Path) -> None:
    bvh, npz = tmp_path / "out.bvh", tmp_path / "out.npz"
    assert main(["realize", bml(WAVE), "--voice", "text", "--bvh", str(bvh), "--frames", str(npz)]) == 0
    frames, capture = np.load(npz), read_capture(bvh)
    assert capture.joints[0].name == "HumanoidRoot"
    assert {joint.name for joint in capture.joints} == set(frames["joints"])
    assert capture.times[1] == 0.02
    assert len(capture.times) == len(frames["time"])
    turns, parents = frames["rotations"], frames["parents"]
    world, places = [turns[:, 0]], [frames["root"]]
    for i, parent in enumerate(parents[1:], 1):
        places.append(places[parent] + rotated(world[parent], frames["offsets"][i]))
        world.append(product(world[parent], turns[:, i]))
    shown = capture.rotations()
    for index, joint in enumerate(capture.joints):
        expected = places[list(frames["joints"]).index(joint.name)]
        assert np.abs(capture.positions(index, shown) - expected).max() < 1e-4


def test_each_of_two_characters_has_a_file(bml: Callable[..., str], tmp_path: Path, tests_data: Path) -> None:
    human = str(tests_data / "humans" / "two.toml")
    bvh = tmp_path / "out.bvh"
    assert main(["realize", bml(WAVE), "--voice", "text", "--human", human, "--bvh", str(bvh)]) == 0
    assert sorted(file.name for file in tmp_path.glob("*.bvh")) == ["out.alice.bvh", "out.bob.bvh"]


@pytest.mark.parametrize("tilt", [0.0, 30.0, 89.99, 90.0, -90.0])
def test_any_rotation_is_the_product_of_its_angles(tilt: float) -> None:
    z, x, y = math.radians(40.0), math.radians(tilt), math.radians(-70.0)
    turn = product(product(about(2, z), about(0, x)), about(1, y))
    back_z, back_x, back_y = np.radians(euler_angles(turn))
    back = product(product(about(2, back_z), about(0, back_x)), about(1, back_y))
    assert abs(abs(float(turn @ back)) - 1.0) < 1e-9


def about(axis: int, angle: float) -> NDArray[np.float64]:
    out = np.zeros(4)
    out[0], out[axis + 1] = math.cos(0.5 * angle), math.sin(0.5 * angle)
    return out
