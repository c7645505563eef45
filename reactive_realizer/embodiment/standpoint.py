"""Where a figure stands in the world."""

from dataclasses import dataclass

from reactive_realizer.embodiment.quaternion import conjugate, from_axis_angle, rotate
from reactive_realizer.embodiment.vector import UP, ZERO, Vec3, add, subtract


@dataclass(frozen=True, slots=True)
class Standpoint:
    """Place and direction of a figure.

    Attributes:
        position: of the ground between its feet in the world, m.
        heading: its turn about the vertical, rad, by the right hand; at 0 it faces the world's +z, at pi/2 its +x.
    """

    position: Vec3 = ZERO
    heading: float = 0.0

    def to_figure(self, point: Vec3) -> Vec3:
        """A point of the world in the figure's frame."""
        return rotate(conjugate(from_axis_angle(UP, self.heading)), subtract(point, self.position))

    def to_world(self, point: Vec3) -> Vec3:
        """A point of the figure's frame in the world."""
        return add(rotate(from_axis_angle(UP, self.heading), point), self.position)
