"""Inverse kinematics of the legs, and contact of a body with the ground."""

import math
from collections.abc import Mapping, Sequence
from functools import lru_cache

from reactive_realizer.embodiment.body import Body, Skeleton, Transform
from reactive_realizer.embodiment.joints import ROOT, SIDES
from reactive_realizer.embodiment.quaternion import Quat, between, conjugate, multiply, rotate
from reactive_realizer.embodiment.two_bone_ik import Leg
from reactive_realizer.embodiment.vector import Vec3, add, dot, length, scale, subtract, unit

LEG_JOINTS = frozenset(f"{side}_{joint}" for side in SIDES for joint in Leg.JOINTS)
"""The joints that turn to place a foot."""

_LEGS = {side: tuple(f"{side}_{joint}" for joint in Leg.JOINTS) for side in SIDES}

_NOTHING = 1e-6
"""m"""


def walks(skeleton: Skeleton) -> bool:
    """Return whether a figure has two legs with a length."""
    return all(joint in skeleton and length(skeleton.offset(joint)) > 0.0 for joint in LEG_JOINTS)


def feet(body: Body) -> tuple[Transform, ...]:
    """Return the transforms of the ankles, left first.

    Raises:
        KeyError: the body lacks an ankle.
    """
    left, right = _ANKLES
    return body.transform(left), body.transform(right)


def legs(body: Body, places: Sequence[Transform]) -> dict[str, Quat]:
    """Return rotations of hips, knees and ankles that place both feet.

    Args:
        body: of a figure that `walks`.
        places: goal transforms of the ankles, left first.
    """
    left, right = places
    return leg(body, "l", left) | leg(body, "r", right)


def leg(body: Body, side: str, foot: Transform) -> dict[str, Quat]:
    """Return rotations of hip, knee and ankle that place a foot, or bring it as near as the leg reaches.

    The knee, as it is turned, bends until the leg is as long as the distance. Then the hip turns the leg to the goal by
    the smallest turn, and the ankle gives the foot its orientation. If the goal is at the hip, the leg stays as it is.

    Args:
        body: of a figure that `walks`.
        side: "l" or "r".
        foot: goal transform of the ankle.
    """
    hip, knee, ankle = _LEGS[side]
    pelvis = body.transform(ROOT).rotation
    way = rotate(conjugate(pelvis), subtract(foot.position, body.transform(hip).position))
    shank = rotate(body.rotation(knee), body.skeleton.offset(ankle))
    bend, end = Leg(body.skeleton.offset(knee), shank).bent(Leg.HINGE, length(way))
    if min(length(way), length(end)) < _NOTHING:
        return {joint: body.rotation(joint) for joint in (hip, knee, ankle)}
    hip_turn = multiply(between(unit(rotate(body.rotation(hip), end)), unit(way)), body.rotation(hip))
    knee_turn = multiply(bend, body.rotation(knee))
    above = multiply(multiply(pelvis, hip_turn), knee_turn)
    return {hip: hip_turn, knee: knee_turn, ankle: multiply(conjugate(above), foot.rotation)}


@lru_cache
def reach(skeleton: Skeleton, side: str) -> float:
    """Return the distance from hip to ankle ("l" or "r") in the default pose, m; the knee is almost straight."""
    _, knee, ankle = _LEGS[side]
    return length(add(skeleton.offset(knee), skeleton.offset(ankle)))


def drawn(body: Body, places: Sequence[Transform], way: Vec3) -> list[Transform]:
    """Return both foot transforms dragged along a path over the ground until the legs reach them, or to its end.

    Args:
        body: of a figure that `walks`.
        places: transforms of the ankles, left first.
        way: the path, m; its height has no effect.
    """
    x, _, z = way
    far = max(_missing(body, side, foot, (x, 0.0, z)) for side, foot in zip(SIDES, places, strict=True))
    return [Transform(add(foot.position, (far * x, 0.0, far * z)), foot.rotation) for foot in places]


def _missing(body: Body, side: str, foot: Transform, way: Vec3) -> float:
    """Return the smallest share of a path, 0 to 1, after which a leg reaches its foot, or comes nearest to it."""
    gap = subtract(foot.position, body.transform(f"{side}_hip").position)
    beyond = dot(gap, gap) - reach(body.skeleton, side) ** 2
    square = dot(way, way)
    if beyond <= 0.0 or square == 0.0:
        return 0.0
    # |gap + share way|^2 = reach^2
    half = -dot(gap, way) / square
    return min(1.0, max(0.0, half - math.sqrt(max(0.0, half * half - beyond / square))))


_FLESH = {ROOT: 0.11, "vt6": 0.12, "skullbase": 0.09, "l_knee": 0.06, "r_knee": 0.06}
"""Clearance of these joints above the ground, m: thickness of the body around them, for a figure of ordinary size."""

_ANKLES = ("l_ankle", "r_ankle")
_SOLES = (*_ANKLES, "l_midtarsal", "r_midtarsal")


def grounded(body: Body) -> Body:
    """Return the body with its root placed so that it rests on the ground.

    The lowest part touches the ground: the feet of a standing or sitting figure, the back of a lying one. The midpoint
    between the ankles stays where it is in the default pose. The root of a figure without legs is not moved.
    """
    if not all(ankle in body.skeleton for ankle in _ANKLES):
        return Body(body.skeleton, body.pose)
    default, free = Body(body.skeleton), Body(body.skeleton, body.pose)
    clearances = {**_FLESH, **soles(body.skeleton)}.items()
    up = max(above - free.transform(joint).position[1] for joint, above in clearances if joint in body.skeleton)
    (to_x, _, to_z), (x, _, z) = _between_feet(default), _between_feet(free)
    return Body(body.skeleton, body.pose, (to_x - x, up, to_z - z))


def soles(skeleton: Skeleton) -> dict[str, float]:
    """Return the height of the foot joints in the default pose, m: the thickness of the soles."""
    default = Body(skeleton)
    return {joint: default.transform(joint).position[1] for joint in _SOLES if joint in skeleton}


def depth(body: Body, thick: Mapping[str, float]) -> float:
    """Return how deep the lowest of the `soles` is below the ground, m; 0 if none is."""
    return max(0.0, max((high - body.transform(joint).position[1] for joint, high in thick.items()), default=0.0))


def _between_feet(body: Body) -> Vec3:
    left, right = (body.transform(ankle).position for ankle in _ANKLES)
    return scale(add(left, right), 0.5)
