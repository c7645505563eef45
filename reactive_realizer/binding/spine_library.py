"""Reads libraries of Greta for movements of the head and the torso: points with tilts and rotations.

The formats are those of its files ``HeadGestures.xml`` and ``TorsoGestures.xml`` (https://github.com/isir/greta).
"""

import logging
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Final, NamedTuple

from reactive_realizer.binding.asset_file import XmlElement, asset_error, attribute, number, read_xml
from reactive_realizer.binding.faults import NotInLibrary
from reactive_realizer.embodiment.quaternion import Quat, normalize
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.file_cache import remembered

_log = logging.getLogger(__name__)

_ROOTS: Final = {"head": "HeadGestures", "torso": "TorsoGestures"}
"""Element of a movement -> that of the file."""
_TILTS: Final[Mapping[str, Mapping[str, tuple[int, float]]]] = MappingProxyType(
    {
        "SagittalTilt": {"FORWARD": (0, 1.0), "BACKWARD": (0, -1.0)},
        "VerticalTorsion": {"LEFTWARD": (1, 1.0), "RIGHTWARD": (1, -1.0)},
        "LateralRoll": {"RIGHTWARD": (2, 1.0), "LEFTWARD": (2, -1.0)},
    }
)
"""Element of a tilt -> direction -> its axis (left, up, ahead), and the sign of a rotation about it."""
_ROTATIONS: Final = "Rotations"
_SHORTEST: Final = 1e-6
"""A quaternion that is shorter is none."""
_MOST_POINTS: Final = 100
"""Points of a movement that are used."""
_MOST_REPEATS: Final = 20
"""Repetitions of a movement in a file that are used."""


class Tilt(NamedTuple):
    """A rotation about one axis.

    Attributes:
        axis: 0 to the left, 1 up, 2 ahead.
        least: share of the range of the joint at the amount 0, with its sign.
        most: the same at the amount 1.
    """

    axis: int
    least: float
    most: float


class SpinePoint(NamedTuple):
    """A point of a movement.

    Attributes:
        kind: "strokeStart", "stroke" or "strokeEnd"; empty for a pose that is taken and kept.
        tilts: of the head or the torso as a whole.
        rotations: of single joints, local to their parents.
    """

    kind: str
    tilts: tuple[Tilt, ...]
    rotations: tuple[tuple[str, Quat], ...]


class SpineMovement(NamedTuple):
    """A movement.

    Attributes:
        id: its name.
        lexeme: a word that several movements may share; empty for none.
        points: in order.
        repetition: how often they come.
        faults: of parts that cannot be read, which are left out.
    """

    id: str
    lexeme: str
    points: tuple[SpinePoint, ...]
    repetition: int
    faults: tuple[Fault, ...]


@dataclass(frozen=True, slots=True)
class SpineLibrary:
    """The movements of a file.

    Attributes:
        file: its name.
        part: "head" or "torso".
        movements: in order.
    """

    file: str
    part: str
    movements: tuple[SpineMovement, ...]

    @staticmethod
    @remembered
    def read(path: Path, part: str) -> "SpineLibrary":
        """Read a file. A movement that nothing can name is left out, and the log says so.

        Args:
            path: of the file.
            part: "head" or "torso".

        Raises:
            RealizerError: "bad-asset": it is no such library; "asset-too-big".
            OSError: the file cannot be read.
        """
        movements: list[SpineMovement] = []
        for element in read_xml(path, _ROOTS[part]).iterchildren(part):
            try:
                movements.append(_movement(element))
            except RealizerError as refused:
                _log.warning("%s; it is left out", refused.fault.sentence)
        return SpineLibrary(path.name, part, tuple(movements))

    def movement(self, name: str) -> SpineMovement:
        """Return the movement with an id, or else the first one with a lexeme; regardless of case, and `_` equals `-`.

        Raises:
            RealizerError: "not-in-library".
        """
        word = _word(name.rpartition("=")[2])
        by_id = (each for each in self.movements if _word(each.id) == word)
        by_lexeme = (each for each in self.movements if _word(each.lexeme) == word)
        found = next(by_id, None) or next(by_lexeme, None)
        if found is None:
            known = tuple(each.id for each in self.movements)
            raise RealizerError(NotInLibrary(file=self.file, element=self.part, name=name, known=known))
        return found


def _word(text: str) -> str:
    return text.strip().lower().replace("-", "_")


def _movement(element: XmlElement) -> SpineMovement:
    """Return a movement, with the faults of its parts.

    Raises:
        RealizerError: "bad-asset": it has no id, or its repetition is not a number.
    """
    faults: list[Fault] = []
    amount = number(element, "amount") if "amount" in element.attrib else 1.0
    points = list(element.iterchildren("KeyPoint"))
    if len(points) > _MOST_POINTS:
        faults.append(asset_error(element, f"{len(points)} points; the first {_MOST_POINTS} are used").fault)
    repetition = number(element, "repetition") if "repetition" in element.attrib else 1.0
    return SpineMovement(
        attribute(element, "id"),
        element.get("lexeme", ""),
        tuple(_point(point, amount, faults) for point in points[:_MOST_POINTS]),
        max(1, min(_MOST_REPEATS, round(repetition))),
        tuple(faults),
    )


def _point(element: XmlElement, amount: float, faults: list[Fault]) -> SpinePoint:
    """Return a point; the faults of its parts are added."""
    tilts: list[Tilt] = []
    rotations: dict[str, Quat] = {}
    for part in element:
        try:
            if part.tag == _ROTATIONS:
                rotations |= _rotations(part)
            else:
                tilts.append(_tilt(part, amount))
        except RealizerError as refused:
            faults.append(refused.fault)
    return SpinePoint(element.get("type", "").strip(), tuple(tilts), tuple(rotations.items()))


def _tilt(element: XmlElement, amount: float) -> Tilt:
    """Return a tilt; those of a torso are a share of their greatest one, those of a head between two.

    Raises:
        RealizerError: "bad-asset".
    """
    directions = _TILTS.get(str(element.tag))
    if directions is None:
        raise asset_error(element, f"known are {', '.join((*_TILTS, _ROTATIONS))}")
    direction = attribute(element, "direction")
    if direction.upper() not in directions:
        raise asset_error(element, f"direction='{direction}': known are {', '.join(directions)}")
    axis, sign = directions[direction.upper()]
    least, most = (
        number(element, name) if name in element.attrib else default for name, default in (("min", 0.0), ("max", 1.0))
    )
    return Tilt(axis, sign * amount * least, sign * amount * most)


def _rotations(element: XmlElement) -> Mapping[str, Quat]:
    return dict(_rotation(joint) for joint in element)


def _rotation(element: XmlElement) -> tuple[str, Quat]:
    """Return the rotation of a joint.

    Raises:
        RealizerError: "bad-asset": it is not a quaternion.
    """
    w, x, y, z = (number(element, name) for name in "wxyz")
    if math.hypot(w, x, y, z) < _SHORTEST:
        raise asset_error(element, "the quaternion is 0")
    return str(element.tag), normalize((w, x, y, z))


def sequence(movement: SpineMovement, repetition: int) -> Iterator[tuple[int, SpinePoint]]:
    """Yield the points of a movement that is repeated, each with the number of the repetition.

    A movement with one point comes back between repetitions; the way back belongs to the one before.
    """
    for here in range(repetition):
        for again in range(movement.repetition):
            if len(movement.points) == 1 and here + again > 0:
                yield (here if again else here - 1), SpinePoint("", (), ())
            for point in movement.points:
                yield here, point
