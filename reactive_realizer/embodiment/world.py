"""The targets that behaviors look and point at."""

import re
from collections.abc import Iterable, Mapping
from typing import Protocol

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.vector import Vec3

_NUMBER = re.compile(r"[+-]?(?:[0-9]{1,6}(?:\.[0-9]*)?|\.[0-9]+)")


class Locate(Protocol):
    """Returns the position of a character or of one of its joints, now or at a time (`Humanoid.locate`)."""

    def __call__(self, joint: str | None, time: GlobalTime | None = None) -> Vec3 | None:
        """The position in the world, m; None if there is no such joint."""
        ...


class World:
    """Named positions: right-handed, m, y up; a character with heading 0 faces +z.

    Args:
        positions: of the fixed targets.
    """

    def __init__(self, positions: Mapping[str, Vec3]) -> None:
        self._positions: dict[str, Vec3] = dict(positions)
        self._living: dict[str, Locate] = {}

    def add_character(self, character: str, locate: Locate) -> None:
        """Make a character a target."""
        self._living[character] = locate

    def move(self, target: str, position: Vec3 | None) -> None:
        """Move a target; None removes it."""
        if position is None:
            self._positions.pop(target, None)
        else:
            self._positions[target] = position

    def position(self, target: str, time: GlobalTime | None = None) -> Vec3 | None:
        """Return the position of a target, m; None if it is unknown.

        ``alice`` is her eyes, ``alice:l_wrist`` a joint, and ``0.5 1.6 2`` the point with these coordinates.

        Args:
            target: its name.
            time: of a frame for which characters have not moved yet, so their positions are extrapolated; None for now.
        """
        character, _, joint = target.partition(":")
        if character in self._living:
            return self._living[character](joint or None, time)
        return self._positions.get(target) or _coordinates(target)

    def lives(self, target: str) -> bool:
        """Return whether a target is a character, and not one of its joints."""
        return target in self._living

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
