"""Directions of axes of joints."""

import math
from typing import Final, NamedTuple

from reactive_realizer.embodiment.quaternion import Quat, angle, between, from_axis_angle, rotate
from reactive_realizer.embodiment.vector import Vec3, cross, dot, rejected

FAR: Final = 100.0
"""Distance of a point that stands for a direction, m."""


class Direction(NamedTuple):
    """A direction of a joint, such as a wrist.

    Attributes:
        axis: in the axes of the joint, a unit vector.
        way: in the figure's axes, a unit vector.
    """

    axis: Vec3
    way: Vec3

    def left(self, rotation: Quat) -> float:
        """Return by how much a joint has to turn further to have it, rad.

        Args:
            rotation: of the joint, from its axes to the figure's.
        """
        return angle(between(rotate(rotation, self.axis), self.way))


class Unturned(NamedTuple):
    """A joint that does not have its direction.

    Attributes:
        joint: H-Anim name.
        angle: from its direction, rad.
    """

    joint: str
    angle: float


def turn_about(axis: Vec3, rotation: Quat, direction: Direction) -> Quat:
    """Return the turn about an axis after which a joint has another direction as nearly as possible.

    Args:
        axis: in the figure's axes, a unit vector.
        rotation: of the joint, from its axes to the figure's.
        direction: that it is to have.
    """
    now, goal = rejected(rotate(rotation, direction.axis), axis), rejected(direction.way, axis)
    return from_axis_angle(axis, math.atan2(dot(cross(now, goal), axis), dot(now, goal)))
