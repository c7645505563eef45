"""A curve of rotations that leaves and arrives with given velocities."""

from reactive_realizer.embodiment.quaternion import (
    Quat,
    conjugate,
    difference,
    from_rotation_vector,
    multiply,
    rotation_vector,
)
from reactive_realizer.embodiment.vector import Vec3, length, scale
from reactive_realizer.engines.animation.easing import smoothstep

_MOST = 3.0
"""rad; how far a velocity may carry the curve off its way: faster ones would swing a joint around itself."""


class HermiteCurve:
    """The Hermite quaternion curve of M.-J. Kim, M.-S. Kim and S. Y. Shin (SIGGRAPH 1995, section 4.2).

    q(u) = q0 exp(w1 b1(u)) exp(w2 b2(u)) exp(w3 b3(u)) with the cumulative cubic Bernstein polynomials
    b1 = 1 - (1-u)^3, b2 = 3u^2 - 2u^3, b3 = u^3: a cubic Bezier curve of rotations, smooth to any order between its
    ends. A third of the velocity at an end is the step of the curve there; w2 is what is left between the two.
    """

    def __init__(self, start: Quat, goal: Quat, leaving: Vec3, arriving: Vec3) -> None:
        """A curve over u from 0 to 1.

        Args:
            start: at 0.
            goal: at 1.
            leaving: velocity at 0, rad per unit of u, in the axes of the joint.
            arriving: velocity at 1.
        """
        self._start = start
        self._leaving, self._arriving = _third(leaving), _third(arriving)
        there = difference(from_rotation_vector(self._leaving), difference(start, goal))
        self._between = rotation_vector(multiply(there, conjugate(from_rotation_vector(self._arriving))))

    def __call__(self, u: float) -> Quat:
        """The rotation at u."""
        left = 1.0 - u
        steps = (
            scale(self._leaving, 1.0 - left * left * left),
            scale(self._between, smoothstep(u)),
            scale(self._arriving, u * u * u),
        )
        rotation = self._start
        for step in steps:
            rotation = multiply(rotation, from_rotation_vector(step))
        return rotation


def _third(velocity: Vec3) -> Vec3:
    far = length(velocity)
    return scale(velocity, min(1.0, _MOST / far) / 3.0) if far > 0.0 else velocity
