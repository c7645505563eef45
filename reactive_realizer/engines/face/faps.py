"""MPEG-4's facial animation parameters (FAPs) as weights of morph targets and joints, from assets/face/faps.json."""

from collections.abc import Container, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.face_map import FaceMap
from reactive_realizer.embodiment.face_mesh import FaceMesh
from reactive_realizer.embodiment.turn_weights import weights_of_joint
from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.engines.face.fapu import Fapu
from reactive_realizer.engines.face.json_table import bad_entry, read_number, read_table, read_weights
from reactive_realizer.engines.face.weights import Weights
from reactive_realizer.errors import CreationFault, RealizerError

_OUTWARD: Final = "outward"
"""The direction of what grows, such as a pupil: away from its middle."""
_DIRECTIONS: Mapping[str, Vec3 | None] = MappingProxyType(
    {
        "left": (1.0, 0.0, 0.0),
        "right": (-1.0, 0.0, 0.0),
        "up": (0.0, 1.0, 0.0),
        "down": (0.0, -1.0, 0.0),
        "forward": (0.0, 0.0, 1.0),
        _OUTWARD: None,
    }
)

_ANGLE: Final = "AU"
_ANGLE_UNIT: Final = 1e-5
"""The unit of angles, rad; a weight of 1 turns a joint by one radian, or is the full extent of a morph target."""


class NoFap(CreationFault):
    """No facial animation parameter has the name or number."""

    code = "no-fap"
    template = "there is no facial animation parameter '{fap}'; available: {known}"
    unknown = "fap"
    fap: str
    known: tuple[str, ...]


class FapWithoutMorph(CreationFault):
    """A facial animation parameter that no blend shape and no joint can play, at least in one direction."""

    code = "fap-without-morph"
    template = "no blend shape of the face is like {sign} values of the facial animation parameter {fap}{missing}"
    fap: str
    sign: str
    missing: str


class SelectingFap(CreationFault):
    """A parameter that selects faces, where only the values of others can stand."""

    code = "selecting-fap"
    template = "the facial animation parameter {fap} has no value of its own: a <bmlt:facefap> selects its faces"
    fap: str


@dataclass(frozen=True, slots=True)
class Fap:
    """A facial animation parameter (ISO/IEC 14496-2, table C.1).

    Attributes:
        name: of the standard.
        unit: name of its unit in `Fapu`, AU for an angle; empty if it selects faces.
        direction: of positive values, a unit vector in the figure's frame; None is away from the middle of what moves.
        positive: weights of morph targets that move the feature point in this direction, of which the scale is
            measured, or of turns of joints. Of several alternatives, an avatar shows the first one that it has.
        negative: those that move it back.
        faces: names of the visemes or expressions that it selects by their index; none for all but two parameters.
    """

    name: str
    unit: str
    direction: Vec3 | None
    positive: tuple[Weights, ...]
    negative: tuple[Weights, ...]
    faces: tuple[str, ...] = ()

    def alternatives(self, *, positive: bool) -> tuple[Weights, ...]:
        """The weights for one sign of the value, the best ones first."""
        return self.positive if positive else self.negative


class FapTable:
    """The facial animation parameters on the face of one avatar.

    A feature point is the vertex that the blend shapes of its parameter move furthest in the direction of the
    parameter. So a value moves it as far as the standard says, on any face with these blend shapes.

    Args:
        path: of a table in the format of assets/face/faps.json.
        avatar: with the face.
        face: what the avatar shows of weights.

    Raises:
        RealizerError: "bad-asset": the table has another format.
        OSError: the table cannot be read.
    """

    def __init__(self, path: Path, avatar: Avatar, face: FaceMap) -> None:
        faps = {read_number(path, key): _fap(path, key, entry) for key, entry in read_table(path, "faps").items()}
        self._faps: Mapping[int, Fap] = faps
        self._numbers = {str(number): number for number in faps} | {fap.name: number for number, fap in faps.items()}
        self._shown = frozenset(face.names).union(*map(weights_of_joint, face.joints))
        mesh = _face_of(avatar)
        units = None if mesh is None else _units(avatar, mesh, face)
        turning = _turning(faps, self._shown)
        self._weights = turning if mesh is None or units is None else turning | _per_value(faps, mesh, units, face)

    def numbers(self, faps: str) -> tuple[int, ...]:
        """The numbers of parameters, from their numbers or names, separated by spaces.

        Raises:
            RealizerError: "no-fap".
        """
        return tuple(map(self._number, faps.split())) or (self._number(faps),)

    def _number(self, fap: str) -> int:
        number = self._numbers.get(fap.lower())
        if number is None:
            raise RealizerError(NoFap(fap=fap, known=tuple(self._numbers)))
        return number

    def name(self, number: int) -> str:
        """The name of a parameter."""
        return self._faps[number].name

    def faces(self, number: int) -> tuple[str, ...]:
        """The names of the visemes or expressions that a parameter selects; none if it has a value."""
        return self._faps[number].faces

    def weights(self, values: Mapping[int, float]) -> dict[str, float]:
        """The weights for values of several parameters.

        Where two parameters use the same morph target, such as both corners of a raised lip, the greater weight holds.

        Args:
            values: number of the parameter -> value, in its unit.

        Raises:
            RealizerError: "fap-without-morph" or "selecting-fap".
        """
        weights: dict[str, float] = {}
        for number, value in values.items():
            for morph, weight in self._of(number, value).items():
                weights[morph] = max(weights.get(morph, 0.0), min(abs(value) * weight, 1.0))
        return weights

    def missing(self, number: int, value: float) -> FapWithoutMorph | None:
        """Why the avatar cannot show a value of a parameter that has values; None if it can."""
        fap, positive = self._faps[number], value >= 0.0
        if fap.faces or (number, positive) in self._weights:
            return None
        usual = fap.alternatives(positive=positive)[-1:]
        lacking = ", ".join(name for weights in usual for name in weights.keys() - self._shown)
        return FapWithoutMorph(
            fap=_named(number, fap),
            sign="positive" if positive else "negative",
            missing=f"; the avatar has no {lacking}" if lacking else "",
        )

    def _of(self, number: int, value: float) -> Weights:
        """The weights of a parameter for each unit of its value."""
        fap = self._faps[number]
        if fap.faces:
            raise RealizerError(SelectingFap(fap=_named(number, fap)))
        if missing := self.missing(number, value):
            raise RealizerError(missing)
        return self._weights[number, value >= 0.0]


def _face_of(avatar: Avatar) -> FaceMesh | None:
    if avatar.path is None:
        return None
    try:
        return FaceMesh.read(avatar.path)
    except RealizerError:
        return None


def _units(avatar: Avatar, mesh: FaceMesh, face: FaceMap) -> Fapu | None:
    try:
        return Fapu.measured(avatar, mesh, face)
    except (LookupError, ValueError):
        return None


def _turning(faps: Mapping[int, Fap], shown: Container[str]) -> dict[tuple[int, bool], Weights]:
    """The weights of angles for each unit of value, by number and whether the value is positive."""
    return {
        (number, positive): {name: _ANGLE_UNIT * weight for name, weight in weights.items()}
        for number, fap in faps.items()
        if fap.unit == _ANGLE
        for positive in (True, False)
        for weights in reversed(fap.alternatives(positive=positive))
        if all(name in shown for name in weights)
    }


def _per_value(faps: Mapping[int, Fap], mesh: FaceMesh, units: Fapu, face: FaceMap) -> dict[tuple[int, bool], Weights]:
    """The weights of displacements for each unit of value, by number and whether the value is positive."""
    found: dict[tuple[int, bool], Weights] = {}
    for number, fap in faps.items():
        if fap.unit == _ANGLE:
            continue
        for positive in (True, False):
            for weights in fap.alternatives(positive=positive):
                if moved := _moved_by(weights, fap, mesh, face, positive=positive):
                    share = getattr(units, fap.unit) / moved
                    found[number, positive] = {morph: share * weight for morph, weight in weights.items()}
                    break
    return found


def _moved_by(weights: Weights, fap: Fap, mesh: FaceMesh, face: FaceMap, *, positive: bool) -> float:
    """How far weights move the feature point, m; 0 if the avatar does not show all of them."""
    shown = face(weights)
    if not shown or not shown.keys() <= mesh.moves.keys():
        return 0.0
    return max(0.0, _moved(mesh.displacement(shown), fap.direction, positive=positive))


def _moved(displacement: NDArray[np.float64], direction: Vec3 | None, *, positive: bool) -> float:
    """How far the feature point of a displacement, (V, 3), moves, m."""
    if direction is None:
        return float(np.linalg.norm(displacement, axis=1).max())
    along = displacement @ np.array(direction)
    return float(along.max() if positive else -along.min())


def _named(number: int, fap: Fap) -> str:
    """A parameter in a message."""
    return f"{number} ({fap.name})"


def _fap(path: Path, key: str, entry: Any) -> Fap:
    if not isinstance(entry, dict) or not isinstance(entry.get("name"), str):
        raise bad_entry(path, key, "a facial animation parameter has a name")
    positive, negative = (_alternatives(path, key, entry.get(part, [])) for part in ("positive", "negative"))
    unit, direction, faces = entry.get("unit", ""), entry.get("direction", "up"), entry.get("faces", [])
    units = (*Fapu.__slots__, _ANGLE)
    if (positive or negative) and unit not in units:
        raise bad_entry(path, key, f"the unit is one of {', '.join(units)}")
    if direction not in _DIRECTIONS:
        raise bad_entry(path, key, f"the direction is one of {', '.join(_DIRECTIONS)}")
    if not isinstance(faces, list) or not all(isinstance(face, str) for face in faces):
        raise bad_entry(path, key, "the faces are a list of names")
    return Fap(entry["name"], unit, _DIRECTIONS[direction], positive, negative, tuple(faces))


def _alternatives(path: Path, key: str, entry: object) -> tuple[Weights, ...]:
    return tuple(read_weights(path, key, each) for each in (entry if isinstance(entry, list) else [entry]))
