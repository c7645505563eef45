"""Writes motion in Biovision's BVH format.

Source: M. Meredith and S. Maddock, "Motion capture file formats explained", 2001.
"""

from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.clock.ticker import FRAME_EVERY, RATE
from reactive_realizer.embodiment.body import Skeleton
from reactive_realizer.embodiment.vector import ZERO, Vec3, scale
from reactive_realizer.export.recorded_motion import RecordedMotion, file_of

_TURNED = "Zrotation Xrotation Yrotation"
_ROOT_CHANNELS = f"CHANNELS 6 Xposition Yposition Zposition {_TURNED}"
_CHANNELS = f"CHANNELS 3 {_TURNED}"
_TIP = 0.5
"""Length of the end of a limb, as a share of the offset of its last joint."""
_LOCKED = 1e-6
"""Cosine of the turn about x below which those about z and y have the same axis."""


def write_bvh(path: Path, motions: Mapping[str, RecordedMotion]) -> None:
    """Write a file for each character: H-Anim joints, in meters, y up; at rest, the arms hang.

    Faces have no place in the format.
    """
    for id_, motion in motions.items():
        file_of(path, id_, len(motions)).write_text("\n".join(_lines(motion)) + "\n", encoding="utf-8")


def _lines(motion: RecordedMotion) -> Iterator[str]:
    skeleton = motion.avatar.skeleton
    order = _depth_first(skeleton)
    yield "HIERARCHY"
    yield from _joint(skeleton, order[0], "")
    yield "MOTION"
    yield f"Frames: {len(motion.times)}"
    yield f"Frame Time: {FRAME_EVERY / RATE:g}"
    angles = euler_angles(motion.rotations)[:, order].reshape(len(motion.times), -1)
    for root, row in zip(motion.roots.tolist(), angles.tolist(), strict=True):
        yield " ".join([*(f"{value:.6f}" for value in root), *(f"{value:.4f}" for value in row)])


def _joint(skeleton: Skeleton, index: int, margin: str) -> Iterator[str]:
    """Yield a joint and those below it."""
    is_root = skeleton.parents[index] < 0
    below = _children(skeleton, index)
    yield f"{margin}{'ROOT' if is_root else 'JOINT'} {skeleton.joints[index]}"
    yield margin + "{"
    yield margin + "\t" + _offset(ZERO if is_root else skeleton.offsets[index])
    yield margin + "\t" + (_ROOT_CHANNELS if is_root else _CHANNELS)
    for child in below:
        yield from _joint(skeleton, child, margin + "\t")
    if not below:
        tip = _offset(scale(skeleton.offsets[index], _TIP))
        yield from (margin + line for line in ("\tEnd Site", "\t{", f"\t\t{tip}", "\t}"))
    yield margin + "}"


def _offset(offset: Vec3) -> str:
    return "OFFSET " + " ".join(f"{value:.6f}" for value in offset)


def _children(skeleton: Skeleton, index: int) -> list[int]:
    return [child for child, parent in enumerate(skeleton.parents) if parent == index]


def _depth_first(skeleton: Skeleton) -> list[int]:
    """Return the joints in the order in which the hierarchy lists them."""
    order, waiting = [], [skeleton.parents.index(-1)]
    while waiting:
        order.append(waiting.pop())
        waiting += reversed(_children(skeleton, order[-1]))
    return order


def euler_angles(rotations: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the angles about z, x and y, degrees, (..., 3), of which a rotation is the product Rz Rx Ry.

    Args:
        rotations: (..., 4) unit quaternions w x y z.
    """
    w, x, y, z = np.moveaxis(rotations, -1, 0)
    sine = (2.0 * (y * z + w * x)).clip(-1.0, 1.0)
    about_z = np.arctan2(2.0 * (w * z - x * y), 1.0 - 2.0 * (x * x + z * z))
    about_y = np.arctan2(2.0 * (w * y - x * z), 1.0 - 2.0 * (x * x + y * y))
    locked = 1.0 - sine * sine < _LOCKED * _LOCKED
    about_z = np.where(locked, np.arctan2(2.0 * (x * y + w * z), 1.0 - 2.0 * (y * y + z * z)), about_z)
    about_y = np.where(locked, 0.0, about_y)
    angles: NDArray[np.float64] = np.degrees(np.stack((about_z, np.arcsin(sine), about_y), axis=-1))
    return angles
