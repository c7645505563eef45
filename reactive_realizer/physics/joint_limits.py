"""Springs that keep physical joints within the limits of table 3.2 of the thesis."""

from collections.abc import Sequence

import mujoco
import numpy as np
from numpy.typing import NDArray

from reactive_realizer.physics.segments import LIMITS

_FREQUENCY = 60.0
"""Angular frequency at which a joint beyond a limit would swing about it without damping, rad/s."""

_DAMPED = 2.0
"""Damping of this swing in multiples of inertia and frequency: it does not overshoot."""

_NOTHING = 1e-12
"""A length below which a vector has no direction."""


class LimitSprings:
    """Springs at the limits of ball joints, which MuJoCo's limits of ball joints, a single angle, cannot express.

    Each component of a joint's rotation vector has its own bounds. A joint beyond some of them is pulled back by a
    critically damped spring, in proportion to the inertia that turns about the joint. The spring pulls with the force
    at the end of the step, as in a stable PD controller (Tan, Liu and Turk 2011), so that no stiffness makes it
    unstable: the part of this force that depends on velocities is damping, which MuJoCo integrates implicitly.

    Args:
        model: whose joints are named after the segments.
        inertia: that turns about each degree of freedom, kg m^2, (nv,).
        names: of the ball joints that are limited.
    """

    def __init__(self, model: mujoco.MjModel, inertia: NDArray[np.float64], names: Sequence[str]) -> None:
        joints = [model.joint(name) for name in names]
        self._positions = np.array([joint.qposadr[0] + np.arange(4) for joint in joints], dtype=np.intp)
        self._degrees = np.array([joint.dofadr[0] + np.arange(3) for joint in joints], dtype=np.intp)
        self._lowest = np.radians([LIMITS[name].lowest for name in names])
        self._highest = np.radians([LIMITS[name].highest for name in names])
        self._inertia = inertia[self._degrees]

    def act(self, data: mujoco.MjData, step: float, torques: NDArray[np.float64], damping: NDArray[np.float64]) -> None:
        """Add the torques, Nm, and the damping, Nms, of the springs in a state to arrays, (nv,).

        Args:
            data: the state.
            step: time of a step, s.
            torques: on the degrees of freedom.
            damping: of the degrees of freedom.
        """
        if self._degrees.size:
            beyond = self._beyond(_rotation_vectors(data.qpos[self._positions]))
            stiffness = self._inertia * _FREQUENCY**2
            torques[self._degrees] -= stiffness * beyond
            damping[self._degrees] += (beyond != 0.0) * (stiffness * step + _DAMPED * _FREQUENCY * self._inertia)

    def _beyond(self, vectors: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return how far rotation vectors are beyond the bounds, rad, (N, 3).

        Of the two vectors of a rotation, one the long way round, the one nearer to the bounds counts: shoulders turn by
        more than half a turn.
        """
        long: NDArray[np.float64] = vectors * (1.0 - 2.0 * np.pi / np.maximum(_lengths(vectors), _NOTHING))
        near, far = (each - each.clip(self._lowest, self._highest) for each in (vectors, long))
        beyond: NDArray[np.float64] = np.where(_lengths(near) <= _lengths(far), near, far)
        return beyond


def _rotation_vectors(rotations: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the rotation vectors of unit quaternions w x y z, the short way round, rad, (N, 3)."""
    cosines, axes = rotations[:, :1], rotations[:, 1:]
    sines = np.maximum(_lengths(axes), _NOTHING)
    factors: NDArray[np.float64] = np.copysign(2.0 * np.arctan2(sines, np.abs(cosines)) / sines, cosines)
    return factors * axes


def _lengths(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    squares: NDArray[np.float64] = np.einsum("ij,ij->i", vectors, vectors)
    return np.sqrt(squares)[:, np.newaxis]
