"""The mouth at rest: closed lips, and the tongue where a person's lies."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from reactive_realizer.bake.mesh import half_edges
from reactive_realizer.bake.numeric import Array, Indices, Mask, gaussian, smoothstep

_FIT = (
    # upper incisors show in speech, the tongue lies lower than MakeHuman puts it
    ("helper-upper-teeth", (0, -0.0030, 0.0015)),
    ("helper-lower-teeth", (0, -0.0008, 0.0008)),
    ("helper-tongue", (0, -0.0050, -0.0045)),
)

_OVERLAP = 0.0004
"""By how much the upper lip covers the lower one at least, m."""

_TAPER = 0.0015
"""Distance from a corner of the mouth, which stays where it is, within which lips move less, m."""

_LIP_HEIGHT, _LIP_DEPTH = 0.011, 0.014
"""How far from the line between the lips, and behind the corners, the flesh moves along, m."""

_STEP = 0.00025
"""Distance of the lines at which the gap is measured, m."""

_GROOVE, _GROOVE_WIDTH = 0.0022, 0.0035
"""Depth and half the width of the furrow along the tongue, m."""

_BACK_DROP = 0.0085
"""By how much the back of the tongue lies below that of MakeHuman's, which hides the throat, m."""


def place_mouth(positions: Array, groups: Mapping[str, Indices]) -> None:
    """Move teeth and tongue to where people have them.

    Args:
        positions: (v, 3) m, which change.
        groups: vertices by name.
    """
    for group, offset in _FIT:
        positions[groups[group]] += offset
    tongue = positions[groups["helper-tongue"]]
    drop = _BACK_DROP * smoothstep(0.004, 0.038, _depth(tongue)) + _GROOVE * groove(tongue)
    positions[groups["helper-tongue"], 1] -= drop


def _depth(tongue: Array) -> Array:
    """Distance (n,) of the points of a tongue (n, 3) behind its tip, m."""
    depth: Array = tongue[:, 2].max() - tongue[:, 2]
    return depth


def groove(tongue: Array) -> Array:
    """How deep the points of a tongue (n, 3) lie in the furrow along its middle, 0..1."""
    return gaussian(tongue[:, 0], 0, _GROOVE_WIDTH) * smoothstep(0.001, 0.009, _depth(tongue))


@dataclass(frozen=True, slots=True)
class _Lips:
    """What of the skin is lips.

    Attributes:
        corner: (3,) m, that of the mouth on the figure's left.
        lower: (v,) the vertices that the jaw takes along further than the corners.
        edges: (e, 2) of the outer skin around the mouth.
    """

    corner: Array
    lower: Mask
    edges: Indices


def close_lips(positions: Array, outside: Indices, inside: Indices, jaw_open: Array) -> None:
    """Move the lips towards each other where a gap between them is seen from the front.

    Args:
        positions: (v, 3) m, which change.
        outside: (t, 3) triangles of the skin outside of the mouth.
        inside: (t, 3) those inside.
        jaw_open: (v,) how far an open jaw lifts each vertex, m.
    """
    seam = np.intersect1d(np.unique(inside), np.unique(outside))
    corner = seam[positions[seam, 0].argmax()]
    lips = _Lips(positions[corner].copy(), jaw_open < jaw_open[corner], _edges_near(positions, outside, seam))
    columns = np.arange(-lips.corner[0], lips.corner[0], _STEP)
    low, high = _silhouettes(positions, lips, columns)
    both = np.isfinite(low - high)
    columns, low, high = columns[both], low[both], high[both]
    middle = (low + high) / 2
    half = np.maximum(low - high + _OVERLAP, 0) / 2 * smoothstep(0, _TAPER, lips.corner[0] - np.abs(columns))
    flesh = np.union1d(outside, inside)
    x, y, z = positions[flesh].T
    near = smoothstep(_LIP_HEIGHT, 0.0015, np.abs(y - np.interp(x, columns, middle)))
    near *= smoothstep(-_LIP_DEPTH, -_LIP_DEPTH / 2, z - lips.corner[2])
    moved = np.interp(x, columns, half, 0, 0) * near
    positions[flesh, 1] += np.where(lips.lower[flesh], moved, -moved)


def _edges_near(positions: Array, outside: Indices, seam: Indices) -> Indices:
    """Edges (e, 2) of the skin that is less than the height of the lips away from where they turn inside."""
    low, high = positions[seam].min(0) - _LIP_HEIGHT, positions[seam].max(0) + _LIP_HEIGHT
    near = ((positions > low) & (positions < high)).all(1)
    return half_edges(outside[near[outside].all(1)])


def _silhouettes(positions: Array, lips: _Lips, columns: Array) -> tuple[Array, Array]:
    """The lowest height of the upper lip and the greatest of the lower one at columns (c,), seen from the front, m."""
    ends = positions[lips.edges]
    lower = lips.lower[lips.edges]
    start, stop = ends[:, None, 0], ends[:, None, 1]
    crossed = (start[..., 0] - columns) * (stop[..., 0] - columns) <= 0
    width = np.where(start[..., 0] == stop[..., 0], 1, stop[..., 0] - start[..., 0])
    at = start[..., 1] + (columns - start[..., 0]) / width * (stop[..., 1] - start[..., 1])
    upper_lip, lower_lip = (each.all(axis=1, keepdims=True) & crossed for each in (~lower, lower))
    return np.where(upper_lip, at, np.inf).min(0), np.where(lower_lip, at, -np.inf).max(0)
