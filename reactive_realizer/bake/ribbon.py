"""Strands of hair: curved ribbons along a path."""

import numpy as np

from reactive_realizer.bake.mesh import Mesh, face_normals, grid_triangles
from reactive_realizer.bake.numeric import Array, unit

LOCKS, LONG_LOCKS = 4, 2
"""Variants side by side in the hair texture; the first ones are of long hair, the others of short hair."""


def resample(path: Array, count: int, sparse: Array) -> Array:
    """Points (count, 3) along a polyline (n, 3); stretches marked sparse (n,) get about half the density."""
    lengths = np.linalg.norm(np.diff(path, axis=0), axis=1) * np.where(sparse[1:], 0.45, 1.0)
    along = np.r_[0, np.cumsum(lengths)]
    at = np.linspace(0, along[-1], count)
    return np.stack([np.interp(at, along, path[:, axis]) for axis in range(3)], 1)


def ribbon(
    path: Array, outward: Array, width: Array, across: int, bulge: float, lock: int, colors: Array, weights: Array
) -> Mesh:
    """A ribbon that is arched outwards and shaded softly.

    Args:
        path: (n, 3) m, from the root.
        outward: (n, 3) away from the head.
        width: (n,) half of it, m.
        across: points from edge to edge.
        bulge: height of the arch, in half widths.
        lock: variant of the hair texture.
        colors: (n, 3) linear light.
        weights: (joints,) bone weights of the whole ribbon.
    """
    along = unit(np.gradient(path, axis=0))
    sideways = unit(np.cross(along, outward))
    up = unit(np.cross(sideways, along))
    x = np.linspace(-1, 1, across)
    arch = (1 - x**2) * bulge * width[:, None]
    positions = path[:, None] + sideways[:, None] * (width[:, None] * x)[..., None] + up[:, None] * arch[..., None]
    normals = up[:, None] + sideways[:, None] * (x * 1.7 * bulge)[None, :, None] + 0.35 * outward[:, None]
    u, v = np.meshgrid((lock + 0.5 + 0.49 * x) / LOCKS, np.linspace(0.02, 0.98, len(path)))
    triangles = grid_triangles(len(path), across, closed=False)[:, [0, 2, 1]]
    uvs = np.stack([u, v], -1).reshape(-1, 2)[triangles]
    positions, normals = positions.reshape(-1, 3), unit(normals).reshape(-1, 3)
    bound = np.tile(weights, (len(positions), 1))
    mesh = Mesh(positions, bound, triangles, uvs, np.repeat(colors, across, 0), normals)
    face_outward(mesh)
    return mesh


def face_outward(mesh: Mesh) -> None:
    """Turn the triangles to the side that the normals point to."""
    if mesh.normals is None:
        return
    faces = face_normals(mesh.positions, mesh.triangles)
    if (faces * mesh.normals[mesh.triangles[:, 0]]).sum() < 0:
        mesh.flip()
