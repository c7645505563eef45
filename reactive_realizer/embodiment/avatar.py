"""An avatar file: its skeleton in H-Anim terms, its morph targets, and the conversion of poses to its own bones."""

import json
import math
import struct
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.embodiment.body import Skeleton
from reactive_realizer.embodiment.joints import ROOT
from reactive_realizer.embodiment.mixamo import JOINTS, alignment
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, conjugate, multiply, rotate
from reactive_realizer.embodiment.vector import ZERO, Vec3, add, length
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.file_cache import remembered

_HEADER = struct.Struct("<4sII")
_CHUNK = struct.Struct("<I4s")
_MOST_BONES = 1_000
_LONGEST_SCENE = 16 * 1024 * 1024
"""Size limit of the JSON chunk, bytes. That of a detailed avatar has less than one MiB."""


def read_glb(path: Path) -> dict[str, Any]:
    """Read the scene description of a binary glTF 2.0 file: its JSON chunk (Khronos, chapter "Binary glTF Layout").

    Meshes and images are not read.

    Raises:
        RealizerError: "bad-avatar": the file is not binary glTF 2.
    """
    with path.open("rb") as file:
        header = file.read(_HEADER.size + _CHUNK.size)
        if len(header) < _HEADER.size + _CHUNK.size:
            raise RealizerError(BadAvatar(file=path.name, reason="too short for a GLB file"))
        magic, version, size = _HEADER.unpack_from(header)
        length, kind = _CHUNK.unpack_from(header, _HEADER.size)
        if magic != b"glTF" or version != 2 or kind != b"JSON" or length > size:
            raise RealizerError(BadAvatar(file=path.name, reason="not a binary glTF 2 file"))
        if length > _LONGEST_SCENE:
            raise RealizerError(BadAvatar(file=path.name, reason=f"its JSON chunk is over {_LONGEST_SCENE} bytes"))
        text = file.read(length)
    try:
        scene = json.loads(text)
    except (ValueError, RecursionError) as problem:
        raise RealizerError(BadAvatar(file=path.name, reason=f"its JSON chunk cannot be read: {problem}")) from problem
    if not isinstance(scene, dict):
        raise RealizerError(BadAvatar(file=path.name, reason="its JSON chunk is not an object"))
    return scene


SKIN_COLORS = ("skinBlush", "skinPallor")
"""Weights that color the skin, beside those of morph targets."""

_UNITS: tuple[Quat, ...] = ((1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0), (0.0, 0.0, 0.0, 1.0))
_NEEDED = (ROOT, "skullbase", "l_shoulder", "l_elbow", "l_wrist", "r_shoulder", "r_elbow", "r_wrist")
# Bones that motions aim or solve limbs with. They need a length to have a direction.
_FAR_FROM_PARENT = frozenset({"elbow", "wrist", "knee", "ankle", "index2", "index3"})
_SHORTEST = 1e-3


class BadAvatar(Fault):
    """A GLB file that cannot be used as an avatar."""

    code = "bad-avatar"
    template = "{file} cannot be used as an avatar: {reason}"
    file: str
    reason: str


@dataclass(frozen=True, slots=True)
class Bone:
    """A bone of the avatar's skin at rest.

    Attributes:
        name: in the file.
        parent: index of the parent among the skin's bones, -1 for none.
        translation: from the parent bone, m.
    """

    name: str
    parent: int
    translation: Vec3


@dataclass(frozen=True, slots=True, eq=False)
class Avatar:
    """A humanoid with Mixamo bone names that rests in a T-pose without rotations.

    Attributes:
        bones: of its skin, in the order of the skin's joints (glTF `skin.joints`), (B,).
        morphs: names of the weights of its face: its morph targets in the order of the file, then the colors of its
            skin.
        skeleton: in the H-Anim default pose, J joints; bones without an H-Anim joint are left out.
        path: of its file; None if it was not read from one.
    """

    bones: tuple[Bone, ...]
    morphs: tuple[str, ...]
    skeleton: Skeleton
    _bone_of_joint: NDArray[np.intp]
    _to_bones: NDArray[np.float64]
    _at_rest: NDArray[np.float64]
    path: Path | None = None

    @staticmethod
    @remembered
    def read(path: Path) -> "Avatar":
        """Read the avatar of a GLB file.

        Raises:
            RealizerError: "bad-avatar": not a GLB file, no skin, missing bones, or bones with a rest rotation.
        """
        scene = read_glb(path)
        try:
            bones, morphs = tuple(_bones(scene, path.name)), (*_morphs(scene), *SKIN_COLORS)
        except (LookupError, TypeError, ValueError, AttributeError) as problem:
            raise RealizerError(BadAvatar(file=path.name, reason=f"unusable skin or mesh ({problem!r})")) from problem
        if any(_is_in_a_circle(bones, index) for index in range(len(bones))):
            raise RealizerError(BadAvatar(file=path.name, reason="a bone is its own ancestor"))
        return replace(Avatar.of_bones(bones, morphs, path.name), path=path)

    @classmethod
    def of_bones(cls, bones: Sequence[Bone], morphs: Sequence[str], file: str) -> "Avatar":
        """Return an avatar with the given bones.

        Args:
            bones: of the skin.
            morphs: names of the morph targets.
            file: its name, for messages.

        Raises:
            RealizerError: "bad-avatar": a bone is missing, or has no length but needs one.
        """
        names = tuple(JOINTS[bone.name] for bone in bones if bone.name in JOINTS)
        missing = [joint for joint in _NEEDED if joint not in names]
        if missing:
            raise RealizerError(
                BadAvatar(file=file, reason=f"no bone for {', '.join(missing)} (Mixamo names are expected)")
            )
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

    def rest_position(self, joint: str) -> Vec3 | None:
        """Return the position of a joint in the T-pose, in the figure's frame, m; None if it has no such joint."""
        index = next((i for i, bone in enumerate(self.bones) if JOINTS.get(bone.name) == joint), -1)
        if index < 0:
            return None
        position = ZERO
        while index >= 0:
            position = add(self.bones[index].translation, position)
            index = self.bones[index].parent
        return position

    def bone_rotations(self, rotations: NDArray[np.float64]) -> NDArray[np.float64]:
        """Convert a pose to the avatar's own bones.

        With G the rotations in the figure's axes, a bone is at G_j A_j. Local to its parent bone that is A_p^-1 (G_p^-1
        G_j) A_j: the local rotation of the pose between two constants.

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
    if len(joints) > _MOST_BONES:
        raise RealizerError(BadAvatar(file=file, reason=f"it has more than {_MOST_BONES} bones"))
    above = {child: i for i, node in enumerate(nodes) for child in node.get("children", ())}
    for joint in joints:
        node = nodes[joint]
        x, y, z = map(float, node.get("translation", ZERO))
        rotation = node.get("rotation", (0.0, 0.0, 0.0, 1.0))
        if "matrix" in node or max(map(abs, rotation[:3])) > 1e-4:
            raise RealizerError(
                BadAvatar(
                    file=file, reason=f"the bone {node['name']} has a rotation at rest; only translations are supported"
                )
            )
        parent = above.get(joint)
        yield Bone(node["name"].removeprefix("mixamorig:"), joints.index(parent) if parent in joints else -1, (x, y, z))


def _is_in_a_circle(bones: Sequence[Bone], index: int) -> bool:
    above = bones[index].parent
    for _ in bones:
        if above < 0:
            return False
        above = bones[above].parent
    return True


def _morphs(scene: dict[str, Any]) -> tuple[str, ...]:
    for mesh in scene["meshes"]:
        names = mesh.get("extras", {}).get("targetNames")
        if names:
            return tuple(map(str, names))
    return ()


def _link(bones: Sequence[Bone], index: int) -> tuple[str | None, Vec3]:
    """Return the nearest ancestor of a bone that is a joint, and the offset from there in the T-pose."""
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
            raise RealizerError(BadAvatar(file=file, reason=f"{joint} is {far:g} m from the joint above"))


def _alignment_of(joint: str | None) -> Quat:
    return IDENTITY if joint is None else alignment(joint)


def _sandwich(before: Quat, after: Quat) -> NDArray[np.float64]:
    """Return the matrix that maps a quaternion q to before q after, (4, 4); the product is linear in each factor."""
    return np.array([multiply(multiply(before, unit), after) for unit in _UNITS]).T
