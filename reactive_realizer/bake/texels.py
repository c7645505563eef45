"""Which point of a mesh each texel of its textures shows."""

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt

from reactive_realizer.bake.numeric import Array, Indices

_OVERLAP = 0.06
"""Margin by which a triangle is painted beyond its edges, in barycentric coordinates; it avoids seams."""


class TexelMap:
    """Carries values of the corners of triangles over to the texels of a square picture."""

    def __init__(self, uvs: Array, size: int, height: Array | None = None) -> None:
        """Find the triangle under each texel; texels that no triangle covers belong to the nearest one that is covered.

        Args:
            uvs: (t, 3, 2) texture coordinates of the corners, v downwards.
            size: of the picture.
            height: (t, 3) by corner; of two triangles over one texel, the higher one is seen. None: the later one.
        """
        self._triangle = np.full((size, size), -1, np.int32)
        self._shares = np.zeros((size, size, 3), np.float32)
        highest = np.full((size, size), -np.inf)
        for triangle, corners in enumerate(uvs * size - 0.5):
            xs, ys, shares = _texels(corners, size)
            if height is not None:
                heights = shares @ height[triangle]
                seen = heights > highest[ys, xs]
                xs, ys, shares = xs[seen], ys[seen], shares[seen]
                highest[ys, xs] = heights[seen]
            self._triangle[ys, xs], self._shares[ys, xs] = triangle, shares
        self._fill_gaps()

    def carry(self, corners: Array) -> Array:
        """Values (t, 3) or (t, 3, k) of the corners as a picture (size, size) or (size, size, k)."""
        if corners.ndim == 3:
            return np.stack([self.carry(corners[..., i]) for i in range(corners.shape[2])], -1)
        values: Array = sum(corners[self._triangle, i] * self._shares[..., i] for i in range(3))
        return values

    def _fill_gaps(self) -> None:
        nearest: NDArray[np.int32] = distance_transform_edt(
            self._triangle < 0, return_distances=False, return_indices=True
        )
        y, x = nearest
        self._triangle, self._shares = self._triangle[y, x], self._shares[y, x]


def _texels(corners: Array, size: int) -> tuple[Indices, Indices, Array]:
    """The texels under a triangle with corners (3, 2) in texels: columns, rows, barycentric coordinates (n, 3)."""
    low, high = np.floor(corners.min(0) - 1).astype(int), np.ceil(corners.max(0) + 1).astype(int)
    xs, ys = (grid.ravel() for grid in np.meshgrid(*(np.arange(a, b + 1) for a, b in zip(low, high, strict=True))))
    a, c = corners[1] - corners[0], corners[2] - corners[0]
    area = a[0] * c[1] - a[1] * c[0]
    if abs(area) < 1e-9:
        return xs[:0], ys[:0], np.zeros((0, 3))
    dx, dy = xs - corners[0, 0], ys - corners[0, 1]
    l1, l2 = (dx * c[1] - dy * c[0]) / area, (a[0] * dy - a[1] * dx) / area
    covered = (l1 > -_OVERLAP) & (l2 > -_OVERLAP) & (l1 + l2 < 1 + _OVERLAP) & (ys >= 0) & (ys < size)
    return xs[covered] % size, ys[covered], np.stack([1 - l1 - l2, l1, l2], 1)[covered]
