"""The shape of an avatar's face: where its vertices are, and where its morph targets move them."""

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.embodiment.glb import BadAvatar
from reactive_realizer.embodiment.glb_arrays import GlbArrays
from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.errors import RealizerError


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
            return cls._of(GlbArrays(path))
        except (LookupError, TypeError, ValueError) as problem:
            raise RealizerError(BadAvatar(file=path.name, reason=f"unreadable face ({problem!r})")) from problem

    @classmethod
    def _of(cls, arrays: GlbArrays) -> Self:
        vertices: list[NDArray[np.float64]] = []
        moves: defaultdict[str, dict[int, NDArray[np.float64]]] = defaultdict(dict)
        for names, parts in _faces(arrays.scene):
            for part in parts:
                for name, target in zip(names, part["targets"], strict=True):
                    moves[name][len(vertices)] = arrays[target["POSITION"]].astype(float)
                vertices.append(arrays[part["attributes"]["POSITION"]].astype(float))
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


def _faces(scene: Mapping[str, Any]) -> Iterator[tuple[Sequence[str], Sequence[dict[str, Any]]]]:
    """Yield the meshes with morph targets: names of the targets, and parts."""
    for mesh in scene["meshes"]:
        names = mesh.get("extras", {}).get("targetNames")
        if names:
            yield names, mesh["primitives"]
