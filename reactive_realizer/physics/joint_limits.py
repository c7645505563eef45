"""Springs that keep physical joints within the limits of table 3.2 of the thesis."""

from collections.abc import Sequence

import mujoco
import numpy as np

from reactive_realizer.physics.rotations import Array, lengths, long_way, rotation_vectors
from reactive_realizer.physics.segments import LIMITS

_FREQUENCY = 60.0
"""Angular frequency at which a joint beyond a limit would swing about it without damping, rad/s."""

_DAMPED = 2.0
"""Damping of this swing in multiples of inertia and frequency: it does not overshoot."""


class LimitSprings:
    """Springs at the limits of ball joints, which MuJoCo's limits of ball joints, a single angle, cannot express.

    Each component of a joint's rotation vector has its own bounds. A joint beyond some of them is pulled back by a
    critically damped spring, in proportion to the inertia that turns about the joint. The spring pulls with the force
    at the end of the period, as in a stable PD controller (Tan, Liu and Turk 2011), so that no stiffness makes it
    unstable: the part of this force that depends on velocities is damping, which MuJoCo integrates implicitly.

    Args:
        model: whose joints are named after the segments.
        inertia: that turns about each degree of freedom, kg m^2, (nv,).
        names: of the ball joints that are limited.
    """

    def __init__(self, model: mujoco.MjModel, inertia: Array, names: Sequence[str]) -> None:
        joints = [model.joint(name) for name in names]
        self._positions = np.array([joint.qposadr[0] + np.arange(4) for joint in joints], dtype=np.intp)
        self._degrees = np.array([joint.dofadr[0] + np.arange(3) for joint in joints], dtype=np.intp)
        self._lowest = np.radians([LIMITS[name].lowest for name in names])
        self._highest = np.radians([LIMITS[name].highest for name in names])
        self._inertia = inertia[self._degrees]

    def act(self, data: mujoco.MjData, period: float, torques: Array, damping: Array) -> None:
        """Add the torques, Nm, and the damping, Nms, of the springs in a state to arrays, (nv,).

        Args:
            data: the state.
            period: for which the torques stay, s.
            torques: on the degrees of freedom.
            damping: of the degrees of freedom.
        """
        if self._degrees.size:
            beyond = self._beyond(rotation_vectors(data.qpos[self._positions]))
            stiffness = self._inertia * _FREQUENCY**2
            torques[self._degrees] -= stiffness * beyond
            damping[self._degrees] += (beyond != 0.0) * (stiffness * period + _DAMPED * _FREQUENCY * self._inertia)

    def _beyond(self, vectors: Array) -> Array:
        """Return how far rotation vectors are beyond the bounds, rad, (N, 3).

        Of the two vectors of a rotation, one the long way round, the one nearer to the bounds counts: shoulders turn by
        more than half a turn.
        """
        near: Array = vectors - vectors.clip(self._lowest, self._highest)
        if not near.any():
            return near
        long = long_way(vectors)
        far = long - long.clip(self._lowest, self._highest)
        beyond: Array = np.where(lengths(near) <= lengths(far), near, far)
        return beyond
