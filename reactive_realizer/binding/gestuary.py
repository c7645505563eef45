"""Reads lexicons of Greta: gestures as phases with the places, orientations and shapes of hands; and shapes of hands.

The formats are those of its files ``gestuary.xml`` and ``HandShape.xml`` (https://github.com/isir/greta).
"""

import logging
import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Final, NamedTuple, cast

from reactive_realizer.binding.asset_file import XmlElement, asset_error, attribute, boolean, number, read_xml
from reactive_realizer.binding.faults import NotInLibrary
from reactive_realizer.binding.gestuary_phases import HandPhase, Phase, Wave
from reactive_realizer.embodiment.quaternion import Quat, from_axis_angle, multiply, normalize
from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.file_cache import remembered

_log = logging.getLogger(__name__)

_MOST_PHASES: Final = 100
"""Phases of a gesture that are used."""
_SIDES: Final = {"LEFT": "l", "RIGHT": "r"}
_MIDDLE: Final = 0.5
"""The place of a hand along an axis for which its position gives no location, lengths of the arm; as in Greta."""

OUTWARD: Final[Mapping[str, float]] = MappingProxyType({"XEP": 0.8, "XP": 0.5, "XC": 0.25, "XCC": 0.0, "XOppC": -0.25})
UPWARD: Final[Mapping[str, float]] = MappingProxyType(
    {
        "YUpperEP": 1.2,
        "YUpperP": 0.9,
        "YUpperC": 0.6,
        "YCC": 0.25,
        "YLowerC": 0.0,
        "YLowerP": -0.3,
        "YLowerEP": -0.5,
    }
)
AHEAD: Final[Mapping[str, float]] = MappingProxyType({"ZNear": 0.4, "ZMiddle": 0.65, "ZFar": 0.95})

_LOCATIONS: Final = {"horizontalLocation": OUTWARD, "verticalLocation": UPWARD, "frontalLocation": AHEAD}
_POSITIONS: Final = ("symbolicPosition", "uniformPosition", "touchPosition")
_VARIATIONS: Final = {"-": -1, "=": 0, "+": 1}
_SHORTEST: Final = 1e-6
"""A quaternion that is shorter is none."""


class GretaGesture(NamedTuple):
    """A gesture of a gestuary.

    Attributes:
        id: its name within its category.
        category: such as "beat"; empty for none.
        phases: of its stroke, in order.
        faults: of parts that cannot be read, which are left out.
    """

    id: str
    category: str
    phases: tuple[Phase, ...]
    faults: tuple[Fault, ...]


@dataclass(frozen=True, slots=True)
class Gestuary:
    """The gestures of a file.

    Attributes:
        file: its name.
        gestures: in order.
    """

    file: str
    gestures: tuple[GretaGesture, ...]

    @staticmethod
    @remembered
    def read(path: Path) -> "Gestuary":
        """Read a file. A gesture that nothing can name is left out, and the log says so.

        Raises:
            RealizerError: "bad-asset": it is no gestuary; "asset-too-big".
            OSError: the file cannot be read.
        """
        gestures: list[GretaGesture] = []
        for element in read_xml(path, "gestuary").iterchildren("gesture"):
            try:
                gestures.append(_gesture(element))
            except RealizerError as refused:
                _log.warning("%s; it is left out", refused.fault.sentence)
        return Gestuary(path.name, tuple(gestures))

    def gesture(self, name: str) -> GretaGesture:
        """Return the gesture with a name: its id, or ``category=id``; regardless of case.

        Raises:
            RealizerError: "not-in-library".
        """
        category, _, word = name.strip().lower().rpartition("=")
        found = [gesture for gesture in self.gestures if gesture.id.lower() == word]
        if not found:
            known = tuple(gesture.id for gesture in self.gestures)
            raise RealizerError(NotInLibrary(file=self.file, element="gesture", name=name, known=known))
        return next((gesture for gesture in found if gesture.category.lower() == category), found[0])


@remembered
def read_hand_shapes(path: Path) -> Mapping[str, Mapping[str, Quat]]:
    """Return the rotations of the joints of right hands, local to their parents, by the names of shapes in lowercase.

    Raises:
        RealizerError: "bad-asset": with file, line and reason; "asset-too-big".
        OSError: the file cannot be read.
    """
    shapes = read_xml(path, "HandShapes").iterchildren("HandShape")
    return {attribute(each, "id").lower(): {str(joint.tag): _euler(joint) for joint in each} for each in shapes}


def _gesture(element: XmlElement) -> GretaGesture:
    """Return a gesture, with the faults of its parts.

    Raises:
        RealizerError: "bad-asset": it has no id.
    """
    faults: list[Fault] = []
    phases = list(element.iterchildren("phase"))
    if len(phases) > _MOST_PHASES:
        faults.append(asset_error(element, f"{len(phases)} phases; the first {_MOST_PHASES} are used").fault)
    read = tuple(tuple(_hands(phase, faults)) for phase in phases[:_MOST_PHASES])
    return GretaGesture(attribute(element, "id"), element.get("category", "").strip(), read, tuple(faults))


def _hands(phase: XmlElement, faults: list[Fault]) -> Iterator[HandPhase]:
    for element in phase.iterchildren("hand"):
        try:
            yield _hand(element, faults)
        except RealizerError as refused:
            faults.append(refused.fault)


def _hand(element: XmlElement, faults: list[Fault]) -> HandPhase:
    """Return a hand; the faults of its parts are added.

    Raises:
        RealizerError: "bad-asset": it has no side.
    """
    side = _SIDES.get(attribute(element, "side").upper())
    if side is None:
        raise asset_error(element, f"side='{element.get('side')}': known are {', '.join(_SIDES)}")
    hand = HandPhase(side, cast("int | None", element.sourceline))
    for part in (element, *element):
        read = _PARTS.get(str(part.tag))
        try:
            if read is None:
                raise asset_error(part, f"known are {', '.join(each for each in _PARTS if each != 'hand')}")
            hand = read(part, hand)
        except RealizerError as refused:
            faults.append(refused.fault)
    return hand


def _openness(element: XmlElement, hand: HandPhase) -> HandPhase:
    return hand._replace(openness=number(element, "openness")) if "openness" in element.attrib else hand


def _symbolic(element: XmlElement, hand: HandPhase) -> HandPhase:
    def value(location: XmlElement, symbols: Mapping[str, float]) -> float:
        symbol = _text(location)
        if symbol not in symbols:
            raise asset_error(location, f"there is no '{symbol}'; known are {', '.join(symbols)}")
        return symbols[symbol]

    return hand._replace(place=_place(element, value), touch=None)


def _uniform(element: XmlElement, hand: HandPhase) -> HandPhase:
    def value(location: XmlElement, symbols: Mapping[str, float]) -> float:
        return number(location, "value")

    if "x" in element.attrib:
        return hand._replace(place=_vector(element), touch=None)
    return hand._replace(place=_place(element, value), touch=None)


def _place(element: XmlElement, value: Callable[[XmlElement, Mapping[str, float]], float]) -> Vec3:
    found = {str(each.tag): each for each in element}
    if unknown := [each for name, each in found.items() if name not in _LOCATIONS]:
        raise asset_error(unknown[0], f"known are {', '.join(_LOCATIONS)}")
    x, y, z = (value(found[name], _LOCATIONS[name]) if name in found else _MIDDLE for name in _LOCATIONS)
    return (x, y, z)


def _touch(element: XmlElement, hand: HandPhase) -> HandPhase:
    return hand._replace(touch=_text(element), place=None)


def _shape(element: XmlElement, hand: HandPhase) -> HandPhase:
    return hand._replace(shape=_text(element))


def _wrist(element: XmlElement, hand: HandPhase) -> HandPhase:
    turn = (number(element, "w"), *_vector(element))
    if math.hypot(*turn) < _SHORTEST:
        raise asset_error(element, "the quaternion is 0")
    return hand._replace(turn=normalize(turn), of_figure=boolean(element, "global", default=False))


def _trajectory(element: XmlElement, hand: HandPhase) -> HandPhase:
    waves = {"x": Wave(0.0), "y": Wave(0.0), "z": Wave(0.0)}
    for axis in element.iterchildren("parameters"):
        if attribute(axis, "axis").lower() not in waves:
            raise asset_error(axis, f"axis='{axis.get('axis')}': known are x, y, z")
        waves[attribute(axis, "axis").lower()] = Wave(
            number(axis, "amplitude"),
            number(axis, "frequency") if "frequency" in axis.attrib else 1.0,
            number(axis, "shift") if "shift" in axis.attrib else 0.0,
            *(_VARIATIONS.get(axis.get(f"{kind}Variation", "="), 0) for kind in ("spatial", "temporal")),
        )
    straight = element.get("type", "").lower() == "linear"
    return hand._replace(waves=() if straight else tuple(waves.values()))


_PARTS: Final[Mapping[str, Callable[[XmlElement, HandPhase], HandPhase]]] = {
    "hand": _openness,
    **dict(zip(_POSITIONS, (_symbolic, _uniform, _touch), strict=True)),
    "handShape": _shape,
    "wristOrientation": _wrist,
    "trajectory": _trajectory,
}


def _text(element: XmlElement) -> str:
    """Return the value of an element: its attribute, or its text as in older files."""
    return str(element.get("value", element.text or "")).strip()


def _vector(element: XmlElement) -> Vec3:
    return (number(element, "x"), number(element, "y"), number(element, "z"))


def _euler(element: XmlElement) -> Quat:
    """Return the rotation of three angles, degrees: about x, then y, then z, all in the axes of the parent."""
    turns = (from_axis_angle(axis, math.radians(angle)) for axis, angle in zip(_AXES, _vector(element), strict=True))
    x, y, z = turns
    return multiply(z, multiply(y, x))


_AXES: Final[tuple[Vec3, ...]] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
