"""Parts of rotations: the twist about the long axis of a segment, y, and the swing that follows it."""

import math
from typing import NamedTuple

from reactive_realizer.embodiment.quaternion import Quat
from reactive_realizer.embodiment.vector import Vec3

_NOTHING = 1e-12
"""A length below which a vector has no direction."""


class SwingTwist(NamedTuple):
    """A twist about y, followed by a swing about an axis in the x-z plane: its rotation vector, rad."""

    x: float
    twist: float
    z: float

    def long_way(self) -> "SwingTwist":
        """Return the same rotation with a swing the long way round."""
        factor = 1.0 - 2.0 * math.pi / max(math.hypot(self.x, self.z), _NOTHING)
        return SwingTwist(self.x * factor, self.twist, self.z * factor)


def swing_and_twist(rotation: Quat) -> SwingTwist:
    """Return the two parts of a rotation, both the short way round."""
    w, x, y, z = rotation
    cosine = max(math.hypot(w, y), _NOTHING)
    c, s = w / cosine, y / cosine
    across, along = x * c + z * s, z * c - x * s
    sine = max(math.hypot(across, along), _NOTHING)
    factor = 2.0 * math.atan2(sine, cosine) / sine
    return SwingTwist(factor * across, 2.0 * math.atan2(math.copysign(1.0, c) * s, abs(c)), factor * along)


def turned_about_y(vector: Vec3, angle: float) -> Vec3:
    """Return a vector turned about y by an angle, rad."""
    c, s = math.cos(angle), math.sin(angle)
    x, y, z = vector
    return (x * c + z * s, y, z * c - x * s)
