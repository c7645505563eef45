"""The shortest durations of the parts of a clip: how fast the limits of the body let it be played."""

from collections.abc import Mapping
from dataclasses import replace
from itertools import pairwise

import numpy as np

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import SIDES
from reactive_realizer.embodiment.quaternion import IDENTITY
from reactive_realizer.embodiment.speed_limit import ROOT_SPEED, WRIST_SPEED, fastest
from reactive_realizer.engines.animation.keyframe.capture import Array, inverse, product, rotated
from reactive_realizer.engines.animation.keyframe.clip import Clip
from reactive_realizer.engines.animation.shortest import from_rest

_STEP = 0.08
"""Shortest time between the keys at which the speed of a clip is measured, s; below that, it would be noise."""


def shortest_clip_parts(clip: Clip, rest: Body, key_positions: Mapping[str, float]) -> dict[str, float]:
    """Return the shortest durations of all parts of a clip, by the points at which they end (`MotionUnit`), s.

    As in any motion (`shortest_duration`), the body may fall behind where a part is fastest, and has caught up with it
    at its end.

    Args:
        clip: of joints that the figure has.
        rest: the pose of the other joints.
        key_positions: of the points, in order.
    """
    clip = _thinned(clip)
    times = np.asarray(clip.times) - clip.times[0]
    needed = np.concatenate([[0.0], np.cumsum(_step_times(clip, rest))])
    parts = ((point, begin, end) for (_, begin), (point, end) in pairwise(key_positions.items()) if begin < end)
    return {point: _shortest(times, needed, clip.duration * begin, clip.duration * end) for point, begin, end in parts}


def _shortest(times: Array, needed: Array, begin: float, end: float) -> float:
    """Return the shortest duration of a part between two times, s.

    Args:
        times: of the keys, s, (K,).
        needed: time that the clip needs until each key at the highest speeds, s, (K,).
        begin: s.
        end: s.
    """
    since = np.append(times[(times > begin) & (times < end - _STEP)], begin)
    left = np.interp(end, times, needed) - np.interp(since, times, needed)
    return min(end - begin, from_rest((end - begin) * float(np.max(left / (end - since)))))


def _thinned(clip: Clip) -> Clip:
    """Return a clip with the keys at which its speed is measured, the first and the last included."""
    times = np.asarray(clip.times)
    keys = np.unique(np.searchsorted(times, np.append(np.arange(times[0], times[-1], _STEP), times[-1])))
    roots = None if clip.roots is None else clip.roots[keys]
    return replace(clip, times=tuple(times[keys].tolist()), rotations=clip.rotations[keys], roots=roots)


def _step_times(clip: Clip, rest: Body) -> Array:
    """Return the time between each two keys at the highest speeds of joints, wrists and root, s, (K - 1,)."""
    limits = np.array([fastest(joint) for joint in clip.joints])
    turns = product(inverse(clip.rotations[:-1]), clip.rotations[1:])
    angles = 2.0 * np.arctan2(np.linalg.norm(turns[..., 1:], axis=-1), np.abs(turns[..., 0]))
    steps: Array = np.max(angles / limits, axis=1)
    for side in SIDES:
        steps = np.maximum(steps, _ways(_path(f"{side}_wrist", clip, rest)) / WRIST_SPEED)
    return steps if clip.roots is None else np.maximum(steps, _ways(clip.roots) / ROOT_SPEED)


def _path(joint: str, clip: Clip, rest: Body) -> Array:
    """Return the positions of a joint relative to the root at the keys of a clip, m, (K, 3); 0 if there is none."""
    position: Array = np.zeros((len(clip.times), 3))
    rotation: Array = np.array(IDENTITY)
    if joint not in rest.skeleton:
        return position
    for name, offset in rest.skeleton.links(joint):
        position = position + rotated(rotation, np.array(offset))
        turn = clip.rotations[:, clip.joints.index(name)] if name in clip.joints else np.array(rest.rotation(name))
        rotation = product(rotation, turn)
    return position


def _ways(path: Array) -> Array:
    """Return the distances between the positions of a path, m."""
    ways: Array = np.linalg.norm(np.diff(path, axis=0), axis=1)
    return ways
