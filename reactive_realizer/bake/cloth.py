"""Common parts of garments: cloth is cut from the helper mesh, kept off the skin, weighted like it, and hemmed."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from reactive_realizer.bake.body import Body
from reactive_realizer.bake.mesh import Mesh, neighbors, subdivide
from reactive_realizer.bake.numeric import Array, Color, Mask, blend_neighbors, inverse_distance_weights, linear, unit
from reactive_realizer.bake.surgery import Rim, RimRow, sweep

FABRIC_REPEATS = 34.0
"""Repetitions of the fabric texture over MakeHuman's texture coordinates of its tights."""

SLIVER = 0.0022
"""Rim edges shorter than this (m) are welded."""


@dataclass(frozen=True, slots=True)
class Garment:
    """Cloth, and the skin under it.

    Attributes:
        mesh: all its parts.
        covers: which points (n, 3) of the body are certainly hidden by it.
    """

    mesh: Mesh
    covers: Callable[[Array], Mask]


class Surface:
    """A part of the skin that cloth keeps its distance from."""

    def __init__(self, positions: Array, normals: Array, weights: Array) -> None:
        """Take points of the skin: positions (n, 3) m, normals (n, 3), bone weights (n, joints)."""
        self._positions, self._normals, self._weights = positions, normals, weights
        self._tree = cKDTree(positions)

    @classmethod
    def of(cls, body: Body, part: Mask) -> "Surface":
        """The vertices of a part (v,) of a body."""
        return cls(body.positions[part], body.normals[part], body.weights[part])

    def push(self, points: Array, ease: float, limit: float = 0.05) -> Array:
        """Points (n, 3) moved outwards, by at most limit, to at least ease above the skin (m)."""
        height, normals = self.height_of(points)
        return points + normals * np.clip(ease - height, 0, limit)[:, None]

    def lay(self, points: Array, ease: float, share: float | Array = 1.0) -> Array:
        """Points (n, 3) moved outwards or inwards to ease above the skin (m), or by a share (n,) of the way."""
        height, normals = self.height_of(points)
        return points + normals * ((ease - height) * share)[:, None]

    def height_of(self, points: Array) -> tuple[Array, Array]:
        """The heights (n,) of points above the skin, m, and the normals (n, 3) of the skin there."""
        distances, nearest = self._tree.query(points, k=4)
        weights = inverse_distance_weights(distances, 2e-3)
        skin = blend_neighbors(self._positions, nearest, weights)
        normals = unit(blend_neighbors(self._normals, nearest, weights))
        return ((points - skin) * normals).sum(1), normals

    def weights_at(self, points: Array) -> Array:
        """Bone weights (n, joints) of points (n, 3): those of the skin nearby."""
        distances, nearest = self._tree.query(points, k=6)
        weights = blend_neighbors(self._weights, nearest, inverse_distance_weights(distances, 0.004))
        return weights / weights.sum(1, keepdims=True)

    def weights_for(self, cloth: Mesh, rounds: int = 3) -> Array:
        """Bone weights (v, joints) of a cloth: those of the skin nearby, smoothed (the helper's own have outliers)."""
        weights = self.weights_at(cloth.positions)
        links = neighbors(cloth.triangles, len(cloth.positions))
        links.data[:] = 1
        degree = np.asarray(links.sum(1)).ravel()[:, None]
        for _ in range(rounds):
            weights = 0.5 * weights + 0.5 * (links @ weights) / degree
        return weights / weights.sum(1, keepdims=True)


def cut_cloth(body: Body, wanted: Callable[[Array], Mask]) -> Mesh:
    """Fine cloth from MakeHuman's tights: the triangles whose middles (n, 3) are wanted."""
    triangles, uvs = body.triangles_of("helper-tights")
    kept = wanted(body.positions[triangles].mean(1))
    cloth = Mesh(body.positions, body.weights, triangles[kept], uvs[kept] * FABRIC_REPEATS)
    return subdivide(cloth.compact())


def band(cloth: Mesh, rim: Rim, rows: list[RimRow], normals: Array, color: Color, shade: float) -> Mesh:
    """A colored band around a rim; its last row lies inside and is as dark as shade says."""
    swept = sweep(cloth, rim, rows, normals)
    colors = np.tile(linear(color), (len(swept.positions), 1))
    colors[-len(rim) :] *= shade
    swept.colors = colors
    return swept


def hem(cloth: Mesh, rim: Rim, normals: Array, color: Color, *, depth: float, thickness: float) -> Mesh:
    """The cloth turned inwards at a rim."""
    rows: list[RimRow] = [
        lambda p, n, out: p + out * 0.0012 + n * 0.0004,
        lambda p, n, out: p + out * 0.0016 - n * thickness,
        lambda p, n, out: p - out * depth - n * thickness * 1.3,
    ]
    turned = band(cloth, rim, rows, normals, color, 0.35)
    # It moves with the cloth beside it, not with the rim, or it would come through where the cloth bends.
    turned.weights = cloth.weights[cKDTree(cloth.positions).query(turned.positions)[1]]
    return turned
