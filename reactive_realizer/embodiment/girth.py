"""How thick a figure is: its trunk, head, thighs, forearms and hands, measured from its skin."""

import logging
import math
from collections.abc import Mapping
from functools import lru_cache
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.joints import HEAD, ROOT, SIDES, TRUNK
from reactive_realizer.embodiment.profile import Profile
from reactive_realizer.embodiment.skin import Skin, read_skin
from reactive_realizer.embodiment.vector import Vec3, distance

logger = logging.getLogger(__name__)

_FEWEST = 20
"""Fewest vertices that tell a size."""

FOREARM = (0.08, 0.3, 0.55, 0.8, 1.0)
"""Where a forearm is measured: shares of the way from elbow to wrist."""

_NEARBY = 0.1
"""Share of this way within which vertices belong to a place."""

_FLESHY = 95.0
"""Percentage of them that are no farther from the axis than the forearm is thick: it is no cylinder."""

_TRUNK_ENDS, _TRUNK_ROWS = (-0.2, 1.0), 13
_THIGH_ENDS, _THIGH_ROWS = (0.0, 1.0), 9
_BACK = 0.5
"""Place of the axis of a thigh behind its joints, in its usual radii: what is in a thigh goes out in front or aside."""

_HEAD_ENDS, _HEAD_ROWS = (0.0, 0.95), 9

_USUAL_TRUNK: Mapping[str, float] = MappingProxyType({"side": 0.3, "front": 0.31, "back": 0.1})
_USUAL_HEAD = (0.085, 0.115, 0.1)
_USUAL_HEAD_CENTER = (0.0, 0.09, 0.02)
_USUAL_THIGH, _USUAL_FOREARM, _USUAL_HAND, _USUAL_FINGER = (0.2, 0.15), (0.085, 0.043), 0.035, 0.02
"""The same for a figure without a readable skin, in lengths of its trunk; the head in meters."""

_Points = NDArray[np.float64]


class Girth(NamedTuple):
    """The thickness of a figure.

    Attributes:
        trunk: around the line from the root to the neck.
        head: around an upward line.
        chin: where this line begins, in the axes of skullbase, m.
        head_size: its length, m.
        thigh: around a line behind that from hip to knee, of the left leg; that of the right one is its mirror image.
        behind: how far this line is behind the other one, m.
        forearm: its radii at the shares `FOREARM` of the way from elbow to wrist, m.
        hand: half of the thickness of the palm, m.
        finger: half of that of a finger, m.
    """

    trunk: Profile
    head: Profile
    chin: Vec3
    head_size: float
    thigh: Profile
    behind: float
    forearm: tuple[float, ...]
    hand: float
    finger: float


@lru_cache
def girth_of(avatar: Avatar) -> Girth:
    """Return the thickness of an avatar; where its skin cannot be read, that of a person with such a trunk."""
    try:
        skin = read_skin(avatar)
    except (LookupError, TypeError, ValueError) as problem:
        name = "" if avatar.path is None else avatar.path.name
        logger.warning("the skin of %s is not read: %r; the figure is as thick as people are", name, problem)
        skin = {}
    neck = HEAD[0] if HEAD[0] in avatar.skeleton else HEAD[1]
    trunk = distance(_at(avatar, neck), _at(avatar, ROOT))
    hand = _radii(skin, avatar, "wrist", "middle2")
    finger = _radii(skin, avatar, "index2", "index3")
    head, chin, head_size = _head(skin, avatar)
    thigh, behind = _thigh(skin, avatar, trunk)
    return Girth(
        _trunk(skin, avatar, neck, trunk),
        head,
        chin,
        head_size,
        thigh,
        behind,
        _forearm(skin, avatar, trunk),
        trunk * _USUAL_HAND if hand is None else float(np.percentile(hand[1], 25)),
        trunk * _USUAL_FINGER if finger is None else float(np.median(finger[1])),
    )


def _at(avatar: Avatar, joint: str) -> Vec3:
    position = avatar.rest_position(joint)
    if position is None:
        raise KeyError(joint)
    return position


def _trunk(skin: Skin, avatar: Avatar, neck: str, size: float) -> Profile:
    points = _of(skin, (*TRUNK, neck) if neck != HEAD[1] else TRUNK)
    if len(points) >= _FEWEST:
        return _profile(points, _at(avatar, ROOT), _at(avatar, neck), _TRUNK_ENDS, _TRUNK_ROWS)
    side, front, back = _USUAL_TRUNK.values()
    angles = _all_around()
    deep = np.where(np.cos(angles) > 0.0, front, back)
    radii = size / np.hypot(np.sin(angles) / side, np.cos(angles) / deep)
    return _round(_TRUNK_ENDS, _TRUNK_ROWS, np.repeat(radii[np.newaxis], _TRUNK_ROWS, axis=0))


def _head(skin: Skin, avatar: Avatar) -> tuple[Profile, Vec3, float]:
    """Return the head, where its line begins, in the axes of skullbase, m, and the length of this line, m."""
    points = skin.get(HEAD[1], np.empty((0, 3))) - _at(avatar, HEAD[1])
    if len(points) >= _FEWEST:
        low, high = np.percentile(points, (1, 99), axis=0)
        (x, _, z), bottom, size = (0.5 * (low + high)).tolist(), float(low[1]), float(high[1] - low[1])
        chin = (x, bottom, z)
        return _profile(points, chin, (x, bottom + size, z), _HEAD_ENDS, _HEAD_ROWS), chin, size
    (width, height, depth), (x, y, z) = _USUAL_HEAD, _USUAL_HEAD_CENTER
    shares = np.linspace(*_HEAD_ENDS, _HEAD_ROWS)
    across = np.sqrt(np.maximum(0.0, 1.0 - (2.0 * shares - 1.0) ** 2))
    angles = _all_around()
    radii = 1.0 / np.hypot(np.sin(angles) / width, np.cos(angles) / depth)
    return _round(_HEAD_ENDS, _HEAD_ROWS, np.outer(across, radii)), (x, y - height, z), 2.0 * height


def _thigh(skin: Skin, avatar: Avatar, trunk: float) -> tuple[Profile, float]:
    """Return the thigh, and how far the line around which it is goes behind the joints, m."""
    begin, end = (avatar.rest_position(f"l_{joint}") for joint in ("hip", "knee"))
    points = np.concatenate((_of(skin, ("l_hip",)), _of(skin, ("r_hip",)) * (-1.0, 1.0, 1.0)))
    first, last = (trunk * part for part in _USUAL_THIGH)
    behind = _BACK * first
    if begin is not None and end is not None and len(points) >= _FEWEST:
        return _profile(points, begin, end, _THIGH_ENDS, _THIGH_ROWS, behind), behind
    angles = _all_around()
    straight = behind * np.cos(angles)
    radii = np.linspace(first, last, _THIGH_ROWS)[:, np.newaxis]
    return _round(_THIGH_ENDS, _THIGH_ROWS, straight + np.sqrt(straight**2 + radii**2 - behind**2)), behind


def _of(skin: Skin, joints: tuple[str, ...]) -> _Points:
    return np.concatenate((np.empty((0, 3)), *(skin[joint] for joint in joints if joint in skin)))


def _profile(
    points: _Points, begin: Vec3, end: Vec3, ends: tuple[float, float], rows: int, behind: float = 0.0
) -> Profile:
    """Return the surface of vertices of the resting figure, (V, 3), m, around a line.

    Args:
        points: the vertices.
        begin: of the line, m.
        end: of the line, m.
        ends: shares of the line at which the first and the last row of the profile are.
        rows: of the profile.
        behind: how far behind the line its axis is, m.
    """
    size = distance(begin, end)
    along = (np.array(end) - begin) / size
    left = np.array((1.0, 0.0, 0.0)) - along[0] * along
    left /= np.linalg.norm(left)
    from_begin = points - begin
    x, z = from_begin @ left, from_begin @ np.cross(left, _upward(along)) + behind
    return Profile.through(from_begin @ along / size, np.arctan2(x, z), np.hypot(x, z), ends, rows)


def _upward(along: _Points) -> _Points:
    """Return the direction of a line, or the opposite one if it goes down: in front is always in front."""
    return along if along[1] >= 0.0 else -along


def _all_around() -> _Points:
    return np.linspace(-math.pi, math.pi, 64, endpoint=False)


def _round(ends: tuple[float, float], rows: int, radii: _Points) -> Profile:
    """Return the surface with some radii, m, (rows, angles)."""
    shares, angles = np.meshgrid(np.linspace(*ends, rows), _all_around(), indexing="ij")
    return Profile.through(shares.ravel(), angles.ravel(), radii.ravel(), ends, rows)


def _forearm(skin: Skin, avatar: Avatar, trunk: float) -> tuple[float, ...]:
    measured = _radii(skin, avatar, "elbow", "wrist")
    if measured is not None:
        shares, sizes = measured
        parts = [sizes[abs(shares - min(0.9, max(0.15, share))) < _NEARBY] for share in FOREARM]
        if min(map(len, parts)) >= _FEWEST:
            return tuple(float(np.percentile(part, _FLESHY)) for part in parts)
    begin, end = (trunk * part for part in _USUAL_FOREARM)
    return tuple(begin + share * (end - begin) for share in FOREARM)


def _radii(skin: Skin, avatar: Avatar, begin: str, end: str) -> tuple[NDArray[np.float64], NDArray[np.float64]] | None:
    """Return where along a limb the vertices of both sides are, as a share, and how far away from its axis, m."""
    shares, sizes = [], []
    for side in SIDES:
        start, stop = (avatar.rest_position(f"{side}_{joint}") for joint in (begin, end))
        points = skin.get(f"{side}_{begin}")
        if start is None or stop is None or points is None:
            return None
        way = np.array(stop) - start
        share = (points - start) @ way / (way @ way)
        shares.append(share)
        sizes.append(np.linalg.norm(points - start - np.outer(share, way), axis=1))
    found, far = np.concatenate(shares), np.concatenate(sizes)
    return (found, far) if len(found) >= _FEWEST else None
