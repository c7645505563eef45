"""The face of an avatar as its morph targets deform it, and what of it can be measured."""

import json
import struct
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
Indices = NDArray[np.intp]

_TYPES = {5121: np.uint8, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
_SIZES = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
_MARGIN = 0.012
"""Height of the lips, m."""


@dataclass(frozen=True)
class Part:
    """A primitive of the mesh.

    Attributes:
        positions: (V, 3) at rest, m.
        targets: displacement of each vertex by each morph target at weight 1, (M, V, 3) m.
        triangles: (T, 3) indices of vertices.
    """

    positions: Array
    targets: Array
    triangles: Indices

    def of(self, vertices: ArrayLike) -> "Part":
        """The part with some vertices (a mask) only, and the triangles between them."""
        kept = np.asarray(vertices, bool)
        numbers = np.cumsum(kept) - 1
        triangles = numbers[self.triangles[kept[self.triangles].all(1)]]
        return Part(self.positions[kept], self.targets[:, kept], triangles)


@dataclass(frozen=True)
class FaceMesh:
    """The parts of the mesh Face.

    Attributes:
        morphs: names of the morph targets.
        skin: with the lips.
        inside: of the mouth; it shares the inner edge of the lips with the skin.
        upper_teeth, lower_teeth, tongue: as their names say.
    """

    morphs: tuple[str, ...]
    skin: Part
    inside: Part
    upper_teeth: Part
    lower_teeth: Part
    tongue: Part

    @classmethod
    def read(cls, path: Path) -> Self:
        """Reads an avatar of the package (its parts are in the order of the attributes)."""
        data = path.read_bytes()
        (size,) = struct.unpack_from("<I", data, 12)
        gltf, blob = json.loads(data[20 : 20 + size]), data[20 + size + 8 :]
        face = next(mesh for mesh in gltf["meshes"] if mesh["name"] == "Face")
        return cls(tuple(face["extras"]["targetNames"]), *(_part(gltf, blob, each) for each in face["primitives"][:5]))

    def opening(self, weights: Mapping[str, float]) -> float:
        """The greatest height of the gap between the lips that is seen from the front, m."""
        lips = self.shown(self._lips, weights)
        half = 0.97 * np.abs(self.shown(self._lip_edge, weights)[:, 0]).max()
        return _largest_gap(lips[self._lips.triangles], np.linspace(-half, half, 24))

    def lip_to_teeth(self, weights: Mapping[str, float]) -> float:
        """The distance from the edge of the lower lip to the upper teeth, m."""
        lip = self.shown(self._lower_lip, weights)
        middle = lip.mean(0)
        lip, teeth = lip - middle, self._front_teeth - middle
        # A product of matrices takes a tenth of the time of all differences.
        squares = (lip * lip).sum(1)[:, None] + (teeth * teeth).sum(1) - 2.0 * lip @ teeth.T
        return float(np.sqrt(max(0.0, squares.min())))

    @property
    def mouth(self) -> Array:
        """The middle (3,) of the lips at rest, m."""
        middle: Array = self._lip_edge.positions.mean(0)
        return middle

    def shown(self, part: Part, weights: Mapping[str, float]) -> Array:
        """The positions of a part's vertices in a face, (V, 3) m."""
        each = np.array([weights.get(morph, 0.0) for morph in self.morphs])
        return part.positions + np.tensordot(each, part.targets, 1)

    @cached_property
    def _lip_edge(self) -> Part:
        """What the skin shares with the inside of the mouth."""
        inside = {tuple(position) for position in self.inside.positions.round(6).tolist()}
        return self.skin.of([tuple(each) in inside for each in self.skin.positions.round(6).tolist()])

    @cached_property
    def _lips(self) -> Part:
        """The skin around the mouth."""
        edge, (x, y, z) = self._lip_edge.positions, self.skin.positions.T
        near = (np.abs(x) < np.abs(edge[:, 0]).max() + _MARGIN) & (z > edge[:, 2].min() - _MARGIN)
        near &= (y > edge[:, 1].min() - _MARGIN) & (y < edge[:, 1].max() + _MARGIN)
        return self.skin.of(near)

    @cached_property
    def _lower_lip(self) -> Part:
        """The skin near the middle of the mouth that the jaw takes along."""
        edge, (x, y, z) = self._lip_edge.positions, self.skin.positions.T
        taken = self.skin.targets[self.morphs.index("jawOpen"), :, 1] < -0.02
        near = (np.abs(x) < _MARGIN) & (np.abs(y - np.median(edge[:, 1])) < _MARGIN) & (z > edge[:, 2].min())
        return self.skin.of(taken & near)

    @cached_property
    def _front_teeth(self) -> Array:
        """Points (N, 3), m, of the upper teeth that the lower lip can touch; no morph target moves them."""
        assert not self.upper_teeth.targets.any()
        corners = self.upper_teeth.positions[self.upper_teeth.triangles]
        front = corners[(np.abs(corners[:, :, 0]) < 1.1 * _MARGIN).all(1)]
        shares = [(i / 4, j / 4, (4 - i - j) / 4) for i in range(5) for j in range(5 - i)]
        points = np.einsum("kb,mbc->mkc", np.array(shares), front).reshape(-1, 3)
        return np.unique(points.round(6), axis=0)  # triangles share their edges


def _largest_gap(triangles: Array, columns: Array) -> float:
    """The longest part of vertical lines (C,) that triangles (T, 3, 3) leave free between them, seen along z."""
    x, y = np.moveaxis(triangles[:, :, :2], 2, 0)
    x_next, y_next = np.roll(x, -1, 1), np.roll(y, -1, 1)
    lines = columns[:, None, None]
    crossed = (x - lines) * (x_next - lines) < 0
    at = y + (lines - x) * ((y_next - y) / np.where(x == x_next, 1.0, x_next - x))
    low, high = np.where(crossed, at, np.inf).min(2), np.where(crossed, at, -np.inf).max(2)
    order = np.argsort(low)
    low, high = np.take_along_axis(low, order, 1), np.take_along_axis(high, order, 1)
    gaps = low[:, 1:] - np.maximum.accumulate(high, 1)[:, :-1]
    return float(gaps[np.isfinite(low[:, 1:])].max(initial=0.0))


def _part(gltf: dict[str, Any], blob: bytes, primitive: dict[str, Any]) -> Part:
    positions = _array(gltf, blob, primitive["attributes"]["POSITION"]).astype(float)
    targets = np.array([_array(gltf, blob, target["POSITION"]) for target in primitive["targets"]], float)
    return Part(positions, targets, _array(gltf, blob, primitive["indices"]).reshape(-1, 3).astype(np.intp))


def _array(gltf: dict[str, Any], blob: bytes, number: int) -> NDArray[Any]:
    """The values of an accessor (glTF 2.0, 3.6.2), which may be sparse."""
    accessor = gltf["accessors"][number]
    kind, size, count = _TYPES[accessor["componentType"]], _SIZES[accessor["type"]], accessor["count"]
    values = np.zeros((count, size), kind)
    if "bufferView" in accessor:
        values = _view(gltf, blob, accessor, kind, (count, size)).copy()
    if sparse := accessor.get("sparse"):
        indices = _view(gltf, blob, sparse["indices"], _TYPES[sparse["indices"]["componentType"]], (sparse["count"], 1))
        values[indices[:, 0]] = _view(gltf, blob, sparse["values"], kind, (sparse["count"], size))
    return values


def _view(gltf: dict[str, Any], blob: bytes, place: dict[str, Any], kind: Any, shape: tuple[int, int]) -> NDArray[Any]:
    view = gltf["bufferViews"][place["bufferView"]]
    begin = view.get("byteOffset", 0) + place.get("byteOffset", 0)
    values: NDArray[Any] = np.frombuffer(blob, kind, shape[0] * shape[1], begin).reshape(shape)
    return values
