"""Motion captures: a captured figure and its frames, whatever the format of its file.

Arrays of unit quaternions are (..., 4), w x y z.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.embodiment.quaternion import IDENTITY, Quat
from reactive_realizer.embodiment.vector import Vec3

Array = NDArray[np.float64]


def product(a: Array, b: Array) -> Array:
    """Return the rotations b followed by a."""
    aw, ax, ay, az = np.moveaxis(a, -1, 0)
    bw, bx, by, bz = np.moveaxis(b, -1, 0)
    return np.stack(
        (
            aw * bw - ax * bx - ay * by - az * bz,
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw,
        ),
        axis=-1,
    )


def rotated(turns: Array, vectors: Array) -> Array:
    """Return vectors, (..., 3), turned by rotations."""
    pure = np.concatenate([np.zeros((*vectors.shape[:-1], 1)), vectors], axis=-1)
    out: Array = product(product(turns, pure), inverse(turns))[..., 1:]
    return out


def inverse(q: Array) -> Array:
    """Return the inverse rotations."""
    back: Array = q * (1.0, -1.0, -1.0, -1.0)
    return back


def about(axis: int, angles: Array) -> Array:
    """Return turns about x (0), y (1) or z (2), rad."""
    out = np.zeros((*angles.shape, 4))
    out[..., 0] = np.cos(0.5 * angles)
    out[..., axis + 1] = np.sin(0.5 * angles)
    return out


@dataclass(frozen=True, slots=True)
class CapturedJoint:
    """A joint of the captured figure.

    Attributes:
        name: as in the file, or its name in H-Anim.
        parent: index of the parent joint, -1 for the root.
        offset: from the parent joint, in the unit of the file.
        rest: its rotation without motion, local to the parent joint.
    """

    name: str
    parent: int
    offset: Vec3
    rest: Quat = IDENTITY


@dataclass(frozen=True, slots=True, eq=False)
class Capture:
    """A captured figure and its motion, in the axes and the unit of length of the file.

    Attributes:
        name: of the file.
        joints: each after its parent, (J,).
        times: of the frames, s, increasing, (F,), two or more.
        turns: rotation of each joint in each frame, local to its parent, `rest` included, (F, J, 4).
        moves: of the joints that move in their parents: index -> offset in each frame, (F, 3).
        played: indices of the joints that the motion is about; None for all.
        points: sync id -> time, s.
    """

    name: str
    joints: tuple[CapturedJoint, ...]
    times: tuple[float, ...]
    turns: Array
    moves: Mapping[int, Array] = field(default_factory=dict)
    played: frozenset[int] | None = None
    points: Mapping[str, float] = field(default_factory=dict)

    def rotations(self) -> Array:
        """Return the rotation of each joint in each frame, in the axes of the file, (F, J, 4)."""
        return self._accumulated(self.turns)

    def rests(self) -> Array:
        """Return the rotation of each joint without motion, in the axes of the file, (J, 4)."""
        rests: Array = self._accumulated(np.array([[joint.rest for joint in self.joints]]))[0]
        return rests

    def positions(self, index: int, turned: Array) -> Array:
        """Return the positions of a joint in frames, (F, 3), in the axes and the unit of the file.

        Args:
            index: of the joint.
            turned: the `rotations` of all frames, or of the first ones.
        """
        out = np.zeros((len(turned), 3))
        while (above := self.joints[index].parent) >= 0:
            out += rotated(turned[:, above], self._offsets(index, len(turned)))
            index = above
        return out + self._offsets(index, len(turned))

    def rest_position(self, index: int, rests: Array) -> Vec3:
        """Return the position of a joint without motion, relative to the root.

        Args:
            index: of the joint.
            rests: the `rests` of all joints.
        """
        place = np.zeros(3)
        while (above := self.joints[index].parent) >= 0:
            place += rotated(rests[above], np.array(self.joints[index].offset))
            index = above
        x, y, z = place.tolist()
        return (x, y, z)

    def _accumulated(self, local: Array) -> Array:
        out = local.copy()
        for index, joint in enumerate(self.joints):
            if joint.parent >= 0:
                out[:, index] = product(out[:, joint.parent], local[:, index])
        return out

    def _offsets(self, index: int, count: int) -> Array:
        """Return the offset of a joint from its parent in the first frames, (count, 3)."""
        moved = self.moves.get(index)
        return np.tile(self.joints[index].offset, (count, 1)) if moved is None else moved[:count]
