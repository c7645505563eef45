"""Finds the humanoid in the nodes of a glTF scene: which bone is which joint, and where bones are at rest."""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.embodiment.joints import ROOT
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, from_axis_angle, multiply, normalize, rotate
from reactive_realizer.embodiment.rig_names import VRM_0_JOINTS, VRM_1_JOINTS, joint_named
from reactive_realizer.embodiment.vector import UP, ZERO, Vec3, subtract

_MOST_BONES = 1_000
_UNEVEN = 0.01
_LOWEST_HEAD, _HIGHEST_HEAD = 0.2, 4.0
_FARTHEST = 1_000.0
"""Distance of a bone from the origin at rest up to which it is used, m."""

_AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
_TO_LEFT = (("l_shoulder", "r_shoulder"), ("l_hip", "r_hip"))


@dataclass(frozen=True, slots=True)
class Bone:
    """A bone of the avatar at rest, in the figure's axes unless stated.

    Attributes:
        name: in the file.
        parent: index of the parent among the bones, -1 for none.
        translation: from the parent bone, m.
        joint: its H-Anim joint; None if it has none.
        turn: its orientation.
        above: orientation of the node above it; for the topmost bone, in the axes of the file.
        rotation: local to the node above it.
        node: index in the file, -1 for none.
    """

    name: str
    parent: int
    translation: Vec3
    joint: str | None = None
    turn: Quat = IDENTITY
    above: Quat = IDENTITY
    rotation: Quat = IDENTITY
    node: int = -1


def place_above(scene: Mapping[str, Any], node: int) -> NDArray[np.float64]:
    """Return the transform from the axes of the node above a bone to those of the file, (4, 4).

    Raises:
        ValueError, LookupError, TypeError, AttributeError: as for `bones_of`.
    """
    return _Rig(scene).place_above(node)


def bone_places(scene: Mapping[str, Any]) -> dict[int, NDArray[np.float64]]:
    """Return the transforms from the axes of bones, by node, to the figure's frame at rest, (4, 4) each.

    Raises:
        ValueError, LookupError, TypeError, AttributeError: as for `bones_of`.
    """
    return _Rig(scene).places()


def bones_of(scene: Mapping[str, Any]) -> list[Bone]:
    """Return the bones of the humanoid in a scene: its hips, and the bones of all skins below them.

    Joints are found by the VRM humanoid of the file, if it has one; those that it does not name, by the names of bones.
    A figure that faces another way than +z is turned by quarters.

    Raises:
        ValueError: the figure cannot be used; the message says why.
        LookupError, TypeError, AttributeError: the scene is not valid glTF.
    """
    return _Rig(scene).bones()


class _Rig:
    """The nodes of a scene at rest, in the axes of the file."""

    def __init__(self, scene: Mapping[str, Any]) -> None:
        if not scene.get("skins"):
            raise ValueError("it has no skin, so no bones move it")
        self._nodes = scene["nodes"]
        self._parents = _parents(self._nodes)
        skinned = dict.fromkeys(joint for skin in scene["skins"] for joint in skin["joints"])
        if sum(len(skin["joints"]) for skin in scene["skins"][:1]) > _MOST_BONES or len(skinned) > _MOST_BONES:
            raise ValueError(f"it has more than {_MOST_BONES} bones")
        humanoid = _vrm_joints(scene)
        self._joints = {**self._named(node for node in skinned if node not in humanoid.values()), **humanoid}
        self._candidates = tuple(dict.fromkeys((*skinned, *self._joints.values())))
        if not all(0 <= node < len(self._nodes) for node in self._candidates):
            raise ValueError("it has a bone that is none of its nodes")
        self._places = {node: self._place(node) for each in self._candidates for node in self._line(each)}

    def bones(self) -> list[Bone]:
        """Return the bones; each comes after its parent."""
        hips = self._joints.get(ROOT)
        below = [node for node in self._candidates if hips is None or hips in self._line(node)]
        nodes = [*dict.fromkeys(each for node in below for each in reversed(self._line(node)) if each in below)]
        joints, facing = {node: joint for joint, node in self._joints.items()}, self._facing()
        return [self._bone(node, nodes, joints.get(node), facing) for node in nodes]

    def _bone(self, node: int, nodes: list[int], joint: str | None, facing: Quat) -> Bone:
        _, *above = self._line(node)
        parent = next((each for each in above if each in nodes), None)
        start = ZERO if parent is None else self._position(parent)
        held = self._turn(above[0]) if above else IDENTITY
        return Bone(
            self._name(node),
            -1 if parent is None else nodes.index(parent),
            rotate(facing, subtract(self._position(node), start)),
            joint,
            multiply(facing, self._turn(node)),
            held if parent is None else multiply(facing, held),
            self._rotation(_local(self._nodes[node]), node),
            node,
        )

    def place_above(self, node: int) -> NDArray[np.float64]:
        """Return the transform of the node above a bone."""
        _, *above = self._line(node)
        return self._places[above[0]] if above else np.eye(4)

    def places(self) -> dict[int, NDArray[np.float64]]:
        """Return the transforms from the axes of the nodes to the figure's frame."""
        facing = np.eye(4)
        facing[:3, :3] = np.array([rotate(self._facing(), axis) for axis in _AXES]).T
        return {node: facing @ place for node, place in self._places.items()}

    def _named(self, nodes: Iterable[int]) -> dict[str, int]:
        found: dict[str, int] = {}
        for node in nodes:
            joint = joint_named(self._name(node))
            if joint is not None:
                found.setdefault(joint, node)
        return found

    def _name(self, node: int) -> str:
        return str(self._nodes[node].get("name", f"node {node}"))

    def _line(self, node: int) -> list[int]:
        """Return a node and its ancestors, the nearest first."""
        line = [node]
        while (above := self._parents.get(line[-1])) is not None:
            if above in line:
                raise ValueError("a bone is its own ancestor")
            line.append(above)
        return line

    def _place(self, node: int) -> NDArray[np.float64]:
        place = np.eye(4)
        for each in self._line(node):
            if not any(self._nodes[each].get("rotation", (1.0,))):
                raise ValueError(f"the bone {self._name(each)} is nowhere at rest: its rotation is zero")
            place = _local(self._nodes[each]) @ place
        if not np.isfinite(place).all():
            raise ValueError(f"the bone {self._name(node)} is nowhere at rest: its transform is not finite")
        if (far := float(np.abs(place[:3, 3]).max())) > _FARTHEST:
            raise ValueError(f"the bone {self._name(node)} is {far:.3g} m away from the origin, over {_FARTHEST:g} m")
        return place

    def _position(self, node: int) -> Vec3:
        x, y, z = self._places[node][:3, 3].tolist()
        return x, y, z

    def _turn(self, node: int) -> Quat:
        return self._rotation(self._places[node], node)

    def _rotation(self, place: NDArray[np.float64], node: int) -> Quat:
        sizes = np.linalg.norm(place[:3, :3], axis=0)
        if sizes.min() <= 0.0 or sizes.max() > (1.0 + _UNEVEN) * sizes.min() or np.linalg.det(place[:3, :3]) < 0.0:
            raise ValueError(f"the bone {self._name(node)} is scaled unevenly or mirrored")
        return _quaternion(place[:3, :3] / sizes)

    def _facing(self) -> Quat:
        """Return the turn by quarters, about the vertical, after which the figure faces +z."""
        if ROOT in self._joints and "skullbase" in self._joints:
            x, y, z = subtract(self._position(self._joints["skullbase"]), self._position(self._joints[ROOT]))
            if not _LOWEST_HEAD <= y <= _HIGHEST_HEAD or math.hypot(x, z) > y:
                raise ValueError(f"its head is {y:.3g} m above its hips; it must stand upright, y up, in meters")
        for left, right in _TO_LEFT:
            if left in self._joints and right in self._joints:
                x, _, z = subtract(self._position(self._joints[left]), self._position(self._joints[right]))
                quarters = round(math.atan2(z, x) / (0.5 * math.pi))
                return from_axis_angle(UP, quarters * 0.5 * math.pi) if quarters else IDENTITY
        return IDENTITY


def _parents(nodes: Sequence[Mapping[str, Any]]) -> dict[int, int]:
    """Return the node above each node that has one."""
    parents: dict[int, int] = {}
    for number, node in enumerate(nodes):
        for child in node.get("children", ()):
            if not 0 <= child < len(nodes):
                raise ValueError(f"the node {number} has a child, {child}, that does not exist")
            if child in parents:
                raise ValueError(f"the node {child} has two nodes above it, {parents[child]} and {number}")
            parents[child] = number
    return parents


def _vrm_joints(scene: Mapping[str, Any]) -> dict[str, int]:
    """Return the joints that a VRM file names: `VRMC_vrm` of version 1, `VRM` of version 0; none in other files."""
    extensions = scene.get("extensions", {})
    if "VRMC_vrm" in extensions:
        bones = extensions["VRMC_vrm"]["humanoid"]["humanBones"]
        return {VRM_1_JOINTS[name]: int(bone["node"]) for name, bone in bones.items() if name in VRM_1_JOINTS}
    if "VRM" in extensions:
        bones = {bone["bone"]: bone for bone in extensions["VRM"]["humanoid"]["humanBones"]}
        return {VRM_0_JOINTS[name]: int(bone["node"]) for name, bone in bones.items() if name in VRM_0_JOINTS}
    return {}


def _local(node: Mapping[str, Any]) -> NDArray[np.float64]:
    """Return the transform of a node, (4, 4): its matrix, stored by columns, or translation, rotation and scale."""
    if "matrix" in node:
        return np.array(node["matrix"], float).reshape(4, 4).T
    x, y, z, w = map(float, node.get("rotation", (0.0, 0.0, 0.0, 1.0)))
    turn = normalize((w, x, y, z))
    place = np.eye(4)
    sizes = map(float, node.get("scale", (1.0, 1.0, 1.0)))
    place[:3, :3] = np.array([rotate(turn, axis) for axis in _AXES]).T * list(sizes)
    place[:3, 3] = node.get("translation", ZERO)
    return place


def _quaternion(m: NDArray[np.float64]) -> Quat:
    """Return the rotation of a matrix: the eigenvector of Bar-Itzhack's symmetric matrix (doi:10.2514/2.4654)."""
    if np.array_equal(m, np.eye(3)):
        return IDENTITY
    k = np.array(
        [
            [m[0, 0] + m[1, 1] + m[2, 2], m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]],
            [0.0, m[0, 0] - m[1, 1] - m[2, 2], m[0, 1] + m[1, 0], m[0, 2] + m[2, 0]],
            [0.0, 0.0, m[1, 1] - m[0, 0] - m[2, 2], m[1, 2] + m[2, 1]],
            [0.0, 0.0, 0.0, m[2, 2] - m[0, 0] - m[1, 1]],
        ]
    )
    w, x, y, z = np.linalg.eigh(k, UPLO="U")[1][:, -1].tolist()
    return normalize((w, x, y, z))
