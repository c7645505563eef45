"""Gesture space: places in proportion to the body, as D. McNeill divides it ("Hand and mind", 1992, 3.2)."""

import math
from functools import lru_cache
from typing import NamedTuple

from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.joints import EYES, HEAD
from reactive_realizer.embodiment.vector import Vec3, length


class _Proportions(NamedTuple):
    """The proportions of a figure, m.

    Attributes:
        shoulders: height above the pelvis.
        eyes: height above the pelvis.
        breadth: half the distance between the shoulders.
        arm: from shoulder to wrist.
    """

    shoulders: float
    eyes: float
    breadth: float
    arm: float


@lru_cache(64)
def _proportions(skeleton: Skeleton) -> _Proportions:
    body = Body(skeleton)
    pelvis = body.transform(skeleton.joints[0]).position
    left, right = (body.transform(f"{side}_shoulder").position for side in "lr")
    seeing = EYES if EYES[0] in skeleton else HEAD[1:]
    eyes = sum(body.transform(joint).position[1] for joint in seeing) / len(seeing)
    return _Proportions(
        0.5 * (left[1] + right[1]) - pelvis[1],
        eyes - pelvis[1],
        0.5 * (left[0] - right[0]),
        sum(length(skeleton.offset(f"l_{joint}")) for joint in ("elbow", "wrist")),
    )


def arm_length(skeleton: Skeleton) -> float:
    """Return the length of an arm from shoulder to wrist, m."""
    return _proportions(skeleton).arm


def gesture_place(height: float, angle: float, far: float, skeleton: Skeleton) -> Vec3:
    """Return a place in gesture space, from the pelvis, in the figure's axes, m.

    Places of one distance lie on a half ellipse about the body, which is as much broader than deep as the body is.

    Args:
        height: 0 at the pelvis, 1 at the shoulders, 2 at the eyes; evenly in between and beyond.
        angle: to the left, degrees.
        far: distance straight ahead, in lengths of the arm.
        skeleton: of the figure.
    """
    body = _proportions(skeleton)
    up = body.shoulders * min(height, 1.0) + (body.eyes - body.shoulders) * max(height - 1.0, 0.0)
    turn, deep = math.radians(angle), far * body.arm
    broad = deep + body.breadth
    distance = deep * broad / math.hypot(broad * math.cos(turn), deep * math.sin(turn)) if deep > 0.0 else 0.0
    return (distance * math.sin(turn), up, distance * math.cos(turn))


def arm_place(outward: float, up: float, ahead: float, side: str, skeleton: Skeleton) -> Vec3:
    """Return a place of a hand as Greta states it, from the pelvis, in the figure's axes, m.

    Args:
        outward: from the middle of the body to the side of the hand, in lengths of the arm.
        up: from the elbow of the hanging arm, in the same lengths.
        ahead: from the shoulder, in the same lengths.
        side: "l" or "r".
        skeleton: of the figure.
    """
    body = Body(skeleton)
    pelvis, shoulder, elbow = (
        body.transform(joint).position for joint in (skeleton.joints[0], f"{side}_shoulder", f"{side}_elbow")
    )
    arm = arm_length(skeleton)
    return (
        (arm if side == "l" else -arm) * outward,
        elbow[1] - pelvis[1] + arm * up,
        shoulder[2] - pelvis[2] + arm * ahead,
    )
