"""Commands of SmartBody that place pawns: things to look at, to point at and to reach for."""

import math
import re
from collections.abc import Mapping
from typing import Final, NamedTuple

from reactive_realizer.client.vh_message import VhMessage

_COMMAND: Final = "sbm"
_AXES: Final = "xyz"
_INIT: Final = re.compile(r"pawn\s+(\S+)\s+init\b(.*)", re.DOTALL)
_SET: Final = re.compile(r"set\s+pawn\s+(\S+)\s+world[_-]offset\s(.*)", re.DOTALL)
_PLACE: Final = re.compile(r"\bloc\s+(\S+)\s+(\S+)\s+(\S+)")


class Pawn(NamedTuple):
    """A pawn that is placed.

    Attributes:
        name: of it.
        coordinates: by axis, those that the command gives, in the unit of the toolkit.
    """

    name: str
    coordinates: Mapping[str, float]

    @classmethod
    def of(cls, message: VhMessage) -> "Pawn | None":
        """The pawn of a command: ``pawn NAME init loc X Y Z``, or ``set pawn NAME world_offset x X y Y z Z``.

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
            return cls(moved[1], {axis: _finite(value) for axis, value in given if axis in _AXES})
        return None

    def placed(self, before: tuple[float, ...]) -> tuple[float, ...]:
        """Where it is, (3,), if it was somewhere before: the coordinates that are not given stay."""
        return tuple(self.coordinates.get(axis, old) for axis, old in zip(_AXES, before, strict=True))


def _finite(text: str) -> float:
    value = float(text)
    if not math.isfinite(value):
        raise ValueError(f"could not convert to a finite number: '{text}'")
    return value
