"""The head's own texture coordinates, and the position of every texel: the face is painted in three dimensions."""

import numpy as np
from scipy.ndimage import map_coordinates

from reactive_realizer.bake.body import Body
from reactive_realizer.bake.mesh import neighbors
from reactive_realizer.bake.numeric import Array, Indices, Mask
from reactive_realizer.bake.texels import TexelMap

SIZE = 2048
MOVES = 1e-5
"""A vertex that a face unit moves by more than this (m) belongs to the head."""


class HeadMap:
    """A cylindrical unwrap of the head that gives the front more room than the back.

    Attributes:
        triangles: (t, 3) of head and neck.
        mouth_triangles: (m, 3) of the inside of the mouth, which has no texture.
        is_head: which triangles of the body's skin are one or the other.
        uvs: (t, 3, 2) of `triangles`.
        body_uvs: (t, 3, 2) the original ones.
        eye: (3,) m, between the eyes.
        center: (3,) m, middle of the skull.
        points: (size, size, 3) m, the position of each texel.
        cavity: (size, size) negative in creases, positive on ridges.
    """

    def __init__(self, body: Body) -> None:
        self.eye = body.eye_center
        self.center = np.array([0, self.eye[1] + 0.035, self.eye[2] - 0.085])
        self.is_head = _head_triangles(body)
        inside_mouth = body.is_inside_mouth
        self.triangles = body.triangles[self.is_head & ~inside_mouth]
        self.body_uvs = body.uvs[self.is_head & ~inside_mouth]
        self.mouth_triangles = body.triangles[self.is_head & inside_mouth]
        heights = body.positions[np.unique(self.triangles)][:, 1]
        self._bottom, self._top = heights.min() - 0.004, heights.max() + 0.004
        corners = body.positions[self.triangles]
        self.uvs = self._unwrap(corners)
        # of two sheets over one texel, as behind an ear, the outer one is seen
        outward = np.hypot(corners[..., 0], corners[..., 2] - self.center[2])
        self._texels = TexelMap(self.uvs, SIZE, outward)
        self.points, self.cavity = self._texels.carry(corners), self.carry(_curvature(body))
        self._body_uv = self._texels.carry(self.body_uvs)

    @property
    def lip_seam(self) -> Indices:
        """The vertices where the lips turn inside."""
        return np.intersect1d(np.unique(self.mouth_triangles), np.unique(self.triangles))

    def carry(self, values: Array) -> Array:
        """Values (v,) of the vertices of the body as a picture (size, size) in this unwrap."""
        return self._texels.carry(values[self.triangles])

    def sample(self, picture: Array) -> Array:
        """A picture (n, n) in the original texture coordinates, carried over to this unwrap."""
        n = len(picture)
        u, v = self._body_uv[..., 0], self._body_uv[..., 1]
        return map_coordinates(picture, [(1 - v) * n - 0.5, u * n - 0.5], order=1, mode="nearest")

    def _unwrap(self, corners: Array) -> Array:
        azimuth = np.arctan2(corners[..., 0], corners[..., 2] - self.center[2]) / np.pi
        across_the_back = (np.ptp(azimuth, axis=1) > 1)[:, None] & (azimuth < 0)
        azimuth = np.where(across_the_back, azimuth + 2, azimuth)
        height = (self._top - corners[..., 1]) / (self._top - self._bottom)
        return np.stack([0.5 + azimuth / (1 + np.abs(azimuth)), height], -1)


def _head_triangles(body: Body) -> Mask:
    moved = np.zeros(len(body.positions), bool)
    for moves in body.face_units.values():
        moved |= np.abs(moves).max(1) > MOVES
    belongs = (body.weight_of("Head", "Neck")[body.triangles] > 0.5) | moved[body.triangles]
    return np.any(belongs, axis=1)


def _curvature(body: Body) -> Array:
    """The distance of each skin vertex from the mean of its neighbors, about -1.5..1.5."""
    links = neighbors(body.triangles, len(body.positions))
    degree = np.maximum(np.asarray(links.sum(1)).ravel(), 1)
    offset = body.positions - links @ body.positions / degree[:, None]
    curvature = np.clip(np.einsum("ij,ij->i", offset, body.normals) / 0.0012, -1.5, 1.5)
    return (curvature + links @ curvature / degree) / 2
