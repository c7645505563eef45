"""Triangle meshes with bone weights, and what changes their triangles without cutting them."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_matrix, csr_matrix

from reactive_realizer.bake.numeric import Array, Color, Indices, linear, unit


@dataclass(slots=True)
class Mesh:
    """A skinned triangle mesh.

    Texture coordinates belong to corners, not to vertices: a seam then needs no double vertices, and everything that
    edits meshes stays simple. `primitive` makes vertices of them for the file.

    Attributes:
        positions: (v, 3) m.
        weights: (v, joints) bone weights; rows sum to 1.
        triangles: (t, 3) vertex indices, counterclockwise from outside.
        uvs: (t, 3, 2) texture coordinates of the corners.
        colors: (v, 3) linear light, or None for white.
        normals: (v, 3) unit, or None for those of the surface.
    """

    positions: Array
    weights: Array
    triangles: Indices
    uvs: Array
    colors: Array | None = None
    normals: Array | None = None

    def compact(self) -> "Mesh":
        """Without the vertices that no triangle uses, and without normals."""
        used, inverse = np.unique(self.triangles, return_inverse=True)
        colors = None if self.colors is None else self.colors[used]
        return Mesh(self.positions[used], self.weights[used], inverse.reshape(-1, 3), self.uvs, colors)

    def paint(self, color: Color) -> None:
        """Give every vertex this color."""
        self.colors = np.tile(linear(color), (len(self.positions), 1))

    def flip(self) -> None:
        """Turn the triangles around, so that the inside becomes the outside."""
        self.triangles = self.triangles[:, [0, 2, 1]]
        self.uvs = self.uvs[:, [0, 2, 1]]


def no_uvs(triangles: Indices) -> Array:
    """Texture coordinates for a mesh that has no texture."""
    return np.zeros((len(triangles), 3, 2))


def face_normals(positions: Array, triangles: Indices) -> Array:
    """Normals (t, 3) of the triangles, twice their area long."""
    p = positions
    return np.cross(p[triangles[:, 1]] - p[triangles[:, 0]], p[triangles[:, 2]] - p[triangles[:, 0]])


def vertex_normals(positions: Array, triangles: Indices) -> Array:
    """Unit normals (v, 3): those of the triangles around, weighted by area."""
    faces = face_normals(positions, triangles)
    normals = np.zeros_like(positions)
    for corner in range(3):
        np.add.at(normals, triangles[:, corner], faces)
    return unit(normals)


def merge(meshes: Sequence[Mesh]) -> Mesh:
    """One mesh of many; it has colors and normals if all of them do."""
    offsets = np.cumsum([0] + [len(m.positions) for m in meshes])
    colors = [m.colors for m in meshes if m.colors is not None]
    normals = [m.normals for m in meshes if m.normals is not None]
    return Mesh(
        np.vstack([m.positions for m in meshes]),
        np.vstack([m.weights for m in meshes]),
        np.vstack([m.triangles + offset for m, offset in zip(meshes, offsets, strict=False)]),
        np.concatenate([m.uvs for m in meshes]),
        np.vstack(colors) if len(colors) == len(meshes) else None,
        np.vstack(normals) if len(normals) == len(meshes) else None,
    )


def half_edges(triangles: Indices) -> Indices:
    """(3 t, 2) directed edges: the first of every triangle, then the second, then the third."""
    return np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])


def adjacency(sources: Indices, targets: Indices, count: int) -> csr_matrix:
    """Matrix (count, count) with the number of edges from a vertex to another."""
    return coo_matrix((np.ones(len(sources)), (sources, targets)), (count, count)).tocsr()


def neighbors(triangles: Indices, count: int) -> csr_matrix:
    """Adjacency of a mesh; an edge counts once for each triangle at it."""
    edges = half_edges(triangles)
    return adjacency(np.r_[edges[:, 0], edges[:, 1]], np.r_[edges[:, 1], edges[:, 0]], count)


def subdivide(mesh: Mesh) -> Mesh:
    """Split every triangle into four at the middles of its edges."""
    edges, inverse = np.unique(np.sort(half_edges(mesh.triangles), 1), axis=0, return_inverse=True)
    a, b, c = inverse.reshape(3, -1) + len(mesh.positions)
    t0, t1, t2 = mesh.triangles.T
    u0, u1, u2 = mesh.uvs[:, 0], mesh.uvs[:, 1], mesh.uvs[:, 2]
    ua, ub, uc = (u0 + u1) / 2, (u1 + u2) / 2, (u2 + u0) / 2
    triangles = [(t0, a, c), (a, t1, b), (c, b, t2), (a, b, c)]
    uvs = [(u0, ua, uc), (ua, u1, ub), (uc, ub, u2), (ua, ub, uc)]
    return Mesh(
        np.vstack([mesh.positions, mesh.positions[edges].mean(1)]),
        np.vstack([mesh.weights, mesh.weights[edges].mean(1)]),
        np.concatenate([np.stack(t, 1) for t in triangles]),
        np.concatenate([np.stack(u, 1) for u in uvs]),
    )


def grid_triangles(rows: int, columns: int, *, closed: bool) -> Indices:
    """Triangles over a grid of vertices, row by row.

    Args:
        rows: rows of vertices.
        columns: vertices in a row.
        closed: the last column is joined to the first, as on a tube.
    """
    row, column = np.meshgrid(np.arange(rows - 1), np.arange(columns if closed else columns - 1), indexing="ij")
    a, b = row * columns + column, row * columns + (column + 1) % columns
    c, d = a + columns, b + columns
    return np.stack([a, b, c, b, d, c], -1).reshape(-1, 3)
