"""Inverse kinematics of a pointing arm: the line of the index finger goes through the target.

The upper arm turns toward the target as far as is natural; forearm and hand point at it from there like one stick. The
two-bone solution of `two_bone_ik` turns shoulder and elbow. Because the finger does not start at the middle of the
wrist, a small turn of the wrist remains, which is solved exactly.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.quaternion import (
    Quat,
    angle,
    between,
    conjugate,
    from_axis_angle,
    from_euler,
    multiply,
    power,
    rotate,
)
from reactive_realizer.embodiment.two_bone_ik import Arm
from reactive_realizer.embodiment.vector import (
    FORWARD,
    Vec3,
    add,
    cross,
    distance,
    dot,
    length,
    rejected,
    scale,
    subtract,
    unit,
)

# Bend of each joint of a finger, rad; the joint nearest to the palm first.
_CURLED = {"middle": (1.25, 1.55, 0.9), "ring": (1.3, 1.6, 0.9), "pinky": (1.35, 1.6, 0.9)}
# The same for the thumb: down along the hand, and inward over the fingers.
_THUMB = ((0.35, 0.6), (0.3, 0.5), (0.0, 0.6))


def pointing_fingers(skeleton: Skeleton, side: str, along: Vec3) -> dict[str, Quat]:
    """Return rotations of the fingers of a pointing hand, local to their parents, for joints that the skeleton has.

    The index finger is stretched, the other fingers lie in the palm, and the thumb lies over them.

    Args:
        skeleton: with the three joints of the index finger, apart from each other.
        side: "l" or "r".
        along: direction of the index finger, a unit vector in the axes of the hand.
    """
    rotations = (*_index(skeleton, side, along), *_others(side))
    return {joint: rotation for joint, rotation in rotations if joint in skeleton}


def _index(skeleton: Skeleton, side: str, along: Vec3) -> Iterator[tuple[str, Quat]]:
    proximal, middle = (unit(skeleton.offset(f"{side}_index{i}")) for i in (2, 3))
    straight = between(middle, proximal)
    yield f"{side}_index1", between(proximal, along)
    yield f"{side}_index2", straight
    # The last bone has no joint at its end; a resting finger is bent equally at both outer joints.
    yield f"{side}_index3", straight


def _others(side: str) -> Iterator[tuple[str, Quat]]:
    inward = -1.0 if side == "l" else 1.0
    for finger, bends in _CURLED.items():
        for i, bend in enumerate(bends, 1):
            yield f"{side}_{finger}{i}", from_euler(0.0, 0.0, inward * bend)
    for i, (down, across) in enumerate(_THUMB, 1):
        yield f"{side}_thumb{i}", from_euler(down, inward * across, 0.0)


_DOWN: Vec3 = (0.0, -1.0, 0.0)
# Bend of the elbow toward a far target, rad: a locked elbow looks stiff, and limbs near full extension are not solved
# exactly.
_LEAST_BEND = math.radians(25.0)
# How much less it is with the greatest spatial extent, and how much more with the smallest, rad.
_STRETCHED, _BENT = math.radians(13.0), math.radians(45.0)
# Limit of the angle between the upper arm and a near target, rad.
_MOST_BEND = math.radians(115.0)
# Bisection steps for the bend toward a near target: precise to a hundredth of a degree.
_HALVINGS = 13
# Just below the angle at which the forearm touches the upper arm.
_MOST_FLEXION = math.radians(149.0)
# Elbows hang slightly outward.
_SWIVEL = math.radians(30.0)
# Limit of the upper arm across the chest, rad from straight ahead; the forearm does the rest.
_CROSSING = math.radians(45.0)
# An arm can point at targets within a cone, seen from its shoulder: azimuth outward from ahead, elevation, and half the
# opening, rad. The cone reaches just behind straight across, and 30 degrees behind straight outward.
_AZIMUTH, _ELEVATION, _OPENING = math.radians(12.5), math.radians(-10.0), math.radians(107.0)
# The palm faces down and inward: about half of the range of the forearm from thumb up.
_PRONATION = math.radians(45.0)
# Distance of the fingertip from the last joint, as a share of the last bone, and its clearance from the target, m.
_TIP, _CLEARANCE = 1.0, 0.02
_NEEDED = ("shoulder", "elbow", "wrist", "index1", "index2", "index3")
_TOO_NEAR, _BEHIND = "it is too near", "it is behind the arm"


class ArmPose(NamedTuple):
    """The pose of a pointing arm.

    Attributes:
        rotations: of the arm and its fingers, local to their parents.
        fault: why the finger's line misses the target, None if it does not.
    """

    rotations: dict[str, Quat]
    fault: str | None


def hand_of(side: str) -> str:
    """Return the name of the hand of a side, "l" or "r", for messages."""
    return {"l": "left", "r": "right"}[side]


@dataclass(frozen=True)
class PointingArm:
    """An arm of a skeleton, for pointing.

    Attributes:
        skeleton: with the proportions of the figure.
        side: "l" or "r".
    """

    skeleton: Skeleton
    side: str

    @property
    def hand(self) -> str:
        """Name of the hand, for messages."""
        return hand_of(self.side)

    @property
    def missing(self) -> list[str]:
        """Joints needed for pointing that the skeleton lacks; if there are any, other members must not be used."""
        return [joint for name in _NEEDED if (joint := self._joint(name)) not in self.skeleton]

    @cached_property
    def joints(self) -> frozenset[str]:
        """The joints that pointing turns."""
        return frozenset((*map(self._joint, _NEEDED[:3]), *self._fingers))

    def aim(self, body: Body, target: Vec3, extent: float = 0.0) -> ArmPose:
        """Point at a target, or as nearly as is natural.

        Args:
            body: with the current trunk.
            target: in the figure's frame, m.
            extent: how far the arm stretches: -1 keeps the hand near, 1 reaches out.
        """
        above = body.transform(body.skeleton.chain(self._joint("shoulder"))[-2]).rotation
        way = rotate(conjugate(above), subtract(target, body.transform(self._joint("shoulder")).position))
        goal, fault = self._reachable(way)
        upper_arm = self._upper_arm(goal, extent)
        forearm = subtract(goal, upper_arm)
        if fault is None and self._cramped(upper_arm, forearm):
            fault = _TOO_NEAR
        wrist = add(upper_arm, scale(unit(forearm), length(self._arm.lower)))
        shoulder, elbow = self._arm.solve(wrist, _swivel(unit(wrist), upper_arm))
        elbow = multiply(elbow, self._pronation(self._arm.lower))
        hand = self._hand(multiply(shoulder, elbow), subtract(goal, wrist))
        arm = {"shoulder": shoulder, "elbow": elbow, "wrist": hand}
        return ArmPose({self._joint(name): turn for name, turn in arm.items()} | self._fingers, fault)

    def _joint(self, name: str) -> str:
        return f"{self.side}_{name}"

    @cached_property
    def _outward(self) -> float:
        """Sign of x on this arm's side of the figure, which faces +z."""
        return 1.0 if self.side == "l" else -1.0

    @cached_property
    def _arm(self) -> Arm:
        return Arm.of(self.skeleton, self.side)

    @cached_property
    def _knuckle(self) -> Vec3:
        """From the wrist to the base of the index finger, m."""
        return self.skeleton.offset(self._joint("index1"))

    @cached_property
    def _along(self) -> Vec3:
        """Direction of the stretched index finger in the axes of the hand: that of the forearm."""
        return unit(self._arm.lower)

    @cached_property
    def _stick(self) -> float:
        """Smallest distance from the elbow to a target, m."""
        bones = [length(self.skeleton.offset(self._joint(f"index{i}"))) for i in (2, 3)]
        hand = dot(self._knuckle, self._along) + sum(bones) + _TIP * bones[-1]
        return length(self._arm.lower) + hand + _CLEARANCE

    def _reachable(self, way: Vec3) -> tuple[Vec3, str | None]:
        """Return a point that the arm can point at, at or near a target, and a fault if it is not the target.

        Args:
            way: from the shoulder to the target, in the axes of the shoulder's parent, m; the result is relative to it
                too.
        """
        far, upper = length(way), length(self._arm.upper)
        direction = scale(way, 1.0 / far) if far > 0.0 else FORWARD
        # From the triangle of upper arm, stick and target with the greatest bend that the stick allows.
        along = upper * math.cos(_MOST_BEND)
        nearest = along + math.sqrt(max(0.0, along * along + self._stick * self._stick - upper * upper))
        fault = _TOO_NEAR if far < nearest else None
        ahead = rotate(from_euler(-_ELEVATION, self._outward * _AZIMUTH, 0.0), FORWARD)
        turn = between(ahead, direction)
        if angle(turn) > _OPENING:
            direction, fault = rotate(power(turn, _OPENING / angle(turn)), ahead), _BEHIND
        return scale(direction, max(far, nearest)), fault

    def _upper_arm(self, goal: Vec3, extent: float) -> Vec3:
        """Return the vector from shoulder to elbow, m: as straight toward the goal as extent and forearm allow."""
        low, high = _LEAST_BEND - extent * (_STRETCHED if extent > 0.0 else _BENT), _MOST_BEND
        elbow = self._elbow(goal, low)
        if distance(elbow, goal) >= self._stick:
            return elbow
        for _ in range(_HALVINGS):
            middle = 0.5 * (low + high)
            if distance(self._elbow(goal, middle), goal) < self._stick:
                low = middle
            else:
                high = middle
        return self._elbow(goal, high)

    def _elbow(self, goal: Vec3, bend: float) -> Vec3:
        """Return the elbow if the upper arm is turned away from the goal by an angle, beside the chest."""
        way = unit(goal)
        side = rotate(from_axis_angle(way, self._outward * _SWIVEL), _hanging(way))
        upper_arm = add(scale(way, math.cos(bend)), scale(side, math.sin(bend)))
        inward = (-self._outward * math.cos(_CROSSING), 0.0, -math.sin(_CROSSING))
        if dot(upper_arm, inward) > 0.0:
            upper_arm = unit(rejected(upper_arm, inward))
        return scale(upper_arm, length(self._arm.upper))

    def _cramped(self, upper_arm: Vec3, forearm: Vec3) -> bool:
        """Return whether the fingertip does not fit between elbow and target, or the elbow does not bend far enough."""
        # The tolerance covers the precision of the bisection.
        return length(forearm) < self._stick - 1e-3 or dot(unit(upper_arm), unit(forearm)) < math.cos(_MOST_FLEXION)

    def _pronation(self, axis: Vec3) -> Quat:
        """Return half of the turn of the palm.

        Forearm and wrist share it, so that the skin of neither is twisted too far.
        """
        return from_axis_angle(unit(axis), 0.5 * self._outward * -_PRONATION)

    def _hand(self, forearm: Quat, way: Vec3) -> Quat:
        """Return the wrist rotation for which the line of the index finger goes through the target.

        Args:
            forearm: its rotation, in the axes of the shoulder's parent.
            way: from the wrist to the target in these axes, m.
        """
        base, along = self._knuckle, self._along
        # The point on the finger's line at the target's distance from the wrist: |base + t along| = |way|.
        half = dot(base, along)
        far = max(length(way), length(base))
        t = -half + math.sqrt(half * half + far * far - dot(base, base))
        point = unit(add(base, scale(along, t)))
        swing = between(point, rotate(conjugate(forearm), unit(way)))
        return multiply(swing, self._pronation(point))

    @cached_property
    def _fingers(self) -> dict[str, Quat]:
        return pointing_fingers(self.skeleton, self.side, self._along)


def _hanging(way: Vec3) -> Vec3:
    """Return the side of a direction on which `Arm.solve` has the elbow at swivel 0."""
    return rotate(between(FORWARD, way), _DOWN)


def _swivel(way: Vec3, elbow: Vec3) -> float:
    """Return the swivel, rad, with which `Arm.solve` puts the elbow in place, for the direction of the wrist."""
    zero = _hanging(way)
    side = rejected(elbow, way)
    return math.atan2(dot(cross(side, zero), way), dot(side, zero))
