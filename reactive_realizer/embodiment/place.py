"""Where a figure stands in the world: the origin and the heading of its own frame."""

import math
from dataclasses import dataclass
from functools import cached_property

from reactive_realizer.embodiment.quaternion import Quat, conjugate, from_axis_angle, rotate
from reactive_realizer.embodiment.vector import UP, ZERO, Vec3, add, subtract


@dataclass(frozen=True)
class Place:
    """A place on the ground.

    Attributes:
        position: in the world, m.
        heading: turn to the left, rad; 0 faces +z.
    """

    position: Vec3 = ZERO
    heading: float = 0.0

    @cached_property
    def turn(self) -> Quat:
        """Rotation from the axes of the figure to those of the world."""
        return from_axis_angle(UP, self.heading)

    def to_world(self, point: Vec3) -> Vec3:
        """Convert a point of the figure's frame to the world, m."""
        return add(self.position, rotate(self.turn, point))

    def to_own(self, point: Vec3) -> Vec3:
        """Convert a point of the world to the figure's frame, m."""
        return rotate(conjugate(self.turn), subtract(point, self.position))


def between_headings(start: float, goal: float) -> float:
    """Return the smaller turn from one heading to another, rad, -pi to pi; positive to the left."""
    return math.remainder(goal - start, 2.0 * math.pi)


def heading_of(x: float, z: float) -> float:
    """Return the heading of a direction over the ground, rad; 0 for +z, positive to the left."""
    return math.atan2(x, z)
