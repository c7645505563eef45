"""Parts of rotations: the twist about the long axis of a segment, y, and the swing that follows it."""

import math

from reactive_realizer.embodiment.quaternion import Quat
from reactive_realizer.embodiment.vector import Vec3

_NOTHING = 1e-12
"""A length below which a vector has no direction."""


def swing_and_twist(rotation: Quat) -> Vec3:
    """Return the two parts of a rotation, both the short way round.

    The twist about y comes first, and is the second component, rad. The swing about an axis in the x-z plane follows;
    its rotation vector has the other two components, rad.
    """
    w, x, y, z = rotation
    cosine = max(math.sqrt(w * w + y * y), _NOTHING)
    c, s = w / cosine, y / cosine
    across, along = x * c + z * s, z * c - x * s
    sine = max(math.sqrt(across * across + along * along), _NOTHING)
    factor = 2.0 * math.atan2(sine, cosine) / sine
    return (factor * across, 2.0 * math.atan2(math.copysign(1.0, c) * s, abs(c)), factor * along)


def long_way(parts: Vec3) -> Vec3:
    """Return the parts of the same rotation with a swing the long way round."""
    x, twist, z = parts
    factor = 1.0 - 2.0 * math.pi / max(math.hypot(x, z), _NOTHING)
    return (x * factor, twist, z * factor)


def turned_about_y(vector: Vec3, angle: float) -> Vec3:
    """Return a vector turned about y by an angle, rad."""
    c, s = math.cos(angle), math.sin(angle)
    x, y, z = vector
    return (x * c + z * s, y, z * c - x * s)
