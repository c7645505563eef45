"""Elbows do not bend backward, even where a curve through key poses would have them do so."""

import math

from reactive_realizer.embodiment.body import Skeleton
from reactive_realizer.embodiment.quaternion import Quat, from_axis_angle, multiply, rotate
from reactive_realizer.embodiment.two_bone_ik import Arm
from reactive_realizer.embodiment.vector import cross, dot


def flexion(side: str, elbow: Quat, skeleton: Skeleton) -> float:
    """Return how far an elbow is bent, rad: 0 if the arm is straight, negative if the elbow bends backward."""
    arm = Arm.of(skeleton, side)
    forearm = rotate(elbow, arm.lower)
    return math.atan2(dot(cross(arm.upper, forearm), Arm.HINGE), dot(arm.upper, forearm))


def kept_flexed(side: str, elbow: Quat, ends: tuple[Quat, Quat], skeleton: Skeleton) -> Quat:
    """Return the rotation of an elbow on a curve, bent forward.

    Where it would be straighter than at both ends of the curve, it approaches the straight arm ever less.

    Args:
        side: "l" or "r".
        elbow: its rotation.
        ends: its rotations at the ends.
        skeleton: of the figure.
    """
    bend, least = flexion(side, elbow, skeleton), min(flexion(side, end, skeleton) for end in ends)
    if bend >= least:
        return elbow
    softened = least * math.exp((bend - least) / least) if least > 0.0 else least
    return multiply(from_axis_angle(Arm.HINGE, softened - bend), elbow)
