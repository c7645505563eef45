"""The shape under the hair."""

import numpy as np
from scipy.ndimage import gaussian_filter, map_coordinates
from scipy.spatial import cKDTree

from reactive_realizer.bake.body import Body
from reactive_realizer.bake.head_map import HeadMap
from reactive_realizer.bake.numeric import Array, Mask, direction, unit

_ELEVATIONS, _AZIMUTHS = 61, 120


class Skull:
    """A smooth radius in every direction from the middle of the skull, without ears.

    Attributes:
        center: (3,) m.
    """

    def __init__(self, body: Body, head: HeadMap) -> None:
        self.center = head.center
        from_center = body.positions - self.center
        radius = np.linalg.norm(from_center, axis=1)
        scalp = np.where(_is_scalp(body, head, from_center))[0]
        tree = cKDTree(from_center[scalp] / radius[scalp][:, None])
        elevations = np.linspace(-90, 90, _ELEVATIONS)
        azimuths = np.linspace(-180, 180, _AZIMUTHS, endpoint=False)
        directions = direction(*np.meshgrid(elevations, azimuths, indexing="ij"))
        nearest = tree.query(directions.reshape(-1, 3), k=8)[1]
        radii = radius[scalp][nearest].mean(1).reshape(_ELEVATIONS, _AZIMUTHS)
        # three times around, so that a look-up never meets the seam at the back
        self._radii = np.concatenate([gaussian_filter(radii, (1.3, 2.0), mode=("nearest", "wrap"))] * 3, 1)

    def radius(self, directions: Array) -> Array:
        """The distance of the scalp in these directions (..., 3), m."""
        if directions.ndim == 1:
            return self.radius(directions[None])[0]
        d = unit(directions)
        elevation = np.degrees(np.arcsin(np.clip(d[..., 1], -1, 1)))
        azimuth = np.degrees(np.arctan2(d[..., 0], d[..., 2]))
        row = (elevation + 90) / 180 * (_ELEVATIONS - 1)
        column = (azimuth + 180) / 360 * _AZIMUTHS + _AZIMUTHS
        return map_coordinates(self._radii, [row, column], order=1, mode="nearest")


def _is_scalp(body: Body, head: HeadMap, from_center: Array) -> Mask:
    """The head's vertices that are no ear: neither by the picture, nor by their place in it, nor by where they are."""
    uv = np.zeros((len(body.positions), 2))
    uv[head.triangles] = head.body_uvs
    ears = gaussian_filter(body.mask("ears"), 8)
    ear = map_coordinates(ears, [(1 - uv[:, 1]) * len(ears), uv[:, 0] * len(ears)], order=1) >= 0.25
    ear |= uv[:, 0] < 0.2
    x, y, z = from_center.T
    ear |= (np.abs(x) > 0.071) & (np.abs(z) < 0.035) & (y < 0)
    return body.among(np.unique(head.triangles)) & ~ear
