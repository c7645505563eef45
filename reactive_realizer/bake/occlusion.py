"""Ambient occlusion: how much of the light from all around reaches each point of the skin."""

from collections.abc import Sequence

import numpy as np

from reactive_realizer.bake.mesh import Mesh, face_normals
from reactive_realizer.bake.numeric import Array, fibonacci_sphere

_DIRECTIONS = 72
_CELL, _BIAS = 0.0035, 0.006
"""Size of the cells in which a shadow is looked up, and what does not shade a point because it is so near, m."""

_LEAST = 0.25
"""Light that reaches every point: hair lets some through, and skin spreads it."""

_DENSITY = 2.5
"""Points that stand for a surface, per cell."""


def exposure(points: Array, normals: Array, around: Sequence[Mesh]) -> Array:
    """The share (v,) of light from everywhere that reaches points (v, 3) with normals, weighted by its angle.

    Each direction has a depth map of the meshes around, in which the points are looked up.
    """
    blockers = np.vstack([_sampled(mesh) for mesh in around])
    low = np.minimum(blockers.min(0), points.min(0))
    span = int(np.ceil(np.linalg.norm(np.maximum(blockers.max(0), points.max(0)) - low) / _CELL)) + 3
    received, possible = np.zeros(len(points)), np.zeros(len(points))
    for direction in fibonacci_sphere(_DIRECTIONS):
        side = np.cross(direction, [0, 1, 0] if abs(direction[1]) < 0.9 else [1, 0, 0])
        axes = np.stack([side / np.linalg.norm(side), np.cross(direction, side / np.linalg.norm(side))], 1)
        middle = (low @ axes) / _CELL
        cells, own = (
            np.clip(np.round(p @ axes / _CELL - middle).astype(int) + span, 0, 2 * span) for p in (blockers, points)
        )
        nearest = np.full((2 * span + 1) ** 2, -np.inf)
        np.maximum.at(nearest, cells[:, 0] * (2 * span + 1) + cells[:, 1], blockers @ direction)
        free = points @ direction + _BIAS >= nearest[own[:, 0] * (2 * span + 1) + own[:, 1]]
        weight = np.maximum(normals @ direction, 0)
        received, possible = received + weight * free, possible + weight
    return _LEAST + (1 - _LEAST) * received / np.maximum(possible, 1e-9)


def _sampled(mesh: Mesh) -> Array:
    """Points spread evenly over a mesh (n, 3)."""
    rng = np.random.default_rng(17)
    areas = np.linalg.norm(face_normals(mesh.positions, mesh.triangles), axis=1) / 2
    counts = np.ceil(areas * _DENSITY / _CELL**2 * (0.5 + rng.random(len(areas)))).astype(int)
    triangles = np.repeat(mesh.triangles, counts, 0)
    a, b = rng.random((2, len(triangles)))
    a, b = np.where(a + b > 1, 1 - a, a)[:, None], np.where(a + b > 1, 1 - b, b)[:, None]
    p = mesh.positions
    points: Array = p[triangles[:, 0]] * (1 - a - b) + p[triangles[:, 1]] * a + p[triangles[:, 2]] * b
    return points
