"""An avatar file: its skeleton in H-Anim terms, its morph targets, and poses turned into its own bones."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.embodiment.glb import read_glb
from reactive_realizer.embodiment.joints import ROOT
from reactive_realizer.embodiment.mixamo import JOINTS, alignment
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, conjugate, multiply, rotate
from reactive_realizer.embodiment.skeleton import Skeleton
from reactive_realizer.embodiment.vector import ZERO, Vec3, add, length
from reactive_realizer.errors import error

_UNITS: tuple[Quat, ...] = ((1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0), (0.0, 0.0, 0.0, 1.0))
_NEEDED = (ROOT, "skullbase", "l_shoulder", "l_elbow", "l_wrist", "r_shoulder", "r_elbow", "r_wrist")
# The bones that motions aim with, or solve limbs by: without a length they have no direction.
_FAR_FROM_PARENT = frozenset({"elbow", "wrist", "knee", "ankle", "index2", "index3"})
_SHORTEST = 1e-3


@dataclass(frozen=True, slots=True)
class Bone:
    """A bone of the avatar's skin at rest.

    Attributes:
        name: in the file.
        parent: index of the bone above among the skin's bones, -1 for none.
        translation: from the bone above, m.
    """

    name: str
    parent: int
    translation: Vec3


@dataclass(frozen=True, slots=True, eq=False)
class Avatar:
    """A humanoid with Mixamo bone names, resting in a T-pose without rotations.

    Attributes:
        bones: of its skin, in the order of the skin's joints (glTF `skin.joints`), B of them.
        morphs: names of the face's morph targets, in the order of the file.
        skeleton: its J joints in the H-Anim default pose; bones without an H-Anim joint are left out.
    """

    bones: tuple[Bone, ...]
    morphs: tuple[str, ...]
    skeleton: Skeleton
    _bone_of_joint: NDArray[np.intp]
    _to_bones: NDArray[np.float64]
    _at_rest: NDArray[np.float64]

    @classmethod
    def read(cls, path: Path) -> "Avatar":
        """The avatar in a GLB file.

        Raises:
            RealizerError: "bad-avatar": not a GLB file, no skin, bones missing, or bones that rest rotated.
        """
        scene = read_glb(path)
        try:
            bones, morphs = tuple(_bones(scene, path.name)), _morphs(scene)
        except (KeyError, IndexError, TypeError, ValueError) as problem:
            raise error("bad-avatar", file=path.name, reason=f"unusable skin or mesh ({problem!r})") from problem
        return cls.of_bones(bones, morphs, path.name)

    @classmethod
    def of_bones(cls, bones: Sequence[Bone], morphs: Sequence[str], file: str) -> "Avatar":
        """An avatar of given bones.

        Raises:
            RealizerError: "bad-avatar": a bone is missing, or one has no length that needs one; `file` is named.
        """
        names = tuple(JOINTS[bone.name] for bone in bones if bone.name in JOINTS)
        missing = [joint for joint in _NEEDED if joint not in names]
        if missing:
            raise error("bad-avatar", file=file, reason=f"no bone for {', '.join(missing)} (Mixamo names are expected)")
        indices = [i for i, bone in enumerate(bones) if bone.name in JOINTS]
        links = [_link(bones, i) for i in indices]
        parents = tuple(-1 if parent is None else names.index(parent) for parent, _ in links)
        above = [_alignment_of(parent) for parent, _ in links]
        offsets = tuple(rotate(turn, way) for turn, (_, way) in zip(above, links, strict=True))
        _check_lengths(dict(zip(names, offsets, strict=True)), file)
        return cls(
            tuple(bones),
            tuple(morphs),
            Skeleton(names, parents, offsets),
            np.array(indices),
            np.array([_sandwich(conjugate(turn), alignment(joint)) for turn, joint in zip(above, names, strict=True)]),
            np.array([IDENTITY for _ in bones]),
        )

    def bone_rotations(self, rotations: NDArray[np.float64]) -> NDArray[np.float64]:
        """A pose in the avatar's own bones.

        With G the rotations in the figure's axes, a bone is at G_j A_j; local to its parent bone that is
        A_p^-1 (G_p^-1 G_j) A_j, the pose's own local rotation between two constants.

        Args:
            rotations: (J, 4) H-Anim pose, w x y z local to the parent, in the order of the skeleton.

        Returns:
            (B, 4) w x y z local to the parent bone, in the order of `bones`; bones without a joint are at rest.
        """
        out = self._at_rest.copy()
        out[self._bone_of_joint] = np.einsum("jab,jb->ja", self._to_bones, rotations)
        return out


def _bones(scene: dict[str, Any], file: str) -> Iterator[Bone]:
    nodes = scene["nodes"]
    joints: list[int] = scene["skins"][0]["joints"]
    above = {child: i for i, node in enumerate(nodes) for child in node.get("children", ())}
    for joint in joints:
        node = nodes[joint]
        x, y, z = map(float, node.get("translation", ZERO))
        rotation = node.get("rotation", (0.0, 0.0, 0.0, 1.0))
        if "matrix" in node or max(map(abs, rotation[:3])) > 1e-4:
            raise error(
                "bad-avatar", file=file, reason=f"bone {node['name']} rests rotated; only translations are read"
            )
        parent = above.get(joint)
        yield Bone(node["name"].removeprefix("mixamorig:"), joints.index(parent) if parent in joints else -1, (x, y, z))


def _morphs(scene: dict[str, Any]) -> tuple[str, ...]:
    for mesh in scene["meshes"]:
        names = mesh.get("extras", {}).get("targetNames")
        if names:
            return tuple(map(str, names))
    return ()


def _link(bones: Sequence[Bone], index: int) -> tuple[str | None, Vec3]:
    """The joint above a bone, over bones that are none, and the way from there in the T-pose."""
    way = bones[index].translation
    index = bones[index].parent
    while index >= 0 and bones[index].name not in JOINTS:
        way = add(bones[index].translation, way)
        index = bones[index].parent
    return (JOINTS[bones[index].name] if index >= 0 else None), way


def _check_lengths(offsets: Mapping[str, Vec3], file: str) -> None:
    for joint, offset in offsets.items():
        far = length(offset)
        if not math.isfinite(far) or (joint[2:] in _FAR_FROM_PARENT and far < _SHORTEST):
            raise error("bad-avatar", file=file, reason=f"{joint} is {far:g} m from the joint above")


def _alignment_of(joint: str | None) -> Quat:
    return IDENTITY if joint is None else alignment(joint)


def _sandwich(before: Quat, after: Quat) -> NDArray[np.float64]:
    """The matrix that takes a quaternion q to before q after: a product is linear in each factor, (4, 4)."""
    return np.array([multiply(multiply(before, unit), after) for unit in _UNITS]).T
