"""An avatar file: its skeleton in H-Anim terms, its morph targets, and the conversion of poses to its own bones."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.embodiment.body import Skeleton
from reactive_realizer.embodiment.glb import BadAvatar, read_scene
from reactive_realizer.embodiment.joints import ROOT
from reactive_realizer.embodiment.mixamo import alignment
from reactive_realizer.embodiment.morph_targets import MorphTargets, morph_targets_of
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, angle, between, conjugate, multiply, rotate
from reactive_realizer.embodiment.rig import Bone, bones_of
from reactive_realizer.embodiment.skin_faults import skin_faults
from reactive_realizer.embodiment.vector import ZERO, Vec3, add, length, unit
from reactive_realizer.errors import RealizerError
from reactive_realizer.file_cache import remembered

SKIN_COLORS = ("skinBlush", "skinPallor")
"""Weights that color the skin, beside those of morph targets."""

_UNITS: tuple[Quat, ...] = ((1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0), (0.0, 0.0, 0.0, 1.0))
_NEEDED = (ROOT, "skullbase", "l_shoulder", "l_elbow", "l_wrist", "r_shoulder", "r_elbow", "r_wrist")
# Bones that motions aim or solve limbs with. They need a length to have a direction.
_FAR_FROM_PARENT = frozenset({"elbow", "wrist", "knee", "ankle", "index2", "index3"})
_SHORTEST = 1e-3
_IN_T_POSE = 1e-3  # rad
_COMPRESSIONS = {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_texture_basisu"}
"""Extensions of glTF for which the viewer has no decoder."""


@dataclass(frozen=True, slots=True, eq=False)
class Avatar:
    """A humanoid that rests in a T-pose or with lowered arms, whatever the axes of its bones.

    Attributes:
        bones: its hips and the bones below them, in the order of the skins' joints (glTF `skin.joints`), (B,).
        morphs: names of the weights of its face: its morph targets in the order of the file, then the colors of its
            skin.
        skeleton: in the H-Anim default pose, J joints; bones without an H-Anim joint are left out.
        path: of its file; None if it was not read from one.
        targets: of its file.
        notes: what of its file is left out or cannot be shown, as sentences.
    """

    bones: tuple[Bone, ...]
    morphs: tuple[str, ...]
    skeleton: Skeleton
    _bone_of_joint: NDArray[np.intp]
    _to_bones: NDArray[np.float64]
    _at_rest: NDArray[np.float64]
    path: Path | None = None
    targets: MorphTargets = field(default_factory=MorphTargets)
    notes: tuple[str, ...] = ()

    @staticmethod
    @remembered
    def read(path: Path) -> "Avatar":
        """Read the avatar of a GLB file.

        Raises:
            RealizerError: "bad-avatar": not a GLB file, no skin, missing bones, or bones without a usable rest pose.
        """
        scene = read_scene(path)
        try:
            bones, targets = bones_of(scene), morph_targets_of(scene)
        except ValueError as problem:
            raise RealizerError(BadAvatar(file=path.name, reason=str(problem))) from problem
        except (LookupError, TypeError, AttributeError) as problem:
            raise RealizerError(BadAvatar(file=path.name, reason=f"unusable skin or mesh ({problem!r})")) from problem
        avatar = Avatar.of_bones(bones, (*targets.named, *SKIN_COLORS), path.name)
        return replace(
            avatar, path=path, targets=targets, notes=(*targets.notes, *skin_faults(scene), *_unshown(scene))
        )

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
        indices = [i for i, bone in enumerate(bones) if bone.joint is not None]
        names = tuple(bone.joint for bone in bones if bone.joint is not None)
        missing = [joint for joint in _NEEDED if joint not in names]
        if missing:
            raise RealizerError(
                BadAvatar(
                    file=file,
                    reason=f"no bone for {', '.join(missing)} (known: Mixamo, VRM, Unreal, Rigify or H-Anim)",
                )
            )
        links = [_link(bones, i) for i in indices]
        parents = tuple(-1 if parent is None else names.index(parent) for parent, _ in links)
        raised = _raised(dict(zip(names, (way for _, way in links), strict=True)))
        turns = {joint: multiply(alignment(joint), _with_arm(raised, joint)) for joint in names}
        above = [IDENTITY if parent is None else turns[parent] for parent, _ in links]
        offsets = tuple(rotate(turn, way) for turn, (_, way) in zip(above, links, strict=True))
        _check_lengths(dict(zip(names, offsets, strict=True)), file)
        return cls(
            tuple(bones),
            tuple(morphs),
            Skeleton(names, parents, offsets),
            np.array(indices),
            np.array(
                [
                    _sandwich(conjugate(multiply(turn, bones[i].above)), multiply(turns[joint], bones[i].turn))
                    for turn, i, joint in zip(above, indices, names, strict=True)
                ]
            ),
            np.array([bone.rotation for bone in bones]),
        )

    def rest_position(self, joint: str) -> Vec3 | None:
        """Return the position of a joint at rest, in the figure's frame, m; None if it has no such joint."""
        index = next((i for i, bone in enumerate(self.bones) if bone.joint == joint), -1)
        if index < 0:
            return None
        position = ZERO
        while index >= 0:
            position = add(self.bones[index].translation, position)
            index = self.bones[index].parent
        return position

    def bone_rotations(self, rotations: NDArray[np.float64]) -> NDArray[np.float64]:
        """Convert a pose to the avatar's own bones.

        With G the rotations in the figure's axes, W the orientations at rest and A the turns from the rest pose to the
        default pose, a bone is at G_j A_j W_j. Local to the node q above it, which moves with the joint p, that is
        (A_p W_q)^-1 (G_p^-1 G_j) (A_j W_j): the local rotation of the pose between two constants.

        Args:
            rotations: (J, 4) H-Anim pose, w x y z local to the parent, in the order of the skeleton.

        Returns:
            (B, 4) w x y z local to the parent bone, in the order of `bones`; bones without a joint are at rest.
        """
        out = self._at_rest.copy()
        out[self._bone_of_joint] = np.einsum("jab,jb->ja", self._to_bones, rotations)
        return out


def _unshown(scene: Mapping[str, Any]) -> Iterator[str]:
    needed = set(map(str, scene.get("extensionsRequired") or ())) & _COMPRESSIONS
    if needed:
        yield f"the page cannot show it, because it is compressed with {', '.join(sorted(needed))}; export it without"


def _link(bones: Sequence[Bone], index: int) -> tuple[str | None, Vec3]:
    """Return the nearest ancestor of a bone that is a joint, and the offset from there at rest."""
    way = bones[index].translation
    index = bones[index].parent
    while index >= 0 and bones[index].joint is None:
        way = add(bones[index].translation, way)
        index = bones[index].parent
    return (bones[index].joint if index >= 0 else None), way


def _raised(ways: Mapping[str, Vec3]) -> dict[str, Quat]:
    """Return the turns that raise the arms to the T-pose, for upper arms and forearms.

    Args:
        ways: joint -> offset from the joint above it, at rest.
    """
    turns = {}
    for side, outward in (("l", (1.0, 0.0, 0.0)), ("r", (-1.0, 0.0, 0.0))):
        for joint, end in ((f"{side}_shoulder", f"{side}_elbow"), (f"{side}_elbow", f"{side}_wrist")):
            way = ways[end]
            if math.isfinite(length(way)) and length(way) > _SHORTEST:
                turn = between(unit(way), outward)
                turns[joint] = turn if angle(turn) > _IN_T_POSE else IDENTITY
    return turns


def _with_arm(raised: Mapping[str, Quat], joint: str) -> Quat:
    """Return the turn of a joint to the T-pose. A hand is straight with its forearm."""
    if joint in raised or alignment(joint) == IDENTITY:
        return raised.get(joint, IDENTITY)
    return raised.get(f"{joint[0]}_elbow", IDENTITY)


def _check_lengths(offsets: Mapping[str, Vec3], file: str) -> None:
    for joint, offset in offsets.items():
        far = length(offset)
        if not math.isfinite(far) or (joint[2:] in _FAR_FROM_PARENT and far < _SHORTEST):
            raise RealizerError(BadAvatar(file=file, reason=f"{joint} is {far:g} m from the joint above"))


def _sandwich(before: Quat, after: Quat) -> NDArray[np.float64]:
    """Return the matrix that maps a quaternion q to before q after, (4, 4); the product is linear in each factor."""
    return np.array([multiply(multiply(before, unit), after) for unit in _UNITS]).T
