"""A curve of rotations that leaves and arrives as other motions go on there."""

import math
from typing import NamedTuple

from reactive_realizer.embodiment.quaternion import Quat, difference, from_rotation_vector, multiply, power
from reactive_realizer.embodiment.vector import ZERO, Vec3, add, length, scale
from reactive_realizer.engines.animation.easing import minimum_jerk

_AFIELD = 0.5
"""rad; how far a velocity may carry a joint off its way, and an acceleration: else it would swing around itself."""

# The most of the polynomials by which they do.
_OF_VELOCITY = 0.1973
_OF_ACCELERATION = 0.01728


class End(NamedTuple):
    """One end of a curve over u from 0 to 1.

    Attributes:
        rotation: there.
        velocity: in the axes of the joint, rad per unit of u.
        acceleration: rad per unit of u, squared.
    """

    rotation: Quat
    velocity: Vec3 = ZERO
    acceleration: Vec3 = ZERO


class HermiteCurve:
    """A Hermite curve of rotations, of degree 5: it has rotation, velocity and acceleration of both its ends.

        q(u) = q0 exp(v0 H1(u) + a0 H2(u)) exp(w H3(u)) exp(a1 H2(1-u) - v1 H1(1-u)), exp(w) = q0^-1 q1

    with the quintic Hermite polynomials H1 = u (1-u)^3 (1 + 3u), H2 = u^2 (1-u)^3 / 2, and H3 minimum jerk. So curves
    of rotations are made of those of numbers, and keep their derivatives at the ends: M.-J. Kim, M.-S. Kim and S. Y.
    Shin, "A general construction scheme for unit quaternion curves with simple high order derivatives" (SIGGRAPH 1995).
    The curve of the thesis (4.2.4) is C2 between its ends and has their velocities; this one is C2 across them.

    Where there is much time, what a joint brings along is over before (`_lasts`): H1 and H2 are C2 there, too.
    """

    def __init__(self, start: End, goal: End) -> None:
        """A curve over u from 0 to 1."""
        self._start, self._goal = start, goal
        self._way = difference(start.rotation, goal.rotation)
        self._leaving, self._arriving = _lasts(start), _lasts(goal)

    def __call__(self, u: float) -> Quat:
        """The rotation at u."""
        leaving = from_rotation_vector(_carried(self._start, u, self._leaving, 1.0))
        arriving = from_rotation_vector(_carried(self._goal, 1.0 - u, self._arriving, -1.0))
        there = multiply(power(self._way, minimum_jerk(u)), arriving)
        return multiply(self._start.rotation, multiply(leaving, there))


def _lasts(end: End) -> float:
    """For how much of the curve its motion at an end counts."""
    velocity, acceleration = length(end.velocity), length(end.acceleration)
    by_velocity = _AFIELD / (_OF_VELOCITY * velocity) if velocity > 0.0 else 1.0
    by_acceleration = math.sqrt(_AFIELD / (_OF_ACCELERATION * acceleration)) if acceleration > 0.0 else 1.0
    return min(1.0, by_velocity, by_acceleration)


def _carried(end: End, distance: float, lasts: float, direction: float) -> Vec3:
    """How far off its way its motion at an end carries a joint.

    Args:
        end: which.
        distance: from there, u.
        lasts: for how much of u it does.
        direction: 1 away from the end, -1 toward it.
    """
    if distance >= lasts:
        return ZERO
    u = distance / lasts
    left = (1.0 - u) ** 3
    way = scale(end.velocity, direction * lasts * u * left * (1.0 + 3.0 * u))
    return add(way, scale(end.acceleration, 0.5 * lasts * lasts * u * u * left))
