"""Springs that keep physical joints within the limits of table 3.2 of the thesis."""

import math

from reactive_realizer.embodiment.quaternion import Quat
from reactive_realizer.embodiment.vector import ZERO, Vec3, length, scale
from reactive_realizer.physics.rotations import long_way, swing_and_twist, turned_about_y
from reactive_realizer.physics.segments import JointLimits

_FREQUENCY = 60.0
"""Angular frequency at which a joint beyond a limit would swing about it without damping, rad/s."""

_DAMPED = 2.0
"""Damping of this swing in multiples of inertia and frequency: it does not overshoot."""

_YIELDING = 0.3
"""Time constant with which bounds return that yielded to the pose of an animation, s."""

_SLIGHT = 1e-4
"""What is left of this yielding when it ends, rad."""


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
        self._limits = tuple(tuple(map(math.radians, bounds)) for bounds in (limits.lowest, limits.highest))
        x, y, z = inertia
        self._stiffness = (x * _FREQUENCY**2, y * _FREQUENCY**2, z * _FREQUENCY**2)
        self._yield(ZERO)
        self._yield(self._beyond(swing_and_twist(first)))

    def _yield(self, slack: Vec3) -> None:
        """Let bounds yield, the lower ones by what is negative, rad, and the upper ones by what is positive."""
        lowest, highest = self._limits
        self._slack = slack
        self._lowest = tuple([low + min(more, 0.0) for low, more in zip(lowest, slack, strict=True)])
        self._highest = tuple([high + max(more, 0.0) for high, more in zip(highest, slack, strict=True)])

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
            left = math.exp(-period / _YIELDING)
            self._yield(scale(self._slack, left) if length(self._slack) > _SLIGHT else ZERO)
        parts = swing_and_twist(rotation)
        beyond = self._beyond(parts)
        if beyond == ZERO:
            return
        of_x, of_y, of_z = self._stiffness
        x, y, z = turned_about_y(beyond, -parts[1])
        torques[first] -= of_x * x
        torques[first + 1] -= of_y * y
        torques[first + 2] -= of_z * z
        damped = period + _DAMPED / _FREQUENCY
        # The axes of the swing are those of the degrees of freedom before the twist: each damps its part about both.
        share = math.cos(parts[1]) ** 2
        about_x, about_z = float(beyond[0] != 0.0), float(beyond[2] != 0.0)
        damping[first] += of_x * damped * (share * about_x + (1.0 - share) * about_z)
        if beyond[1]:
            damping[first + 1] += of_y * damped
        damping[first + 2] += of_z * damped * (share * about_z + (1.0 - share) * about_x)

    def _beyond(self, parts: Vec3) -> Vec3:
        """Return how far a rotation is beyond the bounds, rad, in the axes after its twist.

        Of the two swings that give a rotation, one the long way round, the one nearer to the bounds counts: shoulders
        turn by more than half a turn. No bounds are nearer to the long way round of a swing by less than a quarter.
        """
        near = self._outside(parts)
        if near == ZERO or math.hypot(parts[0], parts[2]) < math.pi / 2.0:
            return near
        far = self._outside(long_way(parts))
        return near if length(near) <= length(far) else far

    def _outside(self, parts: Vec3) -> Vec3:
        # Not in a loop, which takes twice as long: it is called nine times in each frame of a conductor.
        x, y, z = parts
        low_x, low_y, low_z = self._lowest
        high_x, high_y, high_z = self._highest
        return (
            x - low_x if x < low_x else x - high_x if x > high_x else 0.0,
            y - low_y if y < low_y else y - high_y if y > high_y else 0.0,
            z - low_z if z < low_z else z - high_z if z > high_z else 0.0,
        )
