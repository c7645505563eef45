"""Shapes of segments: primitives with the volume that follows from a segment's mass and density."""

import math
from dataclasses import dataclass

from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.feet import soles
from reactive_realizer.embodiment.joints import ROOT, SIDES
from reactive_realizer.embodiment.vector import Vec3, add, length, scale, subtract

_SHORTEST = 0.02
"""Shortest dimension of a shape, m: a skeleton may have joints that coincide."""

_HEAD = (0.75, 1.3, 1.0)
"""Proportions of the semi-axes of head and neck: width, height, depth."""

_HAND_TO_KNUCKLE = 1.9
"""Length of a hand as a multiple of the distance from the wrist to the first joint of the middle finger."""

_HAND_TO_FOREARM = 0.74
"""Length of a hand as a multiple of the forearm's (Drillis and Contini 1966: 0.108 and 0.146 of stature)."""

_HAND_WIDTH = 0.45
"""Width of a hand as a share of its length."""

_HEEL, _TOE = -0.5, 1.6
"""Ends of a foot as multiples of the horizontal distance from the ankle to the ball of the foot."""


@dataclass(frozen=True, slots=True)
class Shape:
    """A geometric primitive of uniform density, in the axes of its segment.

    Attributes:
        kind: MuJoCo's name: ellipsoid, cylinder or box.
        size: semi-axes of an ellipsoid, half edges of a box, or radius and half length of a cylinder, m.
        center: from the segment's joint, m.
        axis: of a cylinder, from end to end, m.
    """

    kind: str
    size: tuple[float, ...]
    center: Vec3
    axis: Vec3 | None = None


def shape(skeleton: Skeleton, joint: str, volume: float) -> Shape:
    """Return the shape of a segment of a skeleton in the default pose.

    Args:
        skeleton: of the figure.
        joint: of the segment.
        volume: m^3; the dimension that the skeleton does not give follows from it.
    """
    body = Body(skeleton)
    if joint == ROOT:
        return _pelvis(body, volume)
    if joint == "vl5":
        return _upper_body(body, volume)
    if joint == "vc4":
        return _head(body, volume)
    side, _, name = joint.partition("_")
    if name == "wrist":
        return _hand(body, side, volume)
    if name == "ankle":
        return _foot(body, side, volume)
    return _limb(body, joint, f"{side}_{_ENDS[name]}", volume)


_ENDS = {"shoulder": "elbow", "elbow": "wrist", "hip": "knee", "knee": "ankle"}


def _limb(body: Body, joint: str, end: str, volume: float) -> Shape:
    """Return a cylinder from joint to joint."""
    way = _way(body, joint, end) if end in body.skeleton else (0.0, -0.25, 0.0)
    long = max(length(way), _SHORTEST)
    return Shape("cylinder", (math.sqrt(volume / (math.pi * long)), long / 2.0), scale(way, 0.5), way)


def _pelvis(body: Body, volume: float) -> Shape:
    """Return an ellipsoid from the hips to the waist, wider than the hips by half."""
    hips = [_way(body, ROOT, f"{side}_hip") for side in SIDES if f"{side}_hip" in body.skeleton]
    low = sum(hip[1] for hip in hips) / len(hips) if hips else -0.05
    high = _way(body, ROOT, "vl5")[1] if "vl5" in body.skeleton else 0.1
    wide = 1.5 * max((abs(hip[0]) for hip in hips), default=0.1)
    return _ellipsoid(wide, 0.75 * (high - low), (0.0, (high + low) / 2.0, 0.0), volume)


def _upper_body(body: Body, volume: float) -> Shape:
    """Return an ellipsoid from the waist to the neck, as wide as the shoulders."""
    high = _way(body, "vl5", "vc4")[1] if "vc4" in body.skeleton else _way(body, "vl5", "skullbase")[1]
    wide = abs(body.transform("l_shoulder").position[0] - body.transform("r_shoulder").position[0]) / 2.0
    return _ellipsoid(wide, high / 2.0, (0.0, high / 2.0, 0.0), volume)


def _ellipsoid(wide: float, high: float, center: Vec3, volume: float) -> Shape:
    """Return an ellipsoid with two given semi-axes, m; its depth follows from its volume."""
    wide, high = max(wide, _SHORTEST), max(high, _SHORTEST)
    return Shape("ellipsoid", (wide, high, _of_ellipsoid(volume) / (wide * high)), center)


def _of_ellipsoid(volume: float) -> float:
    """Return the product of the three semi-axes of an ellipsoid, m^3."""
    return volume / (4.0 / 3.0 * math.pi)


def _head(body: Body, volume: float) -> Shape:
    size = (_of_ellipsoid(volume) / math.prod(_HEAD)) ** (1.0 / 3.0)
    wide, high, deep = (size * share for share in _HEAD)
    return Shape("ellipsoid", (wide, high, deep), add(_way(body, "vc4", "skullbase"), (0.0, high / 2.0, 0.0)))


def _hand(body: Body, side: str, volume: float) -> Shape:
    """Return an ellipsoid from the wrist to the fingertips, in the direction of the forearm, palm toward the thigh."""
    wrist, knuckle = f"{side}_wrist", f"{side}_middle1"
    if knuckle in body.skeleton:
        long = _HAND_TO_KNUCKLE * length(_way(body, wrist, knuckle))
    else:
        long = _HAND_TO_FOREARM * length(_way(body, f"{side}_elbow", wrist))
    long = max(long, _SHORTEST) / 2.0
    wide = _HAND_WIDTH * long
    return Shape("ellipsoid", (_of_ellipsoid(volume) / (wide * long), long, wide), (0.0, -long, 0.0))


def _foot(body: Body, side: str, volume: float) -> Shape:
    """Return a box from the ankle down to the ground, and from heel to toe."""
    ankle, ball = f"{side}_ankle", f"{side}_midtarsal"
    high = max(soles(body.skeleton)[ankle], _SHORTEST)
    forward = max(_way(body, ankle, ball)[2] if ball in body.skeleton else 1.5 * high, _SHORTEST)
    long, middle = forward * (_TOE - _HEEL), forward * (_TOE + _HEEL) / 2.0
    wide = volume / (high * long)
    return Shape("box", (wide / 2.0, high / 2.0, long / 2.0), (0.0, -high / 2.0, middle))


def _way(body: Body, joint: str, end: str) -> Vec3:
    return subtract(body.transform(end).position, body.transform(joint).position)
