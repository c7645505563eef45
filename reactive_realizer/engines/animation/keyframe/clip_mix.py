"""Several clips as one, each with a weight: what corresponds in them happens at the same time."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import hypot

import numpy as np

from reactive_realizer.embodiment.quaternion import Quat
from reactive_realizer.embodiment.vector import ZERO, Vec3, add, scale
from reactive_realizer.engines.animation.easing import minimum_jerk
from reactive_realizer.engines.animation.faults import BadKeys
from reactive_realizer.engines.animation.keyframe.capture import Array, inverse, product
from reactive_realizer.engines.animation.keyframe.clip import Clip, continuous
from reactive_realizer.errors import RealizerError

_SEAM, _LARGEST_SEAM = 0.4, 0.3
"""Time before the end of a loop in which it goes over to its beginning, s, and its limit as a share of the clip."""
_RATE = 30.0
"""Rate at which a mix is sampled, Hz."""

Weights = Sequence[float]
"""Of the clips, together 1."""


@dataclass(frozen=True, slots=True, eq=False)
class ClipMix:
    """Clips and the times in them that correspond.

    A *course* counts these times: 0 at the first one, 1 at the second one; in between, clips play evenly.

    Attributes:
        clips: with the same joints.
        marks: for each clip, corresponding times, s of the clip, increasing; the first and the last are its ends.
    """

    clips: tuple[Clip, ...]
    marks: tuple[tuple[float, ...], ...]

    @classmethod
    def of(cls, clips: Sequence[Clip], marks: Sequence[Sequence[float]] | None = None) -> "ClipMix":
        """Mix clips, in the joints that all have; without marks, the sync points that all have correspond.

        Raises:
            RealizerError: "bad-keys": they share no joint.
        """
        shared = frozenset.intersection(*(frozenset(clip.joints) for clip in clips))
        if not shared:
            raise RealizerError(BadKeys(animation=clips[-1].name, reason="it shares no joint with the other clips"))
        points = set.intersection(*(set(clip.points) for clip in clips))
        order = sorted(points, key=lambda sync: clips[0].points[sync].time)
        own = marks or [[clip.points[sync].time for sync in order] for clip in clips]
        return cls(
            tuple(clip.only(shared) for clip in clips),
            _corresponding([[clip.times[0], *inner, clip.times[-1]] for clip, inner in zip(clips, own, strict=True)]),
        )

    @property
    def length(self) -> int:
        """The course at the end."""
        return len(self.marks[0]) - 1

    def times(self, weights: Weights) -> list[float]:
        """Return the times of the mix that correspond to the marks, from 0 on, s."""
        shares = list(zip(weights, self.marks, strict=True))
        return [sum(weight * (own[k] - own[0]) for weight, own in shares) for k in range(self.length + 1)]

    def course(self, sync: str, weights: Weights) -> float | None:
        """Return where a sync point is; None if a clip with a weight lacks it."""
        found = 0.0
        for clip, own, weight in zip(self.clips, self.marks, weights, strict=True):
            if weight > 0.0:
                if sync not in clip.points:
                    return None
                found += weight * float(np.interp(clip.points[sync].time, own, range(len(own))))
        return found

    def rotations_at(self, course: float, weights: Weights) -> dict[str, Quat]:
        """Return the rotations of the joints, each the mean of those of the clips."""
        shown = [(weight, clip.rotations_at(time)) for clip, time, weight in self._playing(course, weights)]
        _, first = shown[0]
        return (
            first if len(shown) == 1 else {joint: _mean([(w, turns[joint]) for w, turns in shown]) for joint in first}
        )

    def root_at(self, course: float, weights: Weights) -> Vec3 | None:
        """Return the displacement of HumanoidRoot from the first key, m; None if no clip moves it."""
        moves = [(weight, clip.root_at(time)) for clip, time, weight in self._playing(course, weights)]
        if all(moved is None for _, moved in moves):
            return None
        together = ZERO
        for weight, moved in moves:
            together = add(together, scale(moved or ZERO, weight))
        return together

    def sampled(self, weights: Weights) -> Clip:
        """Return the mix with constant weights as a clip, from the time 0 on."""
        times = self.times(weights)
        at = np.linspace(0.0, times[-1], max(2, round(_RATE * times[-1]) + 1))
        courses = np.interp(at, times, range(len(times))).tolist()
        turns = [self.rotations_at(course, weights) for course in courses]
        roots = [self.root_at(course, weights) for course in courses]
        first = self.clips[0]
        return replace(
            first,
            times=tuple(at.tolist()),
            rotations=continuous(np.array([[turned[joint] for joint in first.joints] for turned in turns])),
            roots=None if roots[0] is None else np.array(roots),
            points={},
        )

    def _playing(self, course: float, weights: Weights) -> list[tuple[Clip, float, float]]:
        """Return the clips that have a weight, with their time, s, and their weight."""
        k = min(int(course), self.length - 1)
        done = course - k
        return [
            (clip, own[k] + done * (own[k + 1] - own[k]), weight)
            for clip, own, weight in zip(self.clips, self.marks, weights, strict=True)
            if weight > 0.0
        ]


def _corresponding(marks: Sequence[Sequence[float]]) -> tuple[tuple[float, ...], ...]:
    """Return marks without those that do not come after the one before in every clip, or not before the end."""
    kept = [0]
    for k in range(1, len(marks[0]) - 1):
        if all(own[kept[-1]] < own[k] < own[-1] for own in marks):
            kept.append(k)
    return tuple(tuple(own[k] for k in (*kept, len(own) - 1)) for own in marks)


def _mean(turns: Sequence[tuple[float, Quat]]) -> Quat:
    """Return the normalized mean of rotations, each with a weight."""
    _, first = turns[0]
    total = [0.0, 0.0, 0.0, 0.0]
    for weight, turn in turns:
        signed = weight if sum(a * b for a, b in zip(first, turn, strict=True)) >= 0.0 else -weight
        total = [before + signed * value for before, value in zip(total, turn, strict=True)]
    size = hypot(*total)
    w, x, y, z = (value / size for value in total)
    return (w, x, y, z)


def seamless(clip: Clip) -> Clip:
    """Return a clip that can be played over and over: it ends in its first pose, and its root does not travel."""
    span = min(_SEAM, _LARGEST_SEAM * clip.duration)
    clip = _keyed(clip, np.linspace(clip.times[-1] - span, clip.times[-1], round(_RATE * span) + 2).tolist())
    times = np.array(clip.times)
    shares = [minimum_jerk(float(share)) for share in np.clip((times - times[-1] + span) / span, 0.0, 1.0)]
    missing = product(inverse(clip.rotations[-1]), clip.rotations[0])  # from the last pose to the first
    turned = product(clip.rotations, _powers(missing, np.array(shares)))
    if clip.roots is None:
        return replace(clip, rotations=continuous(turned))
    done = ((times - times[0]) / clip.duration)[:, np.newaxis]
    return replace(clip, rotations=continuous(turned), roots=clip.roots - done * (clip.roots[-1] - clip.roots[0]))


def _keyed(clip: Clip, times: Sequence[float]) -> Clip:
    """Return a clip with further keys, which do not change it."""
    every = sorted({*clip.times, *times})
    turns = [clip.rotations_at(time) for time in every]
    return replace(
        clip,
        times=tuple(every),
        rotations=continuous(np.array([[turned[joint] for joint in clip.joints] for turned in turns])),
        roots=None if clip.roots is None else np.array([clip.root_at(time) for time in every]),
    )


def _powers(turns: Array, shares: Array) -> Array:
    """Return the shares of turns, (K, J, 4), of turns (J, 4) and shares (K,)."""
    turns = np.where(turns[:, :1] < 0.0, -turns, turns)
    sines = np.linalg.norm(turns[:, 1:], axis=1)
    half = np.arctan2(sines, turns[:, 0])
    axes = turns[:, 1:] / np.where(sines > 0.0, sines, 1.0)[:, np.newaxis]
    halves = shares[:, np.newaxis] * half
    powers: Array = np.concatenate([np.cos(halves)[..., np.newaxis], np.sin(halves)[..., np.newaxis] * axes], axis=-1)
    return powers


def relative(clip: Clip) -> Clip:
    """Return the turns of a clip since its first pose, to be added to other motion."""
    return replace(clip, rotations=continuous(product(inverse(clip.rotations[:1]), clip.rotations)))
