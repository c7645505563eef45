"""Writes avatars with their motion, as an animation of glTF 2.0 (Khronos, chapter "Animations")."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.glb import read_binary, write_binary
from reactive_realizer.embodiment.morph_targets import MorphTarget
from reactive_realizer.embodiment.rig import Bone, place_above
from reactive_realizer.export.recorded_motion import RecordedMotion, file_of

_NAME = "performance"
_FLOAT = 5126
_TYPES = {0: "SCALAR", 3: "VEC3", 4: "VEC4"}
"""Type of an accessor by the size of its elements; 0 for plain numbers."""


def write_glb(path: Path, motions: Mapping[str, RecordedMotion]) -> None:
    """Write a file for each character: its avatar, with one animation of its bones and morph targets, in the world.

    Other animations of the avatar are left out. Times are those of the session. Colors of the skin and springs have no
    place in the format.

    Raises:
        RealizerError: "bad-avatar": the file of an avatar has changed in the meantime.
    """
    for id_, motion in motions.items():
        if motion.avatar.path is None:
            raise ValueError(f"the avatar of {id_} has no file")
        scene, data = read_binary(motion.avatar.path)
        animated = _Animated(scene, data)
        animated.add(motion)
        write_binary(file_of(path, id_, len(motions)), scene, bytes(animated.data))


class _Animated:
    """A scene that gets an animation.

    Attributes:
        data: of its first buffer.
    """

    def __init__(self, scene: dict[str, Any], data: bytes) -> None:
        self._scene, self.data = scene, bytearray(data)
        self._channels: list[dict[str, Any]] = []
        self._samplers: list[dict[str, Any]] = []
        self._views, self._accessors, buffers = (
            scene.setdefault(name, []) for name in ("bufferViews", "accessors", "buffers")
        )
        if not data:  # the chunk is always the first buffer
            buffers.insert(0, {})
            for view in self._views:
                view["buffer"] += 1
        self._buffer = buffers[0]

    def add(self, motion: RecordedMotion) -> None:
        """Add the animation, if there are frames."""
        self._scene.pop("animations", None)
        if len(motion.times) == 0:
            return
        avatar, times = motion.avatar, self._array(motion.times, 0)
        accessor = self._accessors[times]
        accessor["min"], accessor["max"] = [float(motion.times[0])], [float(motion.times[-1])]
        turns = np.array([avatar.bone_rotations(rotations) for rotations in motion.rotations])
        for i, bone in enumerate(avatar.bones):
            if bone.joint is not None:
                _separate(self._scene["nodes"][bone.node], bone)
                self._channel(times, bone.node, "rotation", self._array(turns[:, i, [1, 2, 3, 0]], 4))
        root = avatar.bones[0].node
        inverse = np.linalg.inv(place_above(self._scene, root))
        self._channel(times, root, "translation", self._array(motion.roots @ inverse[:3, :3].T + inverse[:3, 3], 3))
        for node, weights in self._weights(avatar, motion.weights):
            self._channel(times, node, "weights", self._array(weights.reshape(-1), 0))
        self._scene["animations"] = [{"name": _NAME, "channels": self._channels, "samplers": self._samplers}]
        self._buffer["byteLength"] = len(self.data)

    def _weights(self, avatar: Avatar, weights: NDArray[np.float64]) -> list[tuple[int, NDArray[np.float64]]]:
        """Return the nodes that show morph targets, each with their weights, (F, T)."""
        places = {target: avatar.morphs.index(n) for n, targets in avatar.targets.named.items() for target in targets}
        sizes = [len(mesh["primitives"][0].get("targets", ())) for mesh in self._scene.get("meshes", ())]
        shown = [(i, node["mesh"]) for i, node in enumerate(self._scene["nodes"]) if sizes and "mesh" in node]
        return [
            (i, weights[:, [places[MorphTarget(mesh, k)] for k in range(sizes[mesh])]])
            for i, mesh in shown
            if sizes[mesh]
        ]

    def _channel(self, times: int, node: int, path: str, values: int) -> None:
        self._channels.append({"sampler": len(self._samplers), "target": {"node": node, "path": path}})
        self._samplers.append({"input": times, "output": values, "interpolation": "LINEAR"})

    def _array(self, values: NDArray[np.float64], size: int) -> int:
        """Append an array of elements of a size; return the index of its accessor."""
        self.data += b"\0" * (-len(self.data) % 4)
        content = values.astype("<f4").tobytes()
        self._views.append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(content)})
        self.data += content
        accessor = {"bufferView": len(self._views) - 1, "componentType": _FLOAT, "count": len(values)}
        self._accessors.append({**accessor, "type": _TYPES[size]})
        return len(self._accessors) - 1


def _separate(node: dict[str, Any], bone: Bone) -> None:
    """Write the matrix of a node as translation, rotation and scale, because only these can be animated."""
    matrix: Sequence[float] | None = node.pop("matrix", None)
    if matrix is not None:
        columns = np.array(matrix, float).reshape(4, 4)
        w, x, y, z = bone.rotation
        node |= {"translation": columns[3, :3].tolist(), "rotation": [x, y, z, w]}
        node["scale"] = np.linalg.norm(columns[:3, :3], axis=1).tolist()
