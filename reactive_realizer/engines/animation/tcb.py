"""Curves through keys with tension, continuity and bias.

D. Kochanek and R. Bartels, "Interpolating splines with local tension, continuity, and bias control" (SIGGRAPH 1984),
for numbers, and for rotations in the tangent space of each key, as EMBR does with the tangents of K. Shoemake's squad
(SIGGRAPH 1987).
"""

import math
from typing import Literal, NamedTuple

from reactive_realizer.embodiment.quaternion import Quat, from_rotation_vector
from reactive_realizer.embodiment.vector import ZERO, Vec3, add, cross, dot, scale

_SMALL = 1e-4
"""Angle below which a coefficient is taken from its series, rad."""


Side = Literal["arriving", "leaving"]
"""The side of a key: the way to it, or the way from it."""


class Tcb(NamedTuple):
    """How a curve passes a key; each number is from -1 to 1, and with 0, a curve is one of Catmull and Rom.

    Attributes:
        tension: 1 stops at the key, -1 doubles the speed there.
        continuity: other numbers than 0 make a corner.
        bias: -1 leaves the key toward the next one, 1 goes on from the one before and passes the key.
    """

    tension: float = 0.0
    continuity: float = 0.0
    bias: float = 0.0

    def shares(self, side: Side) -> tuple[float, float]:
        """Return the shares of the way before a key and of the way after it in the tangent on one side of the key."""
        corner = self.continuity if side == "arriving" else -self.continuity
        slack = 0.5 * (1.0 - self.tension)
        return slack * (1.0 - corner) * (1.0 + self.bias), slack * (1.0 + corner) * (1.0 - self.bias)


class Corner(NamedTuple):
    """A key of rotations between two others.

    Attributes:
        before: way from the key before, as a rotation vector in the axes of the joint, the same at both its ends, rad.
        after: way to the key after it.
        durations: of these ways, s.
    """

    before: Vec3
    after: Vec3
    durations: tuple[float, float]

    def tangent(self, tcb: Tcb, side: Side) -> Vec3:
        """Return the velocity on one side of the key, in the axes of the joint there, rad per duration of that way.

        It is corrected for unequal durations, so that both sides have the same velocity if continuity is 0.
        """
        before, after = tcb.shares(side)
        own = self.durations[0] if side == "arriving" else self.durations[1]
        return scale(add(scale(self.before, before), scale(self.after, after)), 2.0 * own / sum(self.durations))


def turn_on_way(way: Vec3, u: float, leaving: Vec3 = ZERO, arriving: Vec3 = ZERO) -> Quat:
    """Return the turn at u, 0 to 1, of the cubic from one rotation to another.

    The cubic is one of rotation vectors from the start (F. Park and B. Ravani, "Smooth invariant interpolation of
    rotations", ACM Transactions on Graphics 16, 1997).

    Args:
        way: to the other rotation, as a rotation vector, rad.
        u: share of the time.
        leaving: velocity at 0, in the axes of the joint there, rad per unit of u.
        arriving: velocity at 1, in the axes of the joint there, rad per unit of u.
    """
    left = 1.0 - u
    turned = scale(way, u * u * (3.0 - 2.0 * u))
    turned = add(turned, scale(leaving, u * left * left))
    turned = add(turned, scale(_rate(way, arriving), -u * u * left))
    return from_rotation_vector(turned)


def _rate(way: Vec3, velocity: Vec3) -> Vec3:
    """Return the rate of change of a rotation vector at a velocity in the axes of the turned joint.

    It is the inverse right Jacobian of the exponential map.
    """
    angle = math.sqrt(dot(way, way))
    factor = 1.0 / 12.0 if angle < _SMALL else 1.0 / (angle * angle) - 0.5 / (angle * math.tan(0.5 * angle))
    across = cross(way, velocity)
    return add(velocity, add(scale(across, 0.5), scale(cross(way, across), factor)))
