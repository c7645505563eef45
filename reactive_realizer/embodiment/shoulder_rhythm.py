"""Scapulohumeral rhythm: the shoulder girdle takes a third of the elevation of an arm.

V. T. Inman, J. B. Saunders and L. C. Abbott, "Observations on the function of the shoulder joint" (Journal of Bone and
Joint Surgery 26, 1944): after the first 30 degrees, it turns by one degree for every two of the upper arm. Skeletons
have one joint for the girdle, the sternoclavicular one.
"""

import math

from reactive_realizer.embodiment.arm_anatomy import ArmRotations
from reactive_realizer.embodiment.body import Skeleton
from reactive_realizer.embodiment.quaternion import (
    IDENTITY,
    Quat,
    between,
    conjugate,
    from_axis_angle,
    multiply,
    rotate,
)
from reactive_realizer.embodiment.two_bone_ik import Arm
from reactive_realizer.embodiment.vector import Vec3, add, subtract, unit

_SETTING = math.radians(30.0)
"""Elevation of the upper arm from which on the girdle turns, rad."""

_SOFTLY = math.radians(15.0)
"""Elevation around that in which it begins to, rad."""

_SHARE = 1.0 / 3.0


def girdle_elevation(upper_arm: Vec3) -> float:
    """Return the elevation of the girdle, rad, for the direction of an upper arm in the axes of the trunk."""
    _, y, _ = unit(upper_arm)
    beyond = math.acos(max(-1.0, min(1.0, -y))) - _SETTING
    if abs(beyond) < _SOFTLY:
        beyond = (beyond + _SOFTLY) ** 2 / (4.0 * _SOFTLY)
    return _SHARE * max(0.0, beyond)


def raised(arm: ArmRotations, skeleton: Skeleton, side: str) -> tuple[Quat, ArmRotations]:
    """Return the rotation of the girdle for an arm, and the arm on it, with its hand in the same pose.

    Args:
        arm: on a girdle at rest; its elbow only bends.
        skeleton: with both.
        side: "l" or "r".
    """
    limb = Arm.of(skeleton, side)
    elevation = girdle_elevation(rotate(arm.shoulder, limb.upper))
    if not elevation:
        return IDENTITY, arm
    girdle = from_axis_angle((0.0, 0.0, 1.0 if side == "l" else -1.0), elevation)
    back, clavicle = conjugate(girdle), skeleton.offset(f"{side}_shoulder")
    wrist = rotate(arm.shoulder, add(limb.upper, rotate(arm.elbow, limb.lower)))
    goal = rotate(back, add(wrist, subtract(clavicle, rotate(girdle, clavicle))))
    elbow = limb.flexed(goal)
    shoulder = multiply(back, arm.shoulder)
    reached = rotate(shoulder, add(limb.upper, rotate(elbow, limb.lower)))
    shoulder = multiply(between(unit(reached), unit(goal)), shoulder)
    hand = multiply(back, multiply(arm.shoulder, multiply(arm.elbow, arm.wrist)))
    return girdle, ArmRotations(shoulder, elbow, multiply(conjugate(multiply(shoulder, elbow)), hand))
