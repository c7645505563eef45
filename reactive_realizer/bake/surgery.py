"""Cuts, welds, smooths and extrudes open meshes."""

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import NamedTuple, TypeAlias

import numpy as np

from reactive_realizer.bake.mesh import Mesh, adjacency, half_edges
from reactive_realizer.bake.numeric import Array, Field, Indices, unit

BISECTIONS = 18


class RimCorner(NamedTuple):
    """A corner of a triangle at the open edge that leaves from it."""

    vertex: int
    triangle: int
    corner: int


Rim: TypeAlias = list[RimCorner]
RimRow: TypeAlias = Callable[[Array, Array, Array], Array]
"""From positions, normals and outward directions in the surface along a rim, each (k, 3), to those of a new row."""


def boundary_edges(triangles: Indices) -> list[tuple[int, RimCorner]]:
    """The directed edges with a triangle on one side only, each as (end vertex, corner that it leaves from)."""
    edges = [tuple(edge) for edge in half_edges(triangles).tolist()]
    known = set(edges)
    count = len(triangles)
    return [
        (end, RimCorner(start, place % count, place // count))
        for place, (start, end) in enumerate(edges)
        if (end, start) not in known
    ]


def rims(triangles: Indices) -> list[Rim]:
    """The closed loops of open edges, the longest first."""
    following = {corner.vertex: (end, corner) for end, corner in boundary_edges(triangles)}
    found = []
    while following:
        vertex = min(following)
        rim = []
        while vertex in following:
            vertex, corner = following.pop(vertex)
            rim.append(corner)
        found.append(rim)
    return sorted(found, key=len, reverse=True)


def rim_vertices(rim: Rim) -> Indices:
    """The vertices along a rim."""
    return np.array([corner.vertex for corner in rim])


def relax(positions: Array, triangles: Indices, rounds: int, rate: float = 0.5) -> Array:
    """Laplacian smoothing; vertices of the rim move along the rim only."""
    count = len(positions)
    edges = half_edges(triangles)
    sources, targets = np.r_[edges[:, 0], edges[:, 1]], np.r_[edges[:, 1], edges[:, 0]]
    if open_edges := boundary_edges(triangles):
        rim = np.array([(corner.vertex, end) for end, corner in open_edges])
        on_rim = np.zeros(count, bool)
        on_rim[rim] = True
        free = ~on_rim[sources]
        sources = np.r_[sources[free], rim[:, 0], rim[:, 1]]
        targets = np.r_[targets[free], rim[:, 1], rim[:, 0]]
    links = adjacency(sources, targets, count)
    links.data[:] = 1
    degree = np.asarray(links.sum(1)).ravel()
    degree[degree == 0] = 1
    for _ in range(rounds):
        positions = positions + rate * (links @ positions / degree[:, None] - positions)
    return positions


class _Cutter:
    """Cuts edges where a field changes sign, each edge once however many triangles share it.

    The cut is solved onto the surface by bisection, so that the rim is a smooth closed loop.
    """

    def __init__(self, mesh: Mesh, field: Field) -> None:
        self.mesh = mesh
        self.field = field
        self.inside = field(mesh.positions) >= 0
        self.positions = list(mesh.positions)
        self.weights = list(mesh.weights)
        self.colors = None if mesh.colors is None else list(mesh.colors)
        self._cuts: dict[tuple[int, int], tuple[int, int, float]] = {}

    def cut(self, a: int, b: int) -> tuple[int, float]:
        """The new vertex between a and b, and where between them it lies, 0..1 from a."""
        key = (min(a, b), max(a, b))
        if key not in self._cuts:
            self._cuts[key] = self._make(*key)
        vertex, inner, t = self._cuts[key]
        return vertex, (t if a == inner else 1 - t)

    def _make(self, a: int, b: int) -> tuple[int, int, float]:
        inner, outer = (a, b) if self.inside[a] else (b, a)
        t = self._solve(self.mesh.positions[inner], self.mesh.positions[outer])
        for values, source in (
            (self.positions, self.mesh.positions),
            (self.weights, self.mesh.weights),
            (self.colors, self.mesh.colors),
        ):
            if values is not None and source is not None:
                values.append(source[inner] * (1 - t) + source[outer] * t)
        return len(self.positions) - 1, inner, t

    def _solve(self, inner: Array, outer: Array) -> float:
        low, high = 0.0, 1.0
        for _ in range(BISECTIONS):
            t = (low + high) / 2
            if self.field((inner * (1 - t) + outer * t)[None])[0] >= 0:
                low = t
            else:
                high = t
        return low

    def remains_of(self, triangle: int) -> list[tuple[int, Array]]:
        """The rest of a clipped triangle: the corners (vertex, uv) of a polygon."""
        corners, uvs = self.mesh.triangles[triangle], self.mesh.uvs[triangle]
        polygon = []
        for i in range(3):
            j = (i + 1) % 3
            a, b = corners[i], corners[j]
            if self.inside[a]:
                polygon.append((a, uvs[i]))
            if self.inside[a] != self.inside[b]:
                vertex, t = self.cut(a, b)
                polygon.append((vertex, uvs[i] * (1 - t) + uvs[j] * t))
        return polygon


def clip(mesh: Mesh, field: Field) -> Mesh:
    """Keep the part in which the field is not negative."""
    cutter = _Cutter(mesh, field)
    corners_inside = cutter.inside[mesh.triangles]
    whole = corners_inside.all(1)
    triangles, uvs = [mesh.triangles[whole]], [mesh.uvs[whole]]
    for triangle in np.where(corners_inside.any(1) & ~whole)[0]:
        polygon = cutter.remains_of(triangle)
        for second, third in pairwise(polygon[1:]):
            fan = (polygon[0], second, third)
            triangles.append(np.array([[vertex for vertex, _ in fan]]))
            uvs.append(np.array([[uv for _, uv in fan]]))
    return Mesh(
        np.array(cutter.positions),
        np.array(cutter.weights),
        np.vstack(triangles),
        np.concatenate(uvs),
        None if cutter.colors is None else np.array(cutter.colors),
    ).compact()


def collapse_rim(mesh: Mesh, tolerance: float) -> Mesh:
    """Weld the very short rim edges that clipping leaves: their slivers shade badly."""
    p = mesh.positions
    kept = np.arange(len(p))
    for rim in rims(mesh.triangles):
        vertices = [corner.vertex for corner in rim]
        for a, b in zip(vertices, vertices[1:] + vertices[:1], strict=True):
            if kept[a] == a and kept[b] == b and a != b and np.linalg.norm(p[a] - p[b]) < tolerance:
                kept[b] = a
    triangles = kept[mesh.triangles]
    a, b, c = triangles.T
    sound = (a != b) & (b != c) & (c != a)
    return Mesh(p, mesh.weights, triangles[sound], mesh.uvs[sound], mesh.colors).compact()


def sweep(mesh: Mesh, rim: Rim, rows: Sequence[RimRow], normals: Array) -> Mesh:
    """A band that grows from a rim, row by row: a hem, a cuff, a collar.

    Args:
        mesh: the cloth.
        rim: one of its rims.
        rows: position of each further row of the band.
        normals: vertex normals of the cloth.
    """
    vertices = rim_vertices(rim)
    p = mesh.positions[vertices]
    along = unit(np.roll(p, -1, 0) - np.roll(p, 1, 0))
    normal = _smooth_loop(normals[vertices].copy(), 6)
    outward = _smooth_loop(unit(np.cross(along, normal)), 4)
    bands = [p] + [row(p, normal, outward) for row in rows]
    uv = np.array([mesh.uvs[corner.triangle, corner.corner] for corner in rim])
    triangles, uvs = _band(len(vertices), uv, len(rows))
    return Mesh(np.vstack(bands), np.tile(mesh.weights[vertices], (len(bands), 1)), triangles, uvs)


def _smooth_loop(vectors: Array, rounds: int) -> Array:
    for _ in range(rounds):
        vectors = unit(vectors + np.roll(vectors, 1, 0) + np.roll(vectors, -1, 0))
    return vectors


def _band(count: int, uv: Array, rows: int) -> tuple[Indices, Array]:
    a = np.arange(count)
    b = (a + 1) % count
    triangles, uvs = [], []
    for row in range(rows):
        o, q = row * count, (row + 1) * count
        triangles += [np.stack([o + b, o + a, q + a], 1), np.stack([o + b, q + a, q + b], 1)]
        here, there = (uv + np.array([0, 0.03 * r]) for r in (row, row + 1))
        at_seam = (np.abs(here[b][:, 0] - here[:, 0]) > 0.5)[:, None]
        next_here, next_there = np.where(at_seam, here, here[b]), np.where(at_seam, there, there[b])
        uvs += [np.stack([next_here, here, there], 1), np.stack([next_here, there, next_there], 1)]
    return np.vstack(triangles), np.concatenate(uvs)
