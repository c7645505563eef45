"""How far a forearm turns about its length and a hand deviates, and arms that keep within that.

Forearms of people turn by about 85 degrees each way from the neutral position, thumb forward while the arm hangs; hands
deviate by about 25 degrees to the side of the thumb and 35 to that of the little finger (D. Boone and S. Azen, "Normal
range of motion of joints in male subjects", Journal of Bone and Joint Surgery 61-A, 1979). What the forearm cannot, the
upper arm does: the elbow swivels about the line from shoulder to wrist.
"""

import math
from functools import lru_cache
from typing import NamedTuple

from reactive_realizer.embodiment.body import Skeleton
from reactive_realizer.embodiment.quaternion import (
    Quat,
    conjugate,
    from_axis_angle,
    from_rotation_vector,
    multiply,
    power,
    rotate,
    rotation_vector,
    twist,
)
from reactive_realizer.embodiment.vector import Vec3, add, dot, unit


class _Range(NamedTuple):
    """A range that is approached softly: a hard limit would stop a joint within a frame.

    Attributes:
        free: values up to this one stay as they are, rad.
        most: limit of all others, rad.
    """

    free: float
    most: float

    @classmethod
    def degrees(cls, free: float, most: float) -> "_Range":
        """Return a range in degrees."""
        return cls(math.radians(free), math.radians(most))

    def within(self, value: float) -> float:
        """Return a value without a sign within the range."""
        left = self.most - self.free
        return value if value <= self.free else self.most - left * math.exp((self.free - value) / left)


_PRONATION = _Range.degrees(62.0, 80.0)
_RADIAL = _Range.degrees(15.0, 22.0)
_ULNAR = _Range.degrees(24.0, 32.0)
_SWIVEL = _Range.degrees(40.0, 70.0)
"""Forearm and hand keep a few degrees for what is added to gestures."""

_NEARLY_ZERO = 1e-6

_STEPS = 2
"""Steps of the solution for the swivel."""

_DAMPING = 0.1
"""Of this solution; a gain of 1 stands for a forearm in line with the way from shoulder to wrist."""


class ArmTurns(NamedTuple):
    """How a forearm and its hand are turned, rad.

    Attributes:
        pronation: of the forearm; negative if it is supinated.
        deviation: of the hand to the side of the thumb; negative to the other side.
    """

    pronation: float
    deviation: float


class ArmRotations(NamedTuple):
    """The rotations of the joints of an arm, local to their parents."""

    shoulder: Quat
    elbow: Quat
    wrist: Quat


class ArmAnatomy(NamedTuple):
    """The arm of a skeleton that hangs in the default pose, the thumb forward.

    Attributes:
        upper: from shoulder to elbow, m.
        lower: from elbow to wrist, m.
        inward: 1 for the left arm, -1 for the right one.
    """

    upper: Vec3
    lower: Vec3
    inward: float

    @classmethod
    @lru_cache
    def of(cls, skeleton: Skeleton, side: str) -> "ArmAnatomy":
        """Return the left ("l") or right ("r") arm of a skeleton."""
        return cls(skeleton.offset(f"{side}_elbow"), skeleton.offset(f"{side}_wrist"), 1.0 if side == "l" else -1.0)

    def turns(self, elbow: Quat, wrist: Quat) -> ArmTurns:
        """Return how forearm and hand are turned. Both joints share the turn of the forearm, as radius and ulna do."""
        along = unit(self.lower)
        about = sum(dot(rotation_vector(twist(turn, along)), along) for turn in (elbow, wrist))
        across, _, _ = rotation_vector(multiply(conjugate(twist(wrist, along)), wrist))
        return ArmTurns(self.inward * about, -across)

    def fitted(self, arm: ArmRotations) -> ArmRotations:
        """Return an arm with its wrist in the same place and its hand turned the same way, as far as it can.

        The forearm makes half of the turn between elbow and hand: with all of it in the wrist, the skin would collapse
        there.

        Args:
            arm: whose elbow only bends.
        """
        along = unit(self.lower)
        about = _about(arm.wrist, along)
        excess = about - _within(about, _PRONATION, _PRONATION)
        if excess:
            arm = self._swiveled(arm, excess, along)
        wrist = _hand(arm.wrist, along)
        half = power(twist(wrist, along), 0.5)
        return ArmRotations(arm.shoulder, multiply(arm.elbow, half), multiply(conjugate(half), wrist))

    def _swiveled(self, arm: ArmRotations, excess: float, along: Vec3) -> ArmRotations:
        """Return the arm after a swivel of the elbow that turns the forearm, but not the hand.

        The swivel is a damped least-squares solution (Y. Nakamura and H. Hanafusa 1986), so it stays small and
        continuous where it hardly turns the forearm, as with a fully bent elbow.

        Args:
            arm: to turn.
            excess: by which the forearm should turn less in relation to the hand, rad.
            along: direction of the forearm in its own axes.
        """
        way = unit(add(self.upper, rotate(arm.elbow, self.lower)))
        seen = rotate(conjugate(arm.elbow), way)
        goal = _about(arm.wrist, along) - excess
        swivel = 0.0
        for _ in range(_STEPS):
            turned = multiply(from_axis_angle(seen, -swivel), arm.wrist)
            gain = _gain(turned, seen, along)
            swivel += gain * (_about(turned, along) - goal) / (gain * gain + _DAMPING)
        swivel = _within(swivel, _SWIVEL, _SWIVEL)
        return ArmRotations(
            multiply(arm.shoulder, from_axis_angle(way, swivel)),
            arm.elbow,
            multiply(from_axis_angle(seen, -swivel), arm.wrist),
        )


def _hand(wrist: Quat, along: Vec3) -> Quat:
    """Return the rotation of a hand within its limits."""
    turned = twist(wrist, along)
    about = dot(rotation_vector(turned), along)
    swing = multiply(conjugate(turned), wrist)
    across, y, z = rotation_vector(swing)
    less = _within(across, _ULNAR, _RADIAL)
    if less != across:
        swing = from_rotation_vector((less, y, z))
    return multiply(from_axis_angle(along, _within(about, _PRONATION, _PRONATION)), swing)


def _gain(wrist: Quat, axis: Vec3, along: Vec3) -> float:
    """Return by how much a twist shrinks for each radian of a turn of the forearm about an axis."""
    turned = multiply((0.0, *axis), wrist)
    (w, part), (w1, part1) = ((q[0], dot((q[1], q[2], q[3]), along)) for q in (wrist, turned))
    return (w * part1 - part * w1) / max(w * w + part * part, _NEARLY_ZERO)


def _about(wrist: Quat, along: Vec3) -> float:
    return dot(rotation_vector(twist(wrist, along)), along)


def _within(value: float, positive: _Range, negative: _Range) -> float:
    return positive.within(value) if value >= 0.0 else -negative.within(-value)
