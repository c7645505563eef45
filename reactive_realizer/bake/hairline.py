"""The hairline."""

import numpy as np

from reactive_realizer.bake.characters import HairStyle
from reactive_realizer.bake.numeric import Array, Field

_HAIRLINES: dict[HairStyle, tuple[list[float], list[float]]] = {
    # degrees of azimuth from the front (0) to the nape (180), and of elevation there, seen from the middle of the skull
    HairStyle.BOB: ([0, 25, 45, 62, 80, 100, 130, 180], [26, 25, 18, 4, -13, -13, -31, -36]),
    HairStyle.CROP: (
        [0, 22, 40, 52, 63, 70, 74, 77, 82, 104, 113, 125, 180],
        [25, 24.5, 21, 13, 3, -9, -22, -23, -17, -20, -31, -39, -44],
    ),
}


def scalp(style: HairStyle, center: Array) -> Field:
    """The height of a point above the hairline, in degrees of elevation around the middle of the skull."""
    azimuths, elevations = _HAIRLINES[style]

    def above_hairline(points: Array) -> Array:
        d = points - center
        azimuth = np.degrees(np.abs(np.arctan2(d[..., 0], d[..., 2])))
        elevation = np.degrees(np.arctan2(d[..., 1], np.hypot(d[..., 0], d[..., 2])))
        return elevation - np.interp(azimuth, azimuths, elevations)

    return above_hairline
