"""Springs that keep physical joints within the limits of table 3.2 of the thesis."""

import math

from reactive_realizer.embodiment.quaternion import Quat
from reactive_realizer.embodiment.vector import ZERO, Vec3, length, scale
from reactive_realizer.physics.rotations import SwingTwist, swing_and_twist, turned_about_y
from reactive_realizer.physics.segments import JointLimits

_FREQUENCY = 60.0
"""Angular frequency at which a joint beyond a limit would swing about it without damping, rad/s."""

_DAMPED = 2.0
"""Damping of this swing in multiples of inertia and frequency: it does not overshoot."""

_YIELDING = 0.3
"""Time constant with which bounds return that yielded to the pose of an animation, s."""


class LimitSpring:
    """A spring at the limits of a ball joint, which MuJoCo's limit of a ball joint, a single angle, cannot express.

    A rotation is a twist about the long axis of the segment, y, followed by a swing about an axis in the x-z plane. The
    twist and both components of the swing have bounds of their own. (Components of the rotation vector as a whole would
    not do: an elbow that is bent and turned has one about z, about which it is stiff.) A joint beyond some bounds is
    pulled back by a critically damped spring, in proportion to the inertia that turns about the joint. The spring pulls
    with the force at the end of the period, as in a stable PD controller (Tan, Liu and Turk 2011), so that no stiffness
    makes it unstable: the part of this force that depends on velocities is damping, which MuJoCo integrates implicitly.

    Animations may turn joints beyond these bounds. The bounds yield to the first pose, and return gradually.

    Args:
        limits: of the joint.
        inertia: that turns about its axes, kg m^2.
        first: rotation at first.
    """

    def __init__(self, limits: JointLimits, inertia: Vec3, first: Quat) -> None:
        lowest, highest = (tuple(map(math.radians, bounds)) for bounds in (limits.lowest, limits.highest))
        self._bounds = (*zip(lowest, highest, strict=True),)
        self._stiffness = tuple(each * _FREQUENCY**2 for each in inertia)
        self._slack = ZERO
        self._slack = self._beyond(swing_and_twist(first))

    def act(self, rotation: Quat, period: float, first: int, torques: list[float], damping: list[float]) -> None:
        """Add the torques, Nm, and the damping, Nms, of the spring to those of degrees of freedom.

        Args:
            rotation: of the joint.
            period: for which the torques stay, s.
            first: index of the first of the joint's degrees of freedom.
            torques: on all degrees of freedom, (nv,).
            damping: of all degrees of freedom, (nv,).
        """
        if self._slack != ZERO:
            self._slack = scale(self._slack, math.exp(-period / _YIELDING))
        parts = swing_and_twist(rotation)
        beyond = self._beyond(parts)
        if beyond == ZERO:
            return
        pulls = turned_about_y(beyond, -parts.twist)
        damped = period + _DAMPED / _FREQUENCY
        for axis, stiffness in enumerate(self._stiffness):
            torques[first + axis] -= stiffness * pulls[axis]
            if beyond[axis]:
                damping[first + axis] += stiffness * damped

    def _beyond(self, parts: SwingTwist) -> Vec3:
        """Return how far a rotation is beyond the bounds, rad, in the axes after its twist.

        Of the two swings that give a rotation, one the long way round, the one nearer to the bounds counts: shoulders
        turn by more than half a turn. No bounds are nearer to the long way round of a swing by less than a quarter.
        """
        near = self._outside(parts)
        if near == ZERO or math.hypot(parts.x, parts.z) < math.pi / 2.0:
            return near
        far = self._outside(parts.long_way())
        return near if length(near) <= length(far) else far

    def _outside(self, parts: SwingTwist) -> Vec3:
        x, y, z = map(_outside, parts, self._bounds, self._slack)
        return (x, y, z)


def _outside(value: float, bounds: tuple[float, float], slack: float) -> float:
    """Return how far a value is outside of bounds, of which the one in the direction of the slack yields by it."""
    low, high = bounds
    if value < low:
        return min(value - low - min(slack, 0.0), 0.0)
    if value > high:
        return max(value - high - max(slack, 0.0), 0.0)
    return 0.0
