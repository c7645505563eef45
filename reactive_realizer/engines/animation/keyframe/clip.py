"""Clips: poses at times, with interpolation and a low-pass filter."""

import math
from bisect import bisect_right
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, replace
from functools import reduce

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.embodiment.joints import ROOT, other_side
from reactive_realizer.embodiment.quaternion import Quat, slerp
from reactive_realizer.embodiment.spine import folded_spine
from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.engines.animation.faults import BadKeys
from reactive_realizer.engines.animation.keyframe.capture import product
from reactive_realizer.errors import RealizerError

_PASSES = 2
_SLOWEST = 0.1
"""Lowest cutoff frequency, Hz; people hardly move more slowly."""
_EVEN = 0.01
"""Tolerance of even key distances, as a share; files round their times."""


def low_pass(values: NDArray[np.float64], times: tuple[float, ...], cutoff: float, name: str) -> NDArray[np.float64]:
    """Apply a second-order Butterworth filter, forward and backward.

    The two passes cancel the delay (equations 3.10 to 3.12, after D. A. Winter, "Biomechanics and motor control of
    human movement"). Components are filtered separately. If the sample rate is too low for the frequency, the values
    stay as they are.

    Args:
        values: (K, ...), at evenly spaced times.
        times: (K,), s.
        cutoff: Hz.
        name: of the clip, for messages.

    Raises:
        RealizerError: "bad-keys": the times are not evenly spaced, or the cutoff is too low.
    """
    if cutoff < _SLOWEST:
        raise RealizerError(
            BadKeys(animation=name, reason=f"the cutoff must be at least {_SLOWEST:g} Hz, not {cutoff:g}")
        )
    steps = np.diff(times)
    if np.ptp(steps) > _EVEN * np.mean(steps):
        raise RealizerError(BadKeys(animation=name, reason="only evenly spaced keys can be filtered"))
    rate = 1.0 / float(np.mean(steps))
    if cutoff >= 0.5 * rate:
        return values
    weights = _weights(cutoff, rate)
    return _once(_once(values, weights)[::-1], weights)[::-1]


def _weights(cutoff: float, rate: float) -> tuple[float, float, float]:
    """Return a0, b1 and b2 of equation 3.11; a1 is 2 a0, a2 is a0."""
    correction = (2.0 ** (1.0 / _PASSES) - 1.0) ** 0.25
    frequency = math.tan(math.pi * cutoff / rate) / correction
    k2 = frequency * frequency
    a0 = k2 / (1.0 + math.sqrt(2.0) * frequency + k2)
    k3 = 2.0 * a0 / k2
    return a0, k3 - 2.0 * a0, 1.0 - 2.0 * a0 - k3


def _once(raw: NDArray[np.float64], weights: tuple[float, float, float]) -> NDArray[np.float64]:
    a0, b1, b2 = weights
    out = raw.copy()
    for i in range(2, len(raw)):
        out[i] = a0 * (raw[i] + 2.0 * raw[i - 1] + raw[i - 2]) + b1 * out[i - 1] + b2 * out[i - 2]
    return out


@dataclass(frozen=True, slots=True)
class KeyPoint:
    """A named time of a clip.

    Attributes:
        time: s, of the clip.
        leave: whether a gentle interruption may end the motion here.
    """

    time: float
    leave: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Clip:
    """Poses at times. Between them each joint turns evenly along the shortest arc (K. Shoemake, 1985).

    Attributes:
        name: of its file, for messages.
        times: of its keys, s, increasing, (K,), two or more.
        joints: H-Anim names, (J,).
        rotations: (K, J, 4) unit quaternions w x y z local to the parent; subsequent ones lie in the same hemisphere.
        roots: displacement of HumanoidRoot from the first key, (K, 3), m, in the figure's axes; None if it does not
            move.
        points: sync id -> named time.
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
        """Return the rotations of its joints at a time, s, which is limited to its keys."""
        key, done = self._place(time)
        before, after = self.rotations[key].tolist(), self.rotations[key + 1].tolist()
        return {joint: slerp(a, b, done) for joint, a, b in zip(self.joints, before, after, strict=True)}

    def root_at(self, time: float) -> Vec3 | None:
        """Return the displacement of HumanoidRoot from the first key at a time, s, in m; None if it does not move."""
        if self.roots is None:
            return None
        key, done = self._place(time)
        (ax, ay, az), (bx, by, bz) = self.roots[key].tolist(), self.roots[key + 1].tolist()
        return (ax + done * (bx - ax), ay + done * (by - ay), az + done * (bz - az))

    def mirrored(self) -> "Clip":
        """Return the clip with left and right exchanged."""
        joints = tuple(map(other_side, self.joints))
        roots = None if self.roots is None else self.roots * (-1.0, 1.0, 1.0)
        return replace(self, joints=joints, rotations=self.rotations * (1.0, 1.0, -1.0, -1.0), roots=roots)

    def only(self, joints: Collection[str]) -> "Clip":
        """Return the motion of some of its joints; HumanoidRoot moves only if it is among them."""
        chosen = [index for index, joint in enumerate(self.joints) if joint in joints]
        names = tuple(self.joints[index] for index in chosen)
        return replace(
            self, joints=names, rotations=self.rotations[:, chosen], roots=self.roots if ROOT in names else None
        )

    def folded(self, known: Collection[str]) -> "Clip":
        """Return the clip for a figure with some joints: vertebrae turn for those that it lacks (`folded_spine`)."""
        groups = folded_spine(self.joints, known)
        if all(own == (joint,) for joint, own in groups.items()):
            return self
        columns = {joint: self.rotations[:, number] for number, joint in enumerate(self.joints)}
        gone = {joint for own in groups.values() for joint in own}
        kept = {joint: column for joint, column in columns.items() if joint not in gone}
        kept |= {joint: reduce(product, (columns[each] for each in own)) for joint, own in groups.items()}
        return replace(self, joints=tuple(kept), rotations=continuous(np.stack(list(kept.values()), axis=1)))

    def filtered(self, cutoff: float) -> "Clip":
        """Return the clip low-pass filtered at a frequency, Hz, which removes the noise of captures (thesis 3.2.2.2).

        Args:
            cutoff: 0 does not filter.

        Raises:
            RealizerError: "bad-keys": its keys are not evenly spaced, or the frequency is too low.
        """
        if not cutoff:
            return self
        smooth = low_pass(self.rotations, self.times, cutoff, self.name)
        roots = None if self.roots is None else low_pass(self.roots, self.times, cutoff, self.name)
        return replace(self, rotations=smooth / np.linalg.norm(smooth, axis=-1, keepdims=True), roots=roots)

    def _place(self, time: float) -> tuple[int, float]:
        """Return the last key at or before a time that has a successor, and the share of the interval between both."""
        key = min(max(bisect_right(self.times, time) - 1, 0), len(self.times) - 2)
        before, after = self.times[key], self.times[key + 1]
        return key, min(1.0, max(0.0, (time - before) / (after - before)))


def continuous(rotations: NDArray[np.float64]) -> NDArray[np.float64]:
    """Choose of q and -q, which are the same rotation, the one nearer to the previous key (thesis, equations 3.8, 3.9).

    Args:
        rotations: (K, J, 4).
    """
    flips = np.where(np.sum(rotations[1:] * rotations[:-1], axis=-1) < 0.0, -1.0, 1.0)
    signs = np.concatenate([np.ones_like(rotations[:1, :, 0]), np.cumprod(flips, axis=0)])
    result: NDArray[np.float64] = rotations * signs[..., np.newaxis]
    return result
