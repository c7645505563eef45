"""The skeleton: Mixamo joints and two eyes, brought into a T-pose in which every joint is a pure translation."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from reactive_realizer.bake.numeric import Array, Indices, unit

_PREFIX = "mixamorig:"
BONES = 4
"""The most bones that move a vertex in the file."""

SIDES = (("Left", 1), ("Right", -1))
"""Name of a side, and the sign of its x."""

_RIGID_TO_HEAD = ("teeth", "tongue", "eyelashes", "hair")


@dataclass(frozen=True, slots=True)
class Rig:
    """Joints with names, a parent and a place.

    Attributes:
        parents: parent by joint, None for the root; parents come first.
        places: (3,) m by joint.
    """

    parents: Mapping[str, str | None]
    places: Mapping[str, Array]

    @property
    def names(self) -> list[str]:
        """The joints; weights and poses follow this order."""
        return list(self.parents)

    def index(self, joint: str) -> int:
        """Its place in that order."""
        return self.names.index(joint)

    def columns(self, *parts: str) -> list[int]:
        """The joints whose names contain one of the parts."""
        return [i for i, name in enumerate(self.parents) if any(part in name for part in parts)]


def eye_group(side: str) -> str:
    """The vertex group of the eyeball of a side."""
    return f"helper-{side[0].lower()}-eye"


def read_rig(bones: Mapping[str, Mapping[str, Any]], positions: Array, groups: Mapping[str, Indices]) -> Rig:
    """Joints where the vertices of this body put them, and an eye joint in the middle of each eyeball.

    Args:
        bones: the rig file.
        positions: (v, 3) m.
        groups: vertex indices by group.
    """
    parents: dict[str, str | None] = {}
    places: dict[str, Array] = {}

    def add_children(parent: str) -> None:
        for name, bone in bones.items():
            if bone["parent"] == parent:
                joint = name.removeprefix(_PREFIX)
                parents[joint] = parent.removeprefix(_PREFIX) or None
                places[joint] = _head_of(bone["head"], positions, groups)
                add_children(name)

    add_children("")
    for side, _ in SIDES:
        eye = positions[groups[eye_group(side)]]
        parents[side + "Eye"] = "Head"
        places[side + "Eye"] = (eye.min(0) + eye.max(0)) / 2
    return Rig(parents, places)


def _head_of(end: Mapping[str, Any], positions: Array, groups: Mapping[str, Indices]) -> Array:
    match end["strategy"]:
        case "VERTEX":
            return positions[end["vertex_index"]]
        case "MEAN":
            return positions[end["vertex_indices"]].mean(0)
        case _:
            return positions[groups[end["cube_name"]]].mean(0)


def bind(
    rig: Rig, weights: Mapping[str, list[tuple[int, float]]], groups: Mapping[str, Indices], vertices: int
) -> Array:
    """Bone weights (vertices, joints): those of the file; what is in the mouth follows the head, an eyeball its eye."""
    bound = np.zeros((vertices, len(rig.names)))
    for bone, pairs in weights.items():
        column = rig.index(bone.removeprefix(_PREFIX))
        for vertex, weight in pairs:
            bound[vertex, column] = weight
    rigid = {name: "Head" for name in groups if any(part in name for part in _RIGID_TO_HEAD)}
    rigid |= {eye_group(side): side + "Eye" for side, _ in SIDES}
    for group, joint in rigid.items():
        bound[groups[group]] = 0
        bound[groups[group], rig.index(joint)] = 1
    bound[bound.sum(1) == 0, rig.index("Hips")] = 1
    bound /= bound.sum(1, keepdims=True)
    return bound


def t_pose(rig: Rig) -> tuple[Rig, Array, Array]:
    """The rig with its arms along x, and the motion of each joint to this pose.

    Returns:
        The posed rig, rotations (joints, 3, 3) and translations (joints, 3). Bound again in this pose, no joint is
        turned at rest.
    """
    rotations = _arm_rotations(rig)
    places: dict[str, Array] = {}
    for joint, parent in rig.parents.items():
        if parent is None:
            places[joint] = rig.places[joint]
        else:
            places[joint] = places[parent] + rotations[parent] @ (rig.places[joint] - rig.places[parent])
    turned = np.array([rotations[joint] for joint in rig.names])
    moved = np.array([places[joint] - rotations[joint] @ rig.places[joint] for joint in rig.names])
    return Rig(rig.parents, places), turned, moved


def _arm_rotations(rig: Rig) -> dict[str, Array]:
    rotations = {joint: np.eye(3) for joint in rig.names}
    for side, sign in SIDES:
        outward = np.array([sign, 0, 0.0])
        for start, end in (("Arm", "ForeArm"), ("ForeArm", "Hand"), ("Hand", "HandMiddle1")):
            rotations[side + start] = _rotation(rig.places[side + end] - rig.places[side + start], outward)
        for joint in rig.names:
            if joint.startswith(side + "Hand"):
                rotations[joint] = rotations[side + "Hand"]
    return rotations


def _rotation(source: Array, target: Array) -> Array:
    """The shortest rotation from one direction to another (Rodrigues)."""
    a, b = unit(source), unit(target)
    v = np.cross(a, b)
    k = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
    return np.eye(3) + k + k @ k / (1 + a @ b)
