"""Feet, and legs that bring them where they are to be."""

import math
from collections.abc import Sequence

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import ROOT, SIDES
from reactive_realizer.embodiment.quaternion import Quat, between, conjugate, multiply, rotate
from reactive_realizer.embodiment.skeleton import Place, Skeleton
from reactive_realizer.embodiment.two_bone_ik import Leg
from reactive_realizer.embodiment.vector import Vec3, add, dot, length, subtract, unit

LEG_JOINTS = frozenset(f"{side}_{joint}" for side in SIDES for joint in Leg.JOINTS)
"""What turns for a foot to come to its place."""

_NOTHING = 1e-6
"""m"""


def walks(skeleton: Skeleton) -> bool:
    """Whether a figure has two legs of some length."""
    return all(joint in skeleton and length(skeleton.offset(joint)) > 0.0 for joint in LEG_JOINTS)


def feet(body: Body) -> tuple[Place, ...]:
    """Where its ankles are, the left one first.

    Raises:
        KeyError: it lacks one.
    """
    return tuple(body.place(f"{side}_ankle") for side in SIDES)


def legs(body: Body, places: Sequence[Place]) -> dict[str, Quat]:
    """Rotations of hips, knees and ankles that bring the feet to places.

    Args:
        body: that `walks`.
        places: of its ankles, the left one first.
    """
    left, right = (leg(body, side, foot) for side, foot in zip(SIDES, places, strict=True))
    return left | right


def leg(body: Body, side: str, foot: Place) -> dict[str, Quat]:
    """Rotations of hip, knee and ankle that bring a foot to a place, or as near to it as the leg reaches.

    The knee, turned as it was, bends until the leg is as long as the way; then the hip turns the leg there by the
    smallest turn, and the ankle turns the foot back. A leg whose foot is to be at its hip stays as it is.

    Args:
        body: that `walks`.
        side: "l" or "r".
        foot: the place of the ankle.
    """
    hip, knee, ankle = (f"{side}_{joint}" for joint in Leg.JOINTS)
    pelvis = body.place(ROOT).rotation
    way = rotate(conjugate(pelvis), subtract(foot.position, body.place(hip).position))
    shank = rotate(body.rotation(knee), body.skeleton.offset(ankle))
    bend, end = Leg(body.skeleton.offset(knee), shank).bent(Leg.HINGE, length(way))
    if min(length(way), length(end)) < _NOTHING:
        return {joint: body.rotation(joint) for joint in (hip, knee, ankle)}
    hip_turn = multiply(between(unit(rotate(body.rotation(hip), end)), unit(way)), body.rotation(hip))
    knee_turn = multiply(bend, body.rotation(knee))
    above = multiply(multiply(pelvis, hip_turn), knee_turn)
    return {hip: hip_turn, knee: knee_turn, ankle: multiply(conjugate(above), foot.rotation)}


def reach(skeleton: Skeleton, side: str) -> float:
    """From the hip to the ankle of a leg ("l", "r") in the default pose, in which its knee is not quite straight, m."""
    knee, ankle = (skeleton.offset(f"{side}_{joint}") for joint in Leg.JOINTS[1:])
    return length(add(knee, ankle))


def drawn(body: Body, places: Sequence[Place], way: Vec3) -> list[Place]:
    """Places of feet, both drawn along a way over the ground until the legs reach them, or to its end.

    Args:
        body: that `walks`.
        places: of its ankles, the left one first.
        way: m; its height is of no effect.
    """
    x, _, z = way
    far = max(_missing(body, side, foot, (x, 0.0, z)) for side, foot in zip(SIDES, places, strict=True))
    return [Place(add(foot.position, (far * x, 0.0, far * z)), foot.rotation) for foot in places]


def _missing(body: Body, side: str, foot: Place, way: Vec3) -> float:
    """The least share of a way, 0 to 1, after which a leg comes nearest to its foot, or reaches it."""
    gap = subtract(foot.position, body.place(f"{side}_hip").position)
    beyond = dot(gap, gap) - reach(body.skeleton, side) ** 2
    square = dot(way, way)
    if beyond <= 0.0 or square == 0.0:
        return 0.0
    # |gap + share way|^2 = reach^2
    half = -dot(gap, way) / square
    return min(1.0, max(0.0, half - math.sqrt(max(0.0, half * half - beyond / square))))
