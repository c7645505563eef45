"""Reads AsapRealizer's keyframe files: SkeletonInterpolator (an animation) and SkeletonPose (one pose).

An animation may also be part of a BML block. The format is extended: a `<KeyPosition id="catch" time="0.8"/>` element
in an animation names a time of the file, s, as a sync point; with `leave="true"`, the motion may be left there.
"""

from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.binding.asset_file import XmlElement, asset_error, attribute, boolean, read_xml
from reactive_realizer.binding.keyframe_table import increasing_times, inline_element, key_points, number_rows
from reactive_realizer.embodiment.pose import FARTHEST
from reactive_realizer.embodiment.quaternion import Quat
from reactive_realizer.engines.animation.keyframe.clip import Clip, KeyPoint, continuous

_ENCODINGS = {
    **dict.fromkeys(("quat", "quaternion", "quaternions"), "quaternions"),
    **dict.fromkeys(("xyzw", "reversedquat"), "xyzw"),
    **dict.fromkeys(("axisangle", "axisangles"), "axisangles"),
}
"""The encodings of rotations by their names; the default is quaternions."""

_PLACED = "T1"
"""Prefix of an encoding with the position of the first part before the rotations."""

_NEARLY_ZERO = 1e-6


class PoseTable(NamedTuple):
    """Rows of poses.

    Attributes:
        times: (K,), s; empty for a table without times.
        joints: (J,).
        rotations: (K, J, 4), unit quaternions w x y z.
        roots: (K, 3), position of the first joint above the ground of its own figure, m; None if the table has none.
    """

    times: NDArray[np.float64]
    joints: tuple[str, ...]
    rotations: NDArray[np.float64]
    roots: NDArray[np.float64] | None


def read_pose_table(element: XmlElement, *, timed: bool) -> PoseTable:
    """Read the rows of an element with the attributes parts, encoding (R or T1R) and rotationEncoding.

    Raises:
        RealizerError: "bad-asset", with file, line and reason.
    """
    joints = tuple(attribute(element, "parts").split())
    if not joints:
        raise asset_error(element, "parts names no joint")
    if len(set(joints)) != len(joints):
        raise asset_error(element, "parts names a joint twice")
    encoding = attribute(element, "encoding")
    if encoding not in ("R", f"{_PLACED}R"):
        raise asset_error(element, f"encoding='{encoding}' is not supported; known are R and {_PLACED}R")
    placed = encoding.startswith(_PLACED)
    rows = number_rows(element, timed + 3 * placed + 4 * len(joints))
    roots = rows[:, timed : timed + 3] if placed else None
    values = rows[:, timed + 3 * placed :].reshape(len(rows), len(joints), 4)
    return PoseTable(rows[:, :timed].ravel(), joints, _quaternions(element, values), roots)


def _quaternions(element: XmlElement, values: NDArray[np.float64]) -> NDArray[np.float64]:
    written = element.get("rotationEncoding", "quat")
    encoding = _ENCODINGS.get(written.lower())
    if encoding is None:
        raise asset_error(
            element, f"rotationEncoding='{written}' is not supported; known are quaternions, xyzw and axisangles"
        )
    if encoding == "axisangles":
        half = 0.5 * values[..., 3:]
        # Axes in files have any length, and length 0 without a turn.
        axes = np.where(half == 0.0, (1.0, 0.0, 0.0), values[..., :3])
        return np.concatenate([np.cos(half), np.sin(half) * _units(element, axes)], axis=-1)
    return _units(element, values if encoding == "quaternions" else values[..., [3, 0, 1, 2]])


def _units(element: XmlElement, vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    lengths = np.linalg.norm(vectors, axis=-1, keepdims=True)
    if (lengths < _NEARLY_ZERO).any():
        row, part, _ = np.argwhere(lengths < _NEARLY_ZERO)[0]
        raise asset_error(element, f"the rotation of part {part + 1} in row {row + 1} has the length 0")
    units: NDArray[np.float64] = vectors / lengths
    return units


def read_skeleton_pose(path: Path) -> dict[str, Quat]:
    """Read the rotations of joints, local to their parents.

    The position of HumanoidRoot is ignored: it belongs to the figure for which the file was made.

    Raises:
        RealizerError: "bad-asset", with file, line and reason; or the file is too big.
        OSError: the file cannot be read.
    """
    element = read_xml(path, "SkeletonPose")
    table = read_pose_table(element, timed=False)
    if len(table.rotations) != 1:
        raise asset_error(element, f"{len(table.rotations)} rows; a pose has one")
    return dict(zip(table.joints, map(_quat, table.rotations[0].tolist()), strict=True))


def _quat(values: list[float]) -> Quat:
    w, x, y, z = values
    return (w, x, y, z)


_TAG = "SkeletonInterpolator"


def read_interpolator_file(path: Path) -> Clip:
    """Read the animation of a file.

    Raises:
        RealizerError: "bad-asset", with file, line and reason; or the file is too big.
        OSError: the file cannot be read.
    """
    return read_interpolator(read_xml(path, _TAG))


def read_interpolator_text(text: str, name: str) -> Clip:
    """Read an animation from XML that was part of a BML block.

    Args:
        text: of the element.
        name: for messages.

    Raises:
        RealizerError: "bad-asset", with the name, the line in the text and the reason.
    """
    return read_interpolator(inline_element(text, name))


def read_interpolator(element: XmlElement) -> Clip:
    """Read the animation of an element.

    Positions of the root are those of another body, so they are taken as displacements from the first row.

    Raises:
        RealizerError: "bad-asset", with file, line and reason.
    """
    table = read_pose_table(element, timed=True)
    times = increasing_times(element, table.times)
    roots = None if table.roots is None else table.roots - table.roots[0]
    if roots is not None and not (np.linalg.norm(roots, axis=-1) <= FARTHEST).all():
        raise asset_error(element, f"the root moves further than {FARTHEST:g} m")
    points = {
        sync: KeyPoint(time, leave=boolean(child, "leave", False))
        for sync, (time, child) in key_points(element, times[0], times[-1]).items()
    }
    name = Path(element.base or "").name
    return Clip(name, times, table.joints, continuous(table.rotations), roots, points)
