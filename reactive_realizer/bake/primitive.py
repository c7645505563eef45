"""From meshes to glTF primitives: welded vertices, four bones each, blend shapes."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from reactive_realizer.bake.body import Body
from reactive_realizer.bake.glb import INDICES, VERTICES, Glb, Json
from reactive_realizer.bake.mesh import Mesh, vertex_normals
from reactive_realizer.bake.numeric import Array, Indices, unit
from reactive_realizer.bake.rig import BONES

_SMALLEST_MOVE = 4e-5
"""Vertices that a blend shape moves less are left out, m."""

_SHADED = (
    # blend shapes that bend the skin so much that its shading has to follow
    "mouthSmile",
    "mouthFrown",
    "cheek",
    "brow",
    "noseSneer",
    "mouthPucker",
    "mouthFunnel",
    "jawOpen",
    "eyeBlink",
    "viseme_",
)
_SMALLEST_TURN = 0.06
_TURN = 0.65
"""Share of the turn of the normals that is used; all of it looks like folded paper."""


@dataclass(frozen=True, slots=True)
class Part:
    """A mesh with one material.

    Attributes:
        name: for people.
        mesh: in the T-pose.
        normals: (v, 3) of its vertices.
        material: name.
        moves: (v, 3) m by blend shape; None where its vertices are those of the base mesh.
    """

    name: str
    mesh: Mesh
    normals: Array
    material: str
    moves: Mapping[str, Array] | None = None


@dataclass(frozen=True, slots=True)
class _Welded:
    """Vertices of which each has one texture coordinate; `source` says which vertex of the mesh each came from."""

    source: Indices
    uvs: Array
    indices: Indices


def _weld(mesh: Mesh) -> _Welded:
    quantized = np.round(mesh.uvs.reshape(-1, 2) * 65536).astype(int)
    corners = np.concatenate([mesh.triangles.reshape(-1, 1), quantized], 1)
    keys, first, inverse = np.unique(corners, axis=0, return_index=True, return_inverse=True)
    return _Welded(keys[:, 0], mesh.uvs.reshape(-1, 2)[first].astype("f4"), inverse.reshape(-1))


class PrimitiveWriter:
    """Stores parts of a body in a file."""

    def __init__(self, glb: Glb, body: Body, materials: dict[str, Json]) -> None:
        self._glb, self._body, self._materials = glb, body, materials
        self._brightest: dict[str, Array] = {}

    def write(self, part: Part) -> Json:
        """A primitive without blend shapes. The brightest color of its first mesh is a factor of a material."""
        return self._write(part, _weld(part.mesh))

    def write_face(self, part: Part, *, shaded: bool) -> Json:
        """A primitive with its blend shapes; shaded turns normals too, if its vertices are those of the base mesh."""
        welded = _weld(part.mesh)
        return self._write(part, welded) | {"targets": self._targets(part, welded.source, shaded)}

    def _write(self, part: Part, welded: _Welded) -> Json:
        mesh, source = part.mesh, welded.source
        if len(source) > np.iinfo(np.uint16).max:
            raise ValueError(f"{part.name} has {len(source)} vertices: too many for 16-bit indices")
        bones, shares = _strongest_bones(mesh.weights[source])
        normals = unit(part.normals[source].astype("f4"))
        attributes = {
            "POSITION": self._glb.accessor(mesh.positions[source].astype("f4"), VERTICES, bounds=True),
            "NORMAL": self._glb.accessor(normals.astype("f4"), VERTICES),
            "TEXCOORD_0": self._uvs(welded.uvs),
            "JOINTS_0": self._glb.accessor(bones.astype("u1"), VERTICES),
            "WEIGHTS_0": self._glb.accessor(shares.astype("u1"), VERTICES, normalized=True),
        }
        if mesh.colors is not None:
            attributes["COLOR_0"] = self._colors(mesh.colors, source, part.material)
        indices = self._glb.accessor(welded.indices.astype("u2"), INDICES)
        return {"attributes": attributes, "indices": indices, "material": list(self._materials).index(part.material)}

    def _uvs(self, uvs: Array) -> int:
        if uvs.min() >= 0 and uvs.max() <= 1:
            return self._glb.accessor(np.round(uvs * 65535).astype("u2"), VERTICES, normalized=True)
        return self._glb.accessor(uvs, VERTICES)

    def _colors(self, colors: Array, source: Indices, material: str) -> int:
        brightest = self._brightest.setdefault(material, np.maximum(colors.max(0), 1e-4))
        factor = [*brightest.tolist(), 1.0]
        self._materials[material]["pbrMetallicRoughness"]["baseColorFactor"] = factor
        relative = np.c_[np.round(np.minimum(colors[source] / brightest, 1) * 255), np.full(len(source), 255)]
        return self._glb.accessor(relative.astype("u1"), VERTICES, normalized=True)

    def _targets(self, part: Part, source: Indices, shaded: bool) -> list[Json]:
        nothing: int | None = None
        targets = []
        for name in self._body.shapes if part.moves is None else part.moves:
            moves = (self._body.moved(name) if part.moves is None else part.moves[name])[source]
            moving = np.abs(moves).max() > _SMALLEST_MOVE
            position = self._glb.sparse(moves, _SMALLEST_MOVE) if moving else None
            turns = self._turns(name)[source] if moving and shaded and name.startswith(_SHADED) else None
            normal = None if turns is None or not turns.any() else self._glb.sparse(turns, 0.0)
            if nothing is None and (position is None or normal is None):
                nothing = self._glb.zeros(len(source))
            position, normal = (nothing if accessor is None else accessor for accessor in (position, normal))
            targets.append({"POSITION": position, "NORMAL": normal})
        return targets

    def _turns(self, name: str) -> Array:
        """The changes of the normals (v, 3) by a blend shape; small ones are left out."""
        body = self._body
        turns = _TURN * (vertex_normals(body.positions + body.moved(name), body.triangles) - body.normals)
        return turns * (np.abs(turns).max(1) > _SMALLEST_TURN)[:, None]


def _strongest_bones(weights: Array) -> tuple[Indices, Indices]:
    """The four strongest bones of each vertex and their shares of 255."""
    bones = np.argsort(-weights, 1, kind="stable")[:, :BONES]
    strongest = np.take_along_axis(weights, bones, 1)
    strongest /= strongest.sum(1, keepdims=True)
    shares = np.round(strongest * 255).astype(int)
    shares[:, 0] += 255 - shares.sum(1)
    return np.where(shares > 0, bones, 0), shares
