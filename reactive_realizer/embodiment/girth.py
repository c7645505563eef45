"""How thick a figure is: its trunk, head, thighs, forearms and hands as round shapes, measured from its skin."""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.joints import ROOT, SIDES, TRUNK
from reactive_realizer.embodiment.skin import Skin, read_skin
from reactive_realizer.embodiment.vector import Vec3, length, subtract

SECTIONS = tuple(0.125 * number for number in range(-1, 9))
"""Where sections of the trunk are measured: shares of the way from root to neck."""

_NEARBY = 0.07
"""Share of this way within which vertices belong to a section."""

_CENTER = 0.35
"""Center of a section, as a share of its depth: near the spine, so that hands are pushed out in front."""

_FEWEST = 20
"""Fewest vertices that tell a size."""

_USUAL_SECTION = (0.3, 0.26, 0.14, 0.05)
_USUAL_HEAD = (0.085, 0.115, 0.1)
_USUAL_THIGH, _USUAL_FOREARM, _USUAL_HAND = (0.2, 0.15), (0.085, 0.043), 0.035
"""The same for a figure without a readable skin, in lengths of its trunk; the head in meters."""


class Section(NamedTuple):
    """A section of the trunk: the halves of two ellipses of the same width, m.

    Attributes:
        side: half of the width.
        front: depth of the half in front of the center.
        back: depth of the half behind it.
        ahead: place of the center before the line from root to neck.
    """

    side: float
    front: float
    back: float
    ahead: float


class Cone(NamedTuple):
    """Radii of a limb near its first joint and at its second one, m."""

    begin: float
    end: float


class Girth(NamedTuple):
    """The thickness of a figure.

    Attributes:
        trunk: at each of the `SECTIONS`.
        head: center in the axes of skullbase, m.
        head_size: semi-axes of the head, m.
        thigh: from hip to knee.
        forearm: from elbow to wrist.
        hand: half of its thickness, m.
    """

    trunk: tuple[Section, ...]
    head: Vec3
    head_size: Vec3
    thigh: Cone
    forearm: Cone
    hand: float


@lru_cache
def girth_of(avatar: Avatar) -> Girth:
    """Return the thickness of an avatar; where its skin cannot be read, that of a person with such a trunk."""
    try:
        skin = read_skin(avatar)
    except (LookupError, TypeError, ValueError):
        skin = {}
    top = "vc4" if "vc4" in avatar.skeleton else "skullbase"
    trunk = length(subtract(_at(avatar, top), _at(avatar, ROOT)))
    head = skin.get("skullbase", np.empty((0, 3))) - _at(avatar, "skullbase")
    center, size = _box(head) if len(head) >= _FEWEST else ((0.0, 0.09, 0.02), _USUAL_HEAD)
    hand = _radii(skin, avatar, "wrist", "middle2")
    return Girth(
        _trunk(skin, avatar, top, trunk),
        center,
        size,
        _cone(skin, avatar, ("hip", "knee"), 0.2) or Cone(*(trunk * part for part in _USUAL_THIGH)),
        _cone(skin, avatar, ("elbow", "wrist"), 0.15) or Cone(*(trunk * part for part in _USUAL_FOREARM)),
        trunk * _USUAL_HAND if hand is None else float(np.percentile(hand[1], 25)),
    )


def _at(avatar: Avatar, joint: str) -> Vec3:
    position = avatar.rest_position(joint)
    if position is None:
        raise KeyError(joint)
    return position


def _trunk(skin: Skin, avatar: Avatar, top: str, size: float) -> tuple[Section, ...]:
    parts = [skin[joint] for joint in TRUNK if joint in skin]
    root = np.array(_at(avatar, ROOT))
    points = np.concatenate(parts) - root if parts else np.empty((0, 3))
    way = (np.array(_at(avatar, top)) - root) / size
    shares = points @ way / size
    points = points - np.outer(size * shares, way)
    return tuple(_section(points[abs(shares - share) < _NEARBY], size) for share in SECTIONS)


def _section(points: NDArray[np.float64], size: float) -> Section:
    if len(points) < _FEWEST:
        return Section(*(size * part for part in _USUAL_SECTION))
    side = float(np.percentile(abs(points[:, 0]), 97))
    back, front = map(float, np.percentile(points[:, 2], (2, 98)))
    center = back + _CENTER * (front - back)
    return Section(side, front - center, center - back, center)


def _box(points: NDArray[np.float64]) -> tuple[Vec3, Vec3]:
    low, high = np.percentile(points, (1, 99), axis=0)
    (x, y, z), (a, b, c) = (0.5 * (low + high)).tolist(), (0.5 * (high - low)).tolist()
    return (x, y, z), (a, b, c)


def _cone(skin: Skin, avatar: Avatar, joints: tuple[str, str], begin: float) -> Cone | None:
    """Return the thickness of a limb, measured at a share of its length and at its end."""
    radii = _radii(skin, avatar, *joints)
    if radii is None:
        return None
    shares, sizes = radii
    parts = [sizes[abs(shares - share) < 0.1] for share in (begin, 0.95)]
    if min(map(len, parts)) < _FEWEST:
        return None
    return Cone(*(float(np.median(part)) for part in parts))


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
