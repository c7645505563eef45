"""The skin of an avatar at rest: its vertices, by the joint that each of them follows most."""

from collections import defaultdict
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.glb_arrays import GlbArrays
from reactive_realizer.embodiment.rig import bone_places

Skin = Mapping[str, NDArray[np.float64]]
"""Joint -> (V, 3) positions at rest of the vertices that follow it more than any other, in the figure's frame, m."""


def read_skin(avatar: Avatar) -> Skin:
    """Return the skin of an avatar: all meshes, with clothes and hair; none if it was not read from a file.

    Raises:
        LookupError, TypeError, ValueError: the meshes are compressed or not valid, or have vertices that are nowhere.
    """
    if avatar.path is None:
        return {}
    arrays = GlbArrays(avatar.path)
    joints = {bone.node: bone.joint for bone in avatar.bones if bone.joint is not None}
    places = bone_places(arrays.scene)
    found: defaultdict[str, list[NDArray[np.float64]]] = defaultdict(list)
    for node in arrays.scene["nodes"]:
        if "mesh" in node and "skin" in node:
            skin = arrays.scene["skins"][node["skin"]]
            for part in arrays.scene["meshes"][node["mesh"]]["primitives"]:
                _add(found, part["attributes"], arrays, skin, places, joints)
    return {joint: np.concatenate(parts) for joint, parts in found.items()}


def _add(
    found: Mapping[str, list[NDArray[np.float64]]],
    attributes: Mapping[str, int],
    arrays: GlbArrays,
    skin: Mapping[str, Any],
    places: Mapping[int, NDArray[np.float64]],
    joints: Mapping[int, str],
) -> None:
    """Add the vertices of a part of a mesh to those of their joints."""
    points = arrays[attributes["POSITION"]].astype(float)
    if not np.isfinite(points).all():
        raise ValueError("a vertex without a finite position")
    weights, bones = arrays[attributes["WEIGHTS_0"]], arrays[attributes["JOINTS_0"]]
    strongest = bones[np.arange(len(points)), weights.argmax(axis=1)]
    to_bones = arrays[skin["inverseBindMatrices"]].astype(float).reshape(-1, 4, 4).transpose(0, 2, 1)
    for bone in np.unique(strongest).tolist():
        joint = joints.get(skin["joints"][bone])
        if joint is not None:
            to_figure = (places[skin["joints"][bone]] @ to_bones[bone])[:3]
            found[joint].append(points[strongest == bone] @ to_figure[:, :3].T + to_figure[:, 3])
