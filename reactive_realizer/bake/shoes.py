"""The shoes: the convex hull of each foot, meshed again as a capsule; upper, laces and sole."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.spatial import ConvexHull, cKDTree

from reactive_realizer.bake.body import SOLE, Body
from reactive_realizer.bake.mesh import Mesh, grid_triangles, merge, no_uvs, vertex_normals
from reactive_realizer.bake.numeric import (
    Array,
    Indices,
    blend_neighbors,
    inverse_distance_weights,
    linear,
    smoothstep,
    unit,
)
from reactive_realizer.bake.rig import SIDES
from reactive_realizer.bake.surgery import clip, relax

_SECTORS, _OUTLINE = 30, 44
_LEATHER = 0.0055
"""Distance of the upper from the foot, m."""

_LACES_AT = (0.42, 0.52, 0.62, 0.72)
_LACE_PROFILE = ((-0.0042, 0.0050), (-0.0030, 0.0082), (0.0030, 0.0082), (0.0042, 0.0050))
"""Forwards and off the foot, m."""

_SOLE_PROFILE = (
    # outwards and height, m
    (-0.006, SOLE + 0.009),
    (0.0030, SOLE + 0.0085),
    (0.0045, SOLE + 0.004),
    (0.0042, 0.006),
    (0.0005, 0.0005),
    (-0.02, 0),
)
_UP = np.array([0, 1.0, 0])


def build_shoes(body: Body) -> Mesh:
    """Both shoes."""
    return merge([part for side, sign in SIDES for part in _Shoe(body, side, sign).parts()])


@dataclass(frozen=True, slots=True)
class _Last:
    """The shape of a foot, around an axis from heel to toe that runs inside it.

    Attributes:
        center: (3,) m.
        forward, right: (3,) level directions.
        offset: of the axis, to the right, m.
        heel, toe: ends of the foot along the axis, m from the center.
        hull: (faces, 4) plane equations.
    """

    center: Array
    forward: Array
    right: Array
    offset: float
    heel: float
    toe: float
    hull: Array

    def axis(self, u: float | Array) -> Array:
        """Points (..., 3) on the axis, u from 0 (heel) to 1 (ball); its height is that of the middle."""
        start, end = self.heel + 0.034, self.toe - 0.040
        return self.center + self.forward * np.asarray(start + (end - start) * u)[..., None] + self.right * self.offset

    def around(self, angles: Array) -> Array:
        """Directions (n, 3) around the axis; 0 is up."""
        return np.cos(angles)[:, None] * _UP + np.sin(angles)[:, None] * self.right

    def surface(self, origins: Array, directions: Array, distance: float) -> Array:
        """The points at which rays (n, 3) leave the foot, grown by a distance."""
        normals, offsets = self.hull[:, :3], self.hull[:, 3]
        slope = directions @ normals.T
        gap = distance - offsets - origins @ normals.T
        leaves = np.where(slope > 1e-6, gap / np.where(slope > 1e-6, slope, 1), 9.0).min(1)
        return origins + directions * leaves[:, None]


class _Shoe:
    """The parts of one shoe."""

    def __init__(self, body: Body, side: str, sign: int) -> None:
        self.design = body.character.shoes
        skin = np.unique(body.triangles)
        self._skin_weights, self._skin_tree = body.weights[skin], cKDTree(body.positions[skin])
        p = body.positions[skin]
        foot = p[(p[:, 0] * sign > 0) & (p[:, 1] < SOLE + 0.064) & (np.abs(p[:, 0]) < 0.4)]
        self.last = _measure(foot, body.places[side + "ToeBase"] - body.places[side + "Foot"])

    def parts(self) -> Iterator[Mesh]:
        yield self._upper()
        for u in _LACES_AT:
            yield self._lace(u)
        yield self._sole()

    def _weights(self, points: Array) -> Array:
        distances, nearest = self._skin_tree.query(points, k=8)
        return blend_neighbors(self._skin_weights, nearest, inverse_distance_weights(distances, 0.004))

    def _upper(self) -> Mesh:
        last = self.last
        points, triangles = self._capsule()
        points = relax(points, triangles, 2, 0.5)
        if ((points - points.mean(0)) * vertex_normals(points, triangles)).sum() < 0:
            triangles = triangles[:, ::-1]
        corners = points[triangles]
        uvs = np.stack([corners @ last.forward * 2.5, corners @ (_UP + last.right) * 2.5], -1)
        upper = clip(Mesh(points, self._weights(points), triangles, uvs), lambda p: p[..., 1] - SOLE - 0.004)
        along = (upper.positions - last.center) @ last.forward
        colors = np.tile(linear(self.design.upper), (len(along), 1))
        colors[along < last.heel + 0.045] *= 0.86  # heel counter
        colors[(along > last.toe - 0.052) & (upper.positions[:, 1] < SOLE + 0.05)] *= 0.90  # toe cap
        upper.colors = colors
        return upper

    def _capsule(self) -> tuple[Array, Indices]:
        """Rings around the foot: half a sphere at the heel, a tube, half a sphere at the toe."""
        around = self.last.around(np.arange(_SECTORS) / _SECTORS * 2 * np.pi)
        stations = [
            *((0, tilt) for tilt in np.linspace(-85, -15, 5)),
            *((u, 0) for u in np.linspace(0, 1, 11)),
            *((1, tilt) for tilt in np.linspace(15, 85, 6)),
        ]
        rings = []
        for u, tilt in stations:
            angle = np.deg2rad(tilt)
            directions = np.cos(angle) * around + np.sin(angle) * self.last.forward
            rings.append(self.last.surface(self._axis_row(u, _SECTORS), directions, _LEATHER))
        return _close_ends(np.vstack(rings), len(rings))

    def _axis_row(self, u: float, count: int) -> Array:
        """The point of the axis at u, count times; the axis falls towards the toe."""
        origin = self.last.axis(u)
        return np.tile([origin[0], SOLE + 0.034 - 0.008 * u, origin[2]], (count, 1))

    def _lace(self, u: float) -> Mesh:
        origins = self._axis_row(u, 7)
        directions = self.last.around(np.linspace(-0.62, 0.62, 7))
        rows = [
            self.last.surface(origins + self.last.forward * ahead, directions, height)
            for ahead, height in _LACE_PROFILE
        ]
        points, triangles = np.vstack(rows), grid_triangles(len(rows), 7, closed=False)
        edges = points[triangles[:, 1]] - points[triangles[:, 0]], points[triangles[:, 2]] - points[triangles[:, 0]]
        if np.cross(*edges)[:, 1].sum() < 0:
            triangles = triangles[:, ::-1]
        return self._plain(points, triangles, self.design.lace)

    def _sole(self) -> Mesh:
        angles = np.arange(_OUTLINE) / _OUTLINE * 2 * np.pi
        outline, outwards, u = self._outline(angles)
        toe_spring = smoothstep(0.75, 1.0, u) * 0.006
        rows = []
        for out, height in _SOLE_PROFILE:
            row = outline + outwards * out
            row[:, 1] = np.full(_OUTLINE, height) + toe_spring * (height < 0.01)
            rows.append(row)
        points, triangles = np.vstack(rows), grid_triangles(len(rows), _OUTLINE, closed=True)
        wall = slice(_OUTLINE, 4 * _OUTLINE)
        if ((points - points.mean(0)) * vertex_normals(points, triangles))[wall].sum() < 0:
            triangles = triangles[:, ::-1]
        return self._plain(points, triangles, self.design.sole)

    def _outline(self, angles: Array) -> tuple[Array, Array, Array]:
        """The foot seen from above: points and outward directions (n, 3), and where on the axis they belong."""
        last = self.last
        directions = np.cos(angles)[:, None] * last.forward + np.sin(angles)[:, None] * last.right
        u = smoothstep(0.15, 0.85, np.clip((np.cos(angles) + 1) / 2, 0, 1))
        origins = last.axis(u)
        origins[:, 1] = SOLE + 0.034 - 0.008
        ring = last.surface(origins, directions, _LEATHER)
        for _ in range(3):
            ring = ring * 0.5 + (np.roll(ring, 1, 0) + np.roll(ring, -1, 0)) * 0.25
        outwards = np.cross(unit(np.roll(ring, -1, 0) - np.roll(ring, 1, 0)), _UP)
        outwards *= np.sign((outwards * directions).sum(1, keepdims=True))
        return ring, outwards, u

    def _plain(self, points: Array, triangles: Indices, color: tuple[int, int, int]) -> Mesh:
        mesh = Mesh(points, self._weights(points), triangles, no_uvs(triangles))
        mesh.paint(color)
        return mesh


def _measure(foot: Array, towards_toe: Array) -> _Last:
    forward = unit(towards_toe * [1, 0, 1])
    right = np.cross(_UP, forward)
    center = foot.mean(0)
    along = (foot - center) @ forward
    return _Last(
        center, forward, right, np.median((foot - center) @ right), along.min(), along.max(), ConvexHull(foot).equations
    )


def _close_ends(points: Array, rings: int) -> tuple[Array, Indices]:
    """A tube of rings, with a fan over each end."""
    triangles = [grid_triangles(rings, _SECTORS, closed=True)]
    a = np.arange(_SECTORS)
    b = (a + 1) % _SECTORS
    for ring, turned in ((0, True), (rings - 1, False)):
        first = ring * _SECTORS
        tip = np.full(_SECTORS, len(points))
        points = np.vstack([points, points[first : first + _SECTORS].mean(0)])
        corners = (tip, first + b, first + a) if turned else (tip, first + a, first + b)
        triangles.append(np.stack(corners, 1))
    return points, np.vstack(triangles)
