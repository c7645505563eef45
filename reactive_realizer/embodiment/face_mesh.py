"""The shape of an avatar's face: where its vertices are, and where its morph targets move them."""

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.embodiment.glb import BadAvatar, read_binary
from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.errors import RealizerError

_TYPES = {5121: "u1", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
"""Component types of glTF 2.0 (chapter "Accessor Data Types") that positions and their indices use."""


@dataclass(frozen=True, slots=True, eq=False)
class FaceMesh:
    """The vertices of all meshes with morph targets.

    Attributes:
        vertices: (V, 3) positions at rest in the figure's frame, m.
        moves: morph target -> (V, 3) displacements at weight 1, m.
    """

    vertices: NDArray[np.float64]
    moves: Mapping[str, NDArray[np.float64]]

    @classmethod
    def read(cls, path: Path) -> Self:
        """Read the face of an avatar.

        Raises:
            RealizerError: "bad-avatar": it has no morph targets, or its meshes are compressed.
        """
        try:
            return cls._of(_Accessors(path))
        except (LookupError, TypeError, ValueError) as problem:
            raise RealizerError(BadAvatar(file=path.name, reason=f"unreadable face ({problem!r})")) from problem

    @classmethod
    def _of(cls, accessors: "_Accessors") -> Self:
        vertices: list[NDArray[np.float64]] = []
        moves: defaultdict[str, dict[int, NDArray[np.float64]]] = defaultdict(dict)
        for names, parts in accessors.faces():
            for part in parts:
                for name, target in zip(names, part["targets"], strict=True):
                    moves[name][len(vertices)] = accessors.positions(target)
                vertices.append(accessors.positions(part["attributes"]))
        if not vertices:
            raise ValueError("no morph targets")
        still = [np.zeros_like(each) for each in vertices]
        return cls(
            np.concatenate(vertices),
            {
                name: np.concatenate([own.get(number, each) for number, each in enumerate(still)])
                for name, own in moves.items()
            },
        )

    def displacement(self, weights: Mapping[str, float]) -> NDArray[np.float64]:
        """Return the displacement of each vertex at weights of morph targets, (V, 3), m.

        Raises:
            KeyError: there is no such morph target.
        """
        moved = np.zeros_like(self.vertices)
        for morph, weight in weights.items():
            moved += weight * self.moves[morph]
        return moved

    def furthest(self, weights: Mapping[str, float], direction: Vec3) -> int:
        """Return the index of the vertex that weights of morph targets move furthest in a direction, a unit vector.

        Raises:
            KeyError: there is no such morph target.
        """
        return int((self.displacement(weights) @ np.array(direction)).argmax())


class _Accessors:
    """The arrays of a GLB file."""

    def __init__(self, path: Path) -> None:
        self._scene, self._data = read_binary(path)

    def faces(self) -> Iterator[tuple[Sequence[str], Sequence[dict[str, Any]]]]:
        """Yield the meshes with morph targets: names of the targets, and parts."""
        for mesh in self._scene["meshes"]:
            names = mesh.get("extras", {}).get("targetNames")
            if names:
                yield names, mesh["primitives"]

    def positions(self, attributes: Mapping[str, int]) -> NDArray[np.float64]:
        """Return the positions, (V, 3), among attributes of a part, or their displacements by a target."""
        accessor = self._scene["accessors"][attributes["POSITION"]]
        count = accessor["count"]
        found = np.zeros((count, 3))
        if "bufferView" in accessor:
            found[:] = self._view(accessor, accessor["componentType"], 3 * count).reshape(count, 3)
        if (sparse := accessor.get("sparse")) is not None:
            changed, indices, values = sparse["count"], sparse["indices"], sparse["values"]
            rows = self._view(indices, indices["componentType"], changed)
            found[rows] = self._view(values, accessor["componentType"], 3 * changed).reshape(changed, 3)
        return found

    def _view(self, part: Mapping[str, Any], kind: int, count: int) -> NDArray[Any]:
        view = self._scene["bufferViews"][part["bufferView"]]
        start = view.get("byteOffset", 0) + part.get("byteOffset", 0)
        return np.frombuffer(self._data, _TYPES[kind], count, start)
