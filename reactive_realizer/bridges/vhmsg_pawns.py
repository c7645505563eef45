"""Commands of SmartBody that place pawns: things to look at, to point at and to reach for."""

import logging
import math
import re
from collections.abc import Mapping
from typing import Final, NamedTuple

from reactive_realizer.client.vh_message import VhMessage
from reactive_realizer.embodiment.quaternion import from_euler
from reactive_realizer.errors import quoted

_COMMAND: Final = "sbm"
_AXES: Final = "xyz"
_ANGLES: Final = "hpr"
"""Heading about y, pitch about x and roll about z, degrees; the roll is first, and the heading last."""
_INIT: Final = re.compile(r"pawn\s+(\S+)\s+init\b(.*)", re.DOTALL)
_SET: Final = re.compile(r"set\s+pawn\s+(\S+)\s+world[_-]offset\b(.*)", re.DOTALL)
_OF_PAWN: Final = re.compile(r"(?:set\s+)?pawn\s")
_PLACE: Final = re.compile(r"\bloc\b\s*(\S*)\s*(\S*)\s*(\S*)")
_OFFSET: Final = re.compile(rf"(\S+)(?:\s+(?![{_AXES}{_ANGLES}](?!\S))(\S+))?")
"""A coordinate with its value, which may be missing."""

logger = logging.getLogger(__name__)


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

        What cannot be read of it is left out, with a log message.

        Raises:
            ValueError: a coordinate of the place is not a finite number, or no offset can be read; or the command does
                something else with a pawn.
        """
        if message.word != _COMMAND:
            return None
        if made := _INIT.match(message.argument):
            place = _PLACE.search(made[2])
            if place is not None and not place[3]:
                raise ValueError("loc requires three numbers")
            if others := _PLACE.sub("", made[2], 1).split():
                logger.warning("only loc of the pawn '%s' is read, not %s", quoted(made[1]), quoted(" ".join(others)))
            return cls(made[1], dict(zip(_AXES, map(_finite, place.groups() if place else "000"), strict=True)))
        if moved := _SET.match(message.argument):
            return cls(moved[1], _offsets(moved[1], moved[2]))
        if _OF_PAWN.match(message.argument):
            raise ValueError("only init and world_offset do this")
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


def _offsets(pawn: str, text: str) -> dict[str, float]:
    """The coordinates of a ``world_offset`` that can be read.

    Raises:
        ValueError: there is none.
    """
    offsets: dict[str, float] = {}
    for coordinate, value in _OFFSET.findall(text):
        try:
            offsets[coordinate] = _offset(coordinate, value)
        except ValueError as problem:
            logger.warning("an offset of the pawn '%s' is left out: %s", quoted(pawn), problem)
    if not offsets:
        raise ValueError("world_offset has no coordinate that can be read")
    return offsets


def _offset(coordinate: str, value: str) -> float:
    known = (*_AXES, *_ANGLES)
    if coordinate not in known:
        raise ValueError(f"there is no coordinate '{quoted(coordinate)}'; known: {', '.join(known)}")
    if not value:
        raise ValueError(f"'{coordinate}' has no value")
    return _finite(value)


def _finite(text: str) -> float:
    value = float(text)
    if not math.isfinite(value):
        raise ValueError(f"could not convert to a finite number: '{text}'")
    return value
