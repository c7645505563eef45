"""Commands of SmartBody that place pawns: things to look at, to point at and to reach for."""

import math
import re
from collections.abc import Mapping
from typing import Final, NamedTuple

from reactive_realizer.client.vh_message import VhMessage
from reactive_realizer.embodiment.quaternion import from_euler

_COMMAND: Final = "sbm"
_AXES: Final = "xyz"
_ANGLES: Final = "hpr"
"""Heading about y, pitch about x and roll about z, degrees; the roll is first, and the heading last."""
_INIT: Final = re.compile(r"pawn\s+(\S+)\s+init\b(.*)", re.DOTALL)
_SET: Final = re.compile(r"set\s+pawn\s+(\S+)\s+world[_-]offset\s(.*)", re.DOTALL)
_PLACE: Final = re.compile(r"\bloc\s+(\S+)\s+(\S+)\s+(\S+)")


class Pawn(NamedTuple):
    """A pawn that is placed.

    Attributes:
        name: of it.
        coordinates: those that the command gives: by axis (x, y, z), in the unit of the toolkit, and angles (h, p, r),
            degrees.
    """

    name: str
    coordinates: Mapping[str, float]

    @classmethod
    def of(cls, message: VhMessage) -> "Pawn | None":
        """The pawn of a command: ``pawn NAME init loc X Y Z``, or ``set pawn NAME world_offset x X h H``.

        Raises:
            ValueError: a coordinate is not a finite number.
        """
        if message.word != _COMMAND:
            return None
        if made := _INIT.match(message.argument):
            place = _PLACE.search(made[2])
            return cls(made[1], dict(zip(_AXES, map(_finite, place.groups() if place else "000"), strict=True)))
        if moved := _SET.match(message.argument):
            words = moved[2].split()
            given = zip(words[::2], words[1::2], strict=False)
            return cls(moved[1], {axis: _finite(value) for axis, value in given if axis in _AXES + _ANGLES})
        return None

    def after(self, before: "Pawn | None") -> "Pawn":
        """The pawn if it was somewhere before: coordinates that are not given stay."""
        return self if before is None else self._replace(coordinates={**before.coordinates, **self.coordinates})

    def place(self, unit: float) -> dict[str, list[float]] | list[float]:
        """Return its position as the protocol has it, with its orientation if any angle was given.

        Args:
            unit: of its coordinates, m.
        """
        position = [unit * self.coordinates.get(axis, 0.0) for axis in _AXES]
        if not self.coordinates.keys() & set(_ANGLES):
            return position
        heading, pitch, roll = (math.radians(self.coordinates.get(angle, 0.0)) for angle in _ANGLES)
        return {"position": position, "orientation": list(from_euler(pitch, heading, roll))}


def _finite(text: str) -> float:
    value = float(text)
    if not math.isfinite(value):
        raise ValueError(f"could not convert to a finite number: '{text}'")
    return value
