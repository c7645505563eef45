"""Where a figure stands in the world, the origin and the heading of its own frame, and where it is about to step."""

import math
from dataclasses import dataclass
from functools import cached_property

from reactive_realizer.embodiment.quaternion import Quat, conjugate, from_axis_angle, rotate
from reactive_realizer.embodiment.vector import UP, ZERO, Vec3, add, subtract
from reactive_realizer.embodiment.world import Ground


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


@dataclass(frozen=True, slots=True)
class Footprint:
    """A print of a foot on the ground.

    Attributes:
        place: the point below the ankle, and where the foot points.
        made: whether the foot stands there; otherwise it is on its way there.
    """

    place: Place
    made: bool


@dataclass(frozen=True, slots=True)
class PlannedSteps:
    """The path and the footprints of a figure that walks.

    Attributes:
        path: the points between which it goes straight on, from where it is to its goal; none if it goes nowhere.
        prints: of its left and its right foot; none if it does not walk.
    """

    path: tuple[Ground, ...] = ()
    prints: tuple[Footprint, ...] = ()


def between_headings(start: float, goal: float) -> float:
    """Return the smaller turn from one heading to another, rad, -pi to pi; positive to the left."""
    return math.remainder(goal - start, 2.0 * math.pi)


def heading_of(x: float, z: float) -> float:
    """Return the heading of a direction over the ground, rad; 0 for +z, positive to the left."""
    return math.atan2(x, z)
