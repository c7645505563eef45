"""Springs that keep physical joints within the limits of table 3.2 of the thesis."""

import math
from collections.abc import Sequence

import mujoco
import numpy as np

from reactive_realizer.physics.rotations import Array, lengths, long_way, swing_and_twist, turned_about_y
from reactive_realizer.physics.segments import LIMITS

_FREQUENCY = 60.0
"""Angular frequency at which a joint beyond a limit would swing about it without damping, rad/s."""

_DAMPED = 2.0
"""Damping of this swing in multiples of inertia and frequency: it does not overshoot."""

_YIELDING = 0.3
"""Time constant with which bounds return that yielded to the pose of an animation, s."""


class LimitSprings:
    """Springs at the limits of ball joints, which MuJoCo's limits of ball joints, a single angle, cannot express.

    A rotation is a twist about the long axis of the segment, y, followed by a swing about an axis in the x-z plane. The
    twist and both components of the swing have bounds of their own. (Components of the rotation vector as a whole would
    not do: an elbow that is bent and turned has one about z, about which it is stiff.) A joint beyond some bounds is
    pulled back by a critically damped spring, in proportion to the inertia that turns about the joint. The spring pulls
    with the force at the end of the period, as in a stable PD controller (Tan, Liu and Turk 2011), so that no stiffness
    makes it unstable: the part of this force that depends on velocities is damping, which MuJoCo integrates implicitly.

    Animations may turn joints beyond these bounds. The bounds yield to the first pose, and return gradually.

    Args:
        model: whose joints are named after the segments.
        inertia: that turns about each degree of freedom, kg m^2, (nv,).
        names: of the ball joints that are limited.
        first: generalized coordinates of the first pose, (nq,).
    """

    def __init__(self, model: mujoco.MjModel, inertia: Array, names: Sequence[str], first: Array) -> None:
        joints = [model.joint(name) for name in names]
        self._positions = np.array([joint.qposadr[0] + np.arange(4) for joint in joints], dtype=np.intp)
        self._degrees = np.array([joint.dofadr[0] + np.arange(3) for joint in joints], dtype=np.intp)
        self._lowest = np.radians([LIMITS[name].lowest for name in names])
        self._highest = np.radians([LIMITS[name].highest for name in names])
        self._inertia = inertia[self._degrees]
        self._slack = np.zeros_like(self._lowest)
        if self._degrees.size:
            self._slack = self._beyond(*swing_and_twist(first[self._positions]))

    def act(self, data: mujoco.MjData, period: float, torques: Array, damping: Array) -> None:
        """Add the torques, Nm, and the damping, Nms, of the springs in a state to arrays, (nv,).

        Args:
            data: the state.
            period: for which the torques stay, s.
            torques: on the degrees of freedom.
            damping: of the degrees of freedom.
        """
        if self._degrees.size:
            self._slack *= math.exp(-period / _YIELDING)
            swings, twists = swing_and_twist(data.qpos[self._positions])
            beyond = self._beyond(swings, twists)
            stiffness = self._inertia * _FREQUENCY**2
            torques[self._degrees] -= stiffness * turned_about_y(beyond, -twists[:, 1])
            damping[self._degrees] += (beyond != 0.0) * (stiffness * period + _DAMPED * _FREQUENCY * self._inertia)

    def _beyond(self, swings: Array, twists: Array) -> Array:
        """Return how far rotations are beyond the bounds, rad, in the axes after their twist, (N, 3).

        Of the two swings that give a rotation, one the long way round, the one nearer to the bounds counts: shoulders
        turn by more than half a turn.
        """
        lowest, highest = self._lowest + self._slack.clip(max=0.0), self._highest + self._slack.clip(min=0.0)
        vectors = swings + twists
        near: Array = vectors - vectors.clip(lowest, highest)
        if not near.any():
            return near
        vectors = long_way(swings) + twists
        far = vectors - vectors.clip(lowest, highest)
        nearer: Array = np.where(lengths(near) <= lengths(far), near, far)
        return nearer
