"""Keyframe animations of the face, in AsapRealizer's format FaceInterpolator."""

from bisect import bisect_right
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.binding.asset_file import XmlElement, asset_error, attribute, read_xml
from reactive_realizer.binding.keyframe_table import increasing_times, inline_element, key_points, number_rows
from reactive_realizer.bml.extensions import FaceKeyframe
from reactive_realizer.bml.vocabulary import FacePart, Side
from reactive_realizer.engines.face.face_shapes import FaceShapes
from reactive_realizer.engines.face.faps import FapTable
from reactive_realizer.engines.face.weights import Weights, added, limited, scaled
from reactive_realizer.errors import CreationFault, Fault, RealizerError

_TAG = "FaceInterpolator"


class NoFaceAnimation(CreationFault):
    """A facekeyframe without keyframes."""

    code = "no-face-animation"
    template = "<facekeyframe> needs a name, or a FaceInterpolator inside"


@dataclass(frozen=True, slots=True, eq=False)
class FaceAnimation:
    """Weights of morph targets at times.

    Attributes:
        times: (R,) of the rows, s, increasing.
        morphs: (M,) names.
        rows: (R, M) weights.
        points: sync id -> time, s, in the order of time; from start to end.
        notes: faults of parts that are left out.
    """

    times: tuple[float, ...]
    morphs: tuple[str, ...]
    rows: NDArray[np.float64]
    points: Mapping[str, float]
    notes: tuple[Fault, ...] = ()

    @property
    def phases(self) -> dict[str, float]:
        """The phase of each sync point, 0 to 1."""
        return {sync: (time - self.times[0]) / self.duration for sync, time in self.points.items()}

    @property
    def duration(self) -> float:
        """From the first row to the last, s."""
        return self.times[-1] - self.times[0]

    def weights(self, phase: float) -> Weights:
        """The weights at a phase, 0 to 1, linearly between rows."""
        time = self.times[0] + phase * self.duration
        after = min(max(bisect_right(self.times, time), 1), len(self.times) - 1)
        before, until = self.times[after - 1], self.times[after]
        share = min(max((time - before) / (until - before), 0.0), 1.0)
        row = self.rows[after - 1] + share * (self.rows[after] - self.rows[after - 1])
        return dict(zip(self.morphs, row.tolist(), strict=True))


def animation_path(behavior: FaceKeyframe, asset: Callable[[str], Path]) -> Path | None:
    """The file of an animation; None if its keyframes are inside of the behavior.

    Raises:
        RealizerError: "no-asset" or "no-face-animation".
    """
    if behavior.interpolator is not None:
        return None
    if not behavior.animation:
        raise RealizerError(NoFaceAnimation())
    return asset(f"**/{behavior.animation.removesuffix('.xml')}.xml")


def read_face_animation(behavior: FaceKeyframe, path: Path | None, shapes: FaceShapes) -> FaceAnimation:
    """The animation of a behavior.

    Args:
        behavior: with its keyframes inside, if it has no file.
        path: of its file.
        shapes: the faces of its avatar.

    Raises:
        RealizerError: "bad-asset"; or a part is not known, or moves no blend shape.
        OSError: the file cannot be read.
    """
    element = read_xml(path, _TAG) if path is not None else inline_element(behavior.interpolator or "", behavior.id)
    parts = attribute(element, "parts").split()
    if not parts:
        raise asset_error(element, "parts names nothing that moves")
    numbers = number_rows(element, 1 + len(parts))
    times = increasing_times(element, numbers[:, 0])
    faces, notes = _faces(element, parts, behavior.type, shapes, numbers[:, 1:])
    morphs = tuple(dict.fromkeys(morph for face in faces for morph in face))
    rows = np.array([[face.get(morph, 0.0) for morph in morphs] for face in faces])
    inside = sorted((time, sync) for sync, (time, _) in key_points(element, times[0], times[-1]).items())
    points = {"start": times[0], **{sync: time for time, sync in inside}, "end": times[-1]}
    return FaceAnimation(times, morphs, rows.clip(0.0, 1.0), points, notes)


def _faces(
    element: XmlElement, parts: list[str], kind: FacePart, shapes: FaceShapes, values: NDArray[np.float64]
) -> tuple[list[Weights], tuple[Fault, ...]]:
    """The weights of each row, and faults of values that are left out.

    Raises:
        RealizerError: "bad-asset": a part is not known, or nothing moves a blend shape.
    """
    try:
        if kind is FacePart.FAPS:
            numbers = [shapes.faps.numbers(part)[0] for part in parts]
            return _parameters(numbers, shapes.faps, values)
        units = [_unit(element, part, kind, shapes) for part in parts]
        return [limited(added(list(map(scaled, units, row)))) for row in values.tolist()], ()
    except RealizerError as problem:
        raise asset_error(element, problem.fault.sentence) from problem


def _parameters(
    numbers: list[int], faps: FapTable, values: NDArray[np.float64]
) -> tuple[list[Weights], tuple[Fault, ...]]:
    """The weights of parameters in each row, and a fault for each parameter and sign that the avatar cannot show.

    Raises:
        RealizerError: "fap-without-morph": there is nothing else; or "selecting-fap".
    """
    # A recording has a column for every parameter, and zeros for those that do not move.
    rows = [{n: value for n, value in zip(numbers, row, strict=True) if value} for row in values.tolist()]
    missing = {fault: None for row in rows for pair in row.items() if (fault := faps.missing(*pair))}
    shown = [{n: value for n, value in row.items() if not faps.missing(n, value)} for row in rows]
    if missing and not any(shown):
        raise RealizerError(next(iter(missing)))
    return [faps.weights(row) for row in shown], tuple(missing)


def _unit(element: XmlElement, part: str, kind: FacePart, shapes: FaceShapes) -> Weights:
    """The weights of a morph target, or of an action unit such as "12.LEFT"; without a side, both halves move."""
    if kind is FacePart.MORPH:
        return {shapes.known_morph(part): 1.0}
    number, _, side = part.partition(".")
    if not number.isdecimal() or side not in ("", *Side):
        raise asset_error(element, f"'{part}' is not an action unit, such as 12.LEFT")
    return shapes.expressions.unit(int(number)).weights(Side(side) if side else Side.BOTH)
