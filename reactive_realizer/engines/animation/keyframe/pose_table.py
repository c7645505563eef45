"""Rows of poses, as AsapRealizer's SkeletonInterpolator and SkeletonPose files write them."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.binding.xml_file import Element, attribute, bad

_ENCODINGS = {
    **dict.fromkeys(("quat", "quaternion", "quaternions"), "quaternions"),
    **dict.fromkeys(("xyzw", "reversedquat"), "xyzw"),
    **dict.fromkeys(("axisangle", "axisangles"), "axisangles"),
}
"""How rotations are written, by the words for it; without one they are quaternions."""

_PLACED = "T1"
"""Begins the encoding where the place of the first part comes before the rotations."""

_NEARLY_ZERO = 1e-6
_LARGEST = 1e100
"""Squares of larger numbers would be infinite."""


class PoseTable(NamedTuple):
    """What the rows say.

    Attributes:
        times: (K,), s; empty for a table without times.
        joints: (J,).
        rotations: (K, J, 4), unit quaternions w x y z.
        roots: (K, 3), where the first joint is, m, from the ground of its own figure; None where the table has none.
    """

    times: NDArray[np.float64]
    joints: tuple[str, ...]
    rotations: NDArray[np.float64]
    roots: NDArray[np.float64] | None


def read_pose_table(element: Element, *, timed: bool) -> PoseTable:
    """The rows in an element with the attributes parts, encoding (R or T1R) and rotationEncoding.

    Raises:
        RealizerError: "bad-asset", with file, line and what is wrong.
    """
    joints = tuple(attribute(element, "parts").split())
    if not joints:
        raise bad(element, "parts names no joint")
    if len(set(joints)) != len(joints):
        raise bad(element, "a part stands twice in parts")
    encoding = attribute(element, "encoding")
    if encoding not in ("R", f"{_PLACED}R"):
        raise bad(element, f"encoding='{encoding}' is not read; known are R and {_PLACED}R")
    placed = encoding.startswith(_PLACED)
    rows = _rows(element, timed + 3 * placed + 4 * len(joints))
    roots = rows[:, timed : timed + 3] if placed else None
    values = rows[:, timed + 3 * placed :].reshape(len(rows), len(joints), 4)
    return PoseTable(rows[:, :timed].ravel(), joints, _quaternions(element, values), roots)


def _rows(element: Element, width: int) -> NDArray[np.float64]:
    texts = [element.text, *(child.tail for child in element)]
    try:
        numbers = np.array(" ".join(filter(None, texts)).split(), dtype=np.float64)
    except ValueError as problem:
        raise bad(element, str(problem)) from problem
    if not numbers.size or numbers.size % width:
        raise bad(element, f"{numbers.size} numbers are no rows of {width}")
    rows = numbers.reshape(-1, width)
    beyond = np.argwhere(~(np.abs(rows) <= _LARGEST))
    if beyond.size:
        raise bad(element, f"a number in row {beyond[0][0] + 1} is beyond {_LARGEST:g}, or undefined")
    return rows


def _quaternions(element: Element, values: NDArray[np.float64]) -> NDArray[np.float64]:
    written = element.get("rotationEncoding", "quat")
    encoding = _ENCODINGS.get(written.lower())
    if encoding is None:
        raise bad(element, f"rotationEncoding='{written}' is not read; known are quaternions, xyzw and axisangles")
    if encoding == "axisangles":
        half = 0.5 * values[..., 3:]
        # Files write an axis of any length, and one of none where nothing turns.
        axes = np.where(half == 0.0, (1.0, 0.0, 0.0), values[..., :3])
        return np.concatenate([np.cos(half), np.sin(half) * _units(element, axes)], axis=-1)
    return _units(element, values if encoding == "quaternions" else values[..., [3, 0, 1, 2]])


def _units(element: Element, vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    lengths = np.linalg.norm(vectors, axis=-1, keepdims=True)
    if (lengths < _NEARLY_ZERO).any():
        row, part, _ = np.argwhere(lengths < _NEARLY_ZERO)[0]
        raise bad(element, f"the rotation of part {part + 1} in row {row + 1} has the length 0")
    units: NDArray[np.float64] = vectors / lengths
    return units
