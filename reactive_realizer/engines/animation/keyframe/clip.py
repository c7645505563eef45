"""A motion as it was keyed or captured."""

from bisect import bisect_right
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.embodiment.joints import ROOT, other_side
from reactive_realizer.embodiment.quaternion import Quat, slerp
from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.engines.animation.keyframe.low_pass import low_pass


@dataclass(frozen=True, slots=True)
class KeyPoint:
    """A time of a clip that has a name.

    Attributes:
        time: s, of the clip.
        leave: whether the motion may well be left here: one that is interrupted gently ends at the next such point.
    """

    time: float
    leave: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Clip:
    """Poses at times; between them each joint turns evenly along the shortest arc (K. Shoemake, 1985).

    Attributes:
        name: of its file, for messages.
        times: of its keys, s, rising, (K,), two or more.
        joints: H-Anim names, (J,).
        rotations: (K, J, 4) unit quaternions w x y z local to the parent, neighbors in time on the same half sphere.
        roots: how far HumanoidRoot has moved since the first key, (K, 3), m, in the figure's axes; None: not at all.
        points: sync id -> when.
    """

    name: str
    times: tuple[float, ...]
    joints: tuple[str, ...]
    rotations: NDArray[np.float64]
    roots: NDArray[np.float64] | None = None
    points: Mapping[str, KeyPoint] = field(default_factory=dict)

    @property
    def duration(self) -> float:
        """From the first key to the last, s."""
        return self.times[-1] - self.times[0]

    def rotations_at(self, time: float) -> dict[str, Quat]:
        """The rotations of its joints at a time, s; before the first key and after the last one, theirs."""
        key, done = self._place(time)
        before, after = self.rotations[key].tolist(), self.rotations[key + 1].tolist()
        return {joint: slerp(a, b, done) for joint, a, b in zip(self.joints, before, after, strict=True)}

    def root_at(self, time: float) -> Vec3 | None:
        """How far HumanoidRoot has moved at a time, s, since the first key, m; None: it is not moved."""
        if self.roots is None:
            return None
        key, done = self._place(time)
        (ax, ay, az), (bx, by, bz) = self.roots[key].tolist(), self.roots[key + 1].tolist()
        return (ax + done * (bx - ax), ay + done * (by - ay), az + done * (bz - az))

    def mirrored(self) -> "Clip":
        """The same in a mirror: left is right."""
        joints = tuple(map(other_side, self.joints))
        roots = None if self.roots is None else self.roots * (-1.0, 1.0, 1.0)
        return replace(self, joints=joints, rotations=self.rotations * (1.0, 1.0, -1.0, -1.0), roots=roots)

    def only(self, joints: Collection[str]) -> "Clip":
        """The motion of some of its joints; HumanoidRoot moves only if it is among them."""
        chosen = [index for index, joint in enumerate(self.joints) if joint in joints]
        names = tuple(self.joints[index] for index in chosen)
        return replace(
            self, joints=names, rotations=self.rotations[:, chosen], roots=self.roots if ROOT in names else None
        )

    def filtered(self, cutoff: float) -> "Clip":
        """Without what is faster than a frequency, Hz: the noise of a capture (thesis 3.2.2.2); 0 takes nothing away.

        Raises:
            RealizerError: "bad-keys": its keys are not evenly spaced, or the frequency is too low for a motion.
        """
        if not cutoff:
            return self
        smooth = low_pass(self.rotations, self.times, cutoff, self.name)
        roots = None if self.roots is None else low_pass(self.roots, self.times, cutoff, self.name)
        return replace(self, rotations=smooth / np.linalg.norm(smooth, axis=-1, keepdims=True), roots=roots)

    def _place(self, time: float) -> tuple[int, float]:
        """The key at or before a time that another one follows, and the share of the way to that one."""
        key = min(max(bisect_right(self.times, time) - 1, 0), len(self.times) - 2)
        before, after = self.times[key], self.times[key + 1]
        return key, min(1.0, max(0.0, (time - before) / (after - before)))


def continuous(rotations: NDArray[np.float64]) -> NDArray[np.float64]:
    """Of q and -q, which turn alike, the one that is nearer to that of the key before (thesis, equations 3.8, 3.9).

    Args:
        rotations: (K, J, 4).
    """
    flips = np.where(np.sum(rotations[1:] * rotations[:-1], axis=-1) < 0.0, -1.0, 1.0)
    signs = np.concatenate([np.ones_like(rotations[:1, :, 0]), np.cumprod(flips, axis=0)])
    result: NDArray[np.float64] = rotations * signs[..., np.newaxis]
    return result
