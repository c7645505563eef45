"""The targets that behaviors look and point at."""

import re
from collections.abc import Iterable, Iterator, Mapping
from types import MappingProxyType
from typing import NamedTuple, Protocol

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.joints import ROOT
from reactive_realizer.embodiment.quaternion import Quat
from reactive_realizer.embodiment.vector import Vec3

_NUMBER = re.compile(r"[+-]?(?:[0-9]{1,6}(?:\.[0-9]*)?|\.[0-9]+)")


_AROUND = 0.3
"""Radius of the space that a body needs, with its arms at its sides, m."""

Ground = tuple[float, float]
"""A point on the ground: x and z in the world, m."""


class Obstacle(NamedTuple):
    """A disk on the ground that nobody walks through.

    Attributes:
        place: its center.
        radius: m.
    """

    place: Ground
    radius: float


class Locate(Protocol):
    """Returns the position of a character or of one of its joints, now or at a time (`Humanoid.locate`)."""

    def __call__(self, joint: str | None, time: GlobalTime | None = None) -> Vec3 | None:
        """The position in the world, m; None if there is no such joint."""
        ...


class World:
    """Named positions: right-handed, m, y up; a character with heading 0 faces +z. Targets may have an orientation.

    Args:
        positions: of the fixed targets.
        radii: of those that figures walk around, m.
    """

    def __init__(self, positions: Mapping[str, Vec3], radii: Mapping[str, float] = MappingProxyType({})) -> None:
        self._positions: dict[str, Vec3] = dict(positions)
        self._orientations: dict[str, Quat] = {}
        self._radii = radii
        self._living: dict[str, Locate] = {}
        self._carried: dict[str, str] = {}

    def add_character(self, character: str, locate: Locate) -> None:
        """Make a character a target."""
        self._living[character] = locate

    def move(self, target: str, position: Vec3 | None, orientation: Quat | None = None) -> None:
        """Move a target; without a position, remove it. It is no longer carried.

        Args:
            target: its name.
            position: m.
            orientation: a unit quaternion; None to keep the one that it has.
        """
        self._carried.pop(target, None)
        if position is None:
            self._positions.pop(target, None)
            self._orientations.pop(target, None)
            return
        self._positions[target] = position
        if orientation is not None:
            self._orientations[target] = orientation

    def carry(self, target: str, joint: str) -> None:
        """Let a target that is no character follow a joint of one, ``alice:r_wrist``, until it is moved or put down."""
        if target in self._positions:
            self._carried[target] = joint

    def put_down(self, joint: str, place: Vec3) -> None:
        """Leave what follows a joint at a place, m."""
        for target in [target for target, carrier in self._carried.items() if carrier == joint]:
            self.move(target, place)

    def let_go(self, joint: str) -> None:
        """Leave what follows a joint where it is."""
        place = self.position(joint)
        if place is not None:
            self.put_down(joint, place)

    def position(self, target: str, time: GlobalTime | None = None) -> Vec3 | None:
        """Return the position of a target, m; None if it is unknown.

        ``alice`` is her eyes, ``alice:l_wrist`` a joint, and ``0.5 1.6 2`` the point with these coordinates.

        Args:
            target: its name.
            time: of a frame for which characters have not moved yet, so their positions are extrapolated; None for now.
        """
        target = self._carried.get(target, target)
        character, _, joint = target.partition(":")
        if character in self._living:
            return self._living[character](joint or None, time)
        return self._positions.get(target) or _coordinates(target)

    def orientation(self, target: str) -> Quat | None:
        """Return the orientation of a target, a unit quaternion from its axes to those of the world.

        Returns:
            None if it has none: it was given none, or it is a character or a place. What is carried keeps its own.
        """
        return self._orientations.get(target)

    def lives(self, target: str) -> bool:
        """Return whether a target is a character, and not one of its joints."""
        return target in self._living

    def radius(self, target: str) -> float:
        """Return the radius of the space on the ground that a target takes, m; 0 if none."""
        return _AROUND if self.lives(target) else self._radii.get(target, 0.0)

    def obstacles(self, character: str) -> Iterator[Obstacle]:
        """Yield where the middle of a character cannot be: at objects with a radius, and at other characters."""
        middles = {target: self.position(target) for target in self._radii}
        middles |= {other: locate(ROOT) for other, locate in self._living.items() if other != character}
        for target, position in middles.items():
            radius = self.radius(target)
            if position is not None and radius > 0.0:
                yield Obstacle((position[0], position[2]), radius + _AROUND)

    @property
    def targets(self) -> Iterable[str]:
        """Names of all targets, without joints."""
        return (*self._positions, *self._living)

    def snapshot(self) -> dict[str, Vec3]:
        """Return all targets with their positions."""
        known = ((target, self.position(target)) for target in self.targets)
        return {target: position for target, position in known if position is not None}


def _coordinates(target: str) -> Vec3 | None:
    """The position that a target writes as three numbers."""
    words = target.split()
    if len(words) != 3 or not all(map(_NUMBER.fullmatch, words)):
        return None
    x, y, z = map(float, words)
    return (x, y, z)
