"""Where a locomotion leads: to a target, as near as it is to come, facing what it is to face."""

import math
import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import NamedTuple

from reactive_realizer.embodiment.place import Place, between_headings, heading_of
from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.embodiment.world import Ground, Obstacle, World
from reactive_realizer.engines.animation.faults import NoTarget, NotWalkable
from reactive_realizer.engines.animation.motion_parameters import parameter_values
from reactive_realizer.engines.animation.walking.route import length_of, route
from reactive_realizer.errors import RealizerError
from reactive_realizer.planunit.parameter import Range

DISTANCE, FACING, DIRECTION, WAY = "distance", "facing", "direction", "way"
"""Parameters: how far from the target to stop, m; what to face in the end, as a target or a heading in degrees; and,
without a target, the direction from where the figure faces, in degrees to the left, and how far to go there, m."""

FARTHEST = 100.0
"""Limit of the way to a target, m."""

_RANGES: Mapping[str, Range] = {
    DISTANCE: Range(0.0, FARTHEST),
    DIRECTION: Range(-360.0, 360.0),
    WAY: Range(0.0, FARTHEST),
}

_TO_CHARACTER, _TO_OBJECT, _TO_GROUND = 1.0, 0.5, 0.0
"""Usual distance from a character, an object, and a place on the ground, m. People who talk stand about a meter apart:
E. T. Hall, "The Hidden Dimension" (1966)."""

_COORDINATES = re.compile(r"\s*[-+.\deE]+(?:[\s,]+[-+.\deE]+){1,2}\s*")

_NOWHERE = 1e-3
"""A way that is shorter has no direction, m."""


class Way(NamedTuple):
    """A way over the ground.

    Attributes:
        start: where it begins.
        corners: between its straight legs.
        place: where it ends.
    """

    start: Place
    corners: tuple[Ground, ...]
    place: Place

    @property
    def length(self) -> float:
        """Its length, m."""
        return length_of(self._points)

    @property
    def directions(self) -> tuple[float, float]:
        """Headings of its first and its last leg, rad."""
        points = self._points
        first, last = ((b[0] - a[0], b[1] - a[1]) for a, b in (points[:2], points[-2:]))
        return heading_of(*first), heading_of(*last)

    @property
    def _points(self) -> tuple[Ground, ...]:
        return (ground_of(self.start), *self.corners, ground_of(self.place))


def ground_of(place: Place) -> Ground:
    """Return where a place is on the ground."""
    return place.position[0], place.position[2]


class WayBlocked(Exception):
    """Obstacles are on all ways to a destination."""


@dataclass(frozen=True, slots=True)
class Destination:
    """Where to go, seen from any place on the way.

    Attributes:
        point: returns the point on the ground to which the distance is kept; None while there is no such point.
        distance: at which to stop, m.
        facing: returns the heading in the end at a place, rad; None without one.
        turns: whether the figure faces the way that it goes, and so the target in the end.
        obstacles: returns those to go around.
    """

    point: Callable[[], Ground | None]
    distance: float
    facing: Callable[[Ground], float | None]
    turns: bool
    obstacles: Callable[[], Iterable[Obstacle]]

    def way_from(self, start: Place) -> Way | None:
        """Return the shortest way for a figure that is at a place; None if the destination is unknown now.

        Raises:
            WayBlocked: there is none.
        """
        place = self._place_from(start)
        if place is None:
            return None
        obstacles = tuple(self.obstacles())
        corners = around = self._corners(start, place, obstacles)
        if around:
            x, z = around[-1]
            place = self._place_from(Place((x, start.position[1], z), start.heading)) or place
            corners = self._corners(start, place, obstacles)
        return Way(start, corners, place)

    @staticmethod
    def _corners(start: Place, place: Place, obstacles: Iterable[Obstacle]) -> tuple[Ground, ...]:
        corners = route(ground_of(start), ground_of(place), obstacles)
        if corners is None:
            raise WayBlocked
        return corners

    def _place_from(self, start: Place) -> Place | None:
        """Return the place where a figure stops that comes straight from a place; None if that is unknown now."""
        goal = self.point()
        if goal is None:
            return None
        (x, y, z), (goal_x, goal_z) = start.position, goal
        near = math.hypot(goal_x - x, goal_z - z)
        direction = heading_of(goal_x - x, goal_z - z) if near > _NOWHERE else start.heading
        if near > self.distance:
            x, z = goal_x - self.distance * math.sin(direction), goal_z - self.distance * math.cos(direction)
        facing = self.facing((x, z))
        if facing is None:
            facing = direction if self.turns and max(near, self.distance) > _NOWHERE else start.heading
        return Place((x, y, z), start.heading + between_headings(start.heading, facing))


def destination(
    world: World, character: str, start: Place, target: str, parameters: Mapping[str, str], *, turns: bool
) -> Destination:
    """Return where a locomotion leads.

    Args:
        world: with the target.
        character: that goes.
        start: where it is expected to start.
        target: a name, two coordinates x and z, or three, in m; empty for a direction.
        parameters: of the behavior, as texts.
        turns: whether the figure faces the way that it goes.

    Raises:
        RealizerError: there is no such target, or it cannot be walked to; or a parameter has no valid value.
    """
    values = parameter_values(parameters, _RANGES)
    point, usual = _point(world, character, start, target, values)
    if (goal := point()) is not None:
        x, _, z = start.position
        way = math.hypot(goal[0] - x, goal[1] - z)
        if not way <= FARTHEST:
            raise RealizerError(
                NotWalkable(target=target, reason=f"it is {way:.3g} m away; the limit is {FARTHEST:g} m")
            )
    distance, facing = values.get(DISTANCE, usual), _facing(world, parameters.get(FACING))
    return Destination(point, distance, facing, turns, lambda: world.obstacles(character))


def _point(
    world: World, character: str, start: Place, target: str, values: Mapping[str, float]
) -> tuple[Callable[[], Ground | None], float]:
    if not target.strip():
        if DIRECTION not in values and WAY not in values:
            raise RealizerError(NotWalkable(target=target, reason="it has no name; name a target, or a direction"))
        heading = start.heading + math.radians(values.get(DIRECTION, 0.0))
        x, _, z = start.position
        way = values.get(WAY, 1.0)
        there = (x + way * math.sin(heading), z + way * math.cos(heading))
        return lambda: there, _TO_GROUND
    if _COORDINATES.fullmatch(target):
        spot = _coordinates(target)
        return lambda: spot, _TO_GROUND
    if target.partition(":")[0] == character:
        raise RealizerError(NotWalkable(target=target, reason="it is the character itself"))
    if world.position(target) is None:
        raise RealizerError(NoTarget(target=target, known=tuple(world.targets)))
    usual = _TO_CHARACTER if world.lives(target) else _TO_OBJECT + world.radius(target)
    return lambda: _over_ground(world.position(target)), usual


def _coordinates(text: str) -> Ground:
    try:
        numbers = [float(each) for each in re.split(r"[\s,]+", text.strip())]
    except ValueError:
        numbers = []
    if not numbers or not all(map(math.isfinite, numbers)):
        raise RealizerError(NotWalkable(target=text, reason="coordinates are two or three numbers"))
    return numbers[0], numbers[-1]


def _over_ground(position: Vec3 | None) -> Ground | None:
    return None if position is None else (position[0], position[2])


def _facing(world: World, text: str | None) -> Callable[[Ground], float | None]:
    if text is None:
        return lambda place: None
    try:
        heading = math.radians(float(text))
    except ValueError:
        return _facing_target(world, text)
    if not math.isfinite(heading):
        raise RealizerError(NotWalkable(target=text, reason="it is no heading"))
    return lambda place: heading


def _facing_target(world: World, target: str) -> Callable[[Ground], float | None]:
    if world.position(target) is None:
        raise RealizerError(NoTarget(target=target, known=tuple(world.targets)))

    def facing(place: Ground) -> float | None:
        position = world.position(target)
        if position is None:
            return None
        x, z = position[0] - place[0], position[2] - place[1]
        return heading_of(x, z) if math.hypot(x, z) > _NOWHERE else None

    return facing
