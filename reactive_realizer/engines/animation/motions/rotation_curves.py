"""Curves of rotations from one end to another, by the names of BML's transitions."""

import math
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import NamedTuple

from reactive_realizer.embodiment.quaternion import (
    IDENTITY,
    Quat,
    difference,
    from_rotation_vector,
    multiply,
    power,
    rotation_vector,
    slerp,
)
from reactive_realizer.embodiment.vector import ZERO, Vec3, add, length, scale
from reactive_realizer.engines.animation.easing import minimum_jerk

_AFIELD = 0.5
"""Limit of the deviation that the velocity or acceleration of an end may cause, rad; otherwise the joint would loop."""

# The maxima of the polynomials that scale them.
_OF_VELOCITY = 0.1973
_OF_ACCELERATION = 0.01728


class CurveEnd(NamedTuple):
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
    """A quintic Hermite curve of rotations: it has the rotation, velocity and acceleration of both its ends.

        q(u) = q0 exp(v0 H1(u) + a0 H2(u)) exp(w H3(u)) exp(a1 H2(1-u) - v1 H1(1-u)), exp(w) = q0^-1 q1

    with the quintic Hermite polynomials H1 = u (1-u)^3 (1 + 3u), H2 = u^2 (1-u)^3 / 2, and H3 minimum jerk. Built from
    curves of numbers, it keeps their derivatives at the ends: M.-J. Kim, M.-S. Kim and S. Y. Shin, "A general
    construction scheme for unit quaternion curves with simple high order derivatives" (SIGGRAPH 1995). The curve of the
    thesis (4.2.4) is C2 between its ends and has their velocities; this one is C2 across them.

    In a long transition, the motion of an end decays before the other end (`_span`); H1 and H2 are C2 there as well.
    """

    def __init__(self, start: CurveEnd, goal: CurveEnd) -> None:
        """Create a curve over u from 0 to 1."""
        self._start, self._goal = start, goal
        self._way = difference(start.rotation, goal.rotation)
        self._leaving, self._arriving = _span(start), _span(goal)

    def __call__(self, u: float) -> Quat:
        """Return the rotation at u."""
        leaving = from_rotation_vector(_carried(self._start, u, self._leaving, 1.0))
        arriving = from_rotation_vector(_carried(self._goal, 1.0 - u, self._arriving, -1.0))
        there = multiply(power(self._way, minimum_jerk(u)), arriving)
        return multiply(self._start.rotation, multiply(leaving, there))


def _span(end: CurveEnd) -> float:
    """Return the share of the curve that the motion of an end affects."""
    velocity, acceleration = length(end.velocity), length(end.acceleration)
    by_velocity = _AFIELD / (_OF_VELOCITY * velocity) if velocity > 0.0 else 1.0
    by_acceleration = math.sqrt(_AFIELD / (_OF_ACCELERATION * acceleration)) if acceleration > 0.0 else 1.0
    return min(1.0, by_velocity, by_acceleration)


def _carried(end: CurveEnd, distance: float, span: float, direction: float) -> Vec3:
    """Return the deviation from the direct path that the motion of an end causes.

    Args:
        end: of the curve.
        distance: from the end, u.
        span: share of u that it affects.
        direction: 1 away from the end, -1 toward it.
    """
    if distance >= span:
        return ZERO
    u = distance / span
    left = (1.0 - u) ** 3
    way = scale(end.velocity, direction * span * u * left * (1.0 + 3.0 * u))
    return add(way, scale(end.acceleration, 0.5 * span * span * u * u * left))


Curve = Callable[[float], Quat]
"""Returns the rotation at a phase, 0 to 1."""

CurveKind = Callable[[CurveEnd, CurveEnd], Curve]
"""Creates a curve from one end to another."""


def slerped(start: CurveEnd, goal: CurveEnd) -> Curve:
    """Return a curve along the shortest arc, from rest to rest; velocities of the ends are ignored."""
    return lambda phase: slerp(start.rotation, goal.rotation, minimum_jerk(phase))


CURVES: Mapping[str, CurveKind] = MappingProxyType(
    {
        "SlerpTransition": slerped,
        "SlerpTransitionMU": slerped,
        "SlerpTransitionToPoseMU": slerped,
        "TransitionMU": slerped,
        "HermiteTransition": HermiteCurve,
        "HermiteTransitionMU": HermiteCurve,
    }
)
"""Kinds of curves by class name: those of the thesis (4.2.4), and AsapRealizer's names for them."""


class GrowingArcs:
    """Arcs from rotations of joints to goals that move: the shorter ones at first.

    An arc that has grown to more than half a turn goes on growing; the shorter one would jump to the other side.
    """

    def __init__(self) -> None:
        self._turns: dict[str, Quat] = {}

    def way(self, joint: str, start: Quat, goal: Quat) -> Vec3:
        """Return the arc of a joint as a rotation vector, rad."""
        turn = difference(start, goal)
        last = self._turns.get(joint, IDENTITY)
        if turn[0] * last[0] + turn[1] * last[1] + turn[2] * last[2] + turn[3] * last[3] < 0.0:
            turn = (-turn[0], -turn[1], -turn[2], -turn[3])
        self._turns[joint] = turn
        if turn[0] >= 0.0:
            return rotation_vector(turn)
        sine = math.sqrt(turn[1] * turn[1] + turn[2] * turn[2] + turn[3] * turn[3])
        return scale((turn[1], turn[2], turn[3]), 2.0 * math.atan2(sine, turn[0]) / sine)

    def __call__(self, joint: str, start: Quat, goal: Quat, done: float) -> Quat:
        """Return the rotation of a joint after a share of its arc."""
        way = self.way(joint, start, goal)
        if self._turns[joint][0] >= 0.0:
            return slerp(start, goal, done)
        return multiply(start, from_rotation_vector(scale(way, done)))
