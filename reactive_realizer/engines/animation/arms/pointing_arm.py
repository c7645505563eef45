"""How an arm points: the index finger's line goes through the target.

The upper arm goes as straight toward the target as is natural, and forearm and hand from there at it like one stick:
the two-bone solution of `two_bone_ik` turns shoulder and elbow so. What is left, for the finger does not grow from the
middle of the wrist, is a small turn of the wrist that is solved exactly.
"""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

from reactive_realizer.embodiment.body import Body
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
from reactive_realizer.embodiment.skeleton import Skeleton
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
from reactive_realizer.engines.animation.arms.pointing_fingers import pointing_fingers

_DOWN: Vec3 = (0.0, -1.0, 0.0)
# Toward a far target the elbow stays bent by this, rad: a locked one looks like a signpost, and two bones near their
# full length are not solved exactly.
_LEAST_BEND = math.radians(25.0)
# The upper arm goes no further away from a near target than this, rad.
_MOST_BEND = math.radians(115.0)
# How exactly the bend for a near target is found: to a hundredth of a degree.
_HALVINGS = 13
# Short of the angle at which a forearm touches the upper arm.
_MOST_FLEXION = math.radians(149.0)
# Elbows hang, and a little outward.
_SWIVEL = math.radians(30.0)
# In front of the chest the upper arm crosses no further than this, rad from straight ahead; the forearm does the rest.
_CROSSING = math.radians(45.0)
# What an arm can point at lies within a cone about a direction, seen from its shoulder: azimuth rad outward from ahead,
# elevation rad, half the opening rad. It opens to just behind straight across, to 30 degrees behind straight outward.
_AZIMUTH, _ELEVATION, _OPENING = math.radians(12.5), math.radians(-10.0), math.radians(107.0)
# The palm looks down and inward: about half of what a forearm can turn from thumb up.
_PRONATION = math.radians(45.0)
# The fingertip lies further out than the last joint, by this share of the last bone's length, and keeps its distance.
_TIP, _CLEARANCE = 1.0, 0.02
_NEEDED = ("shoulder", "elbow", "wrist", "index1", "index2", "index3")
_TOO_NEAR, _BEHIND = "it is too near", "it is behind the arm"


class ArmPose(NamedTuple):
    """How an arm points.

    Attributes:
        rotations: of the arm and its fingers, local to their parents.
        fault: why the finger's line misses the target, None where it does not.
    """

    rotations: dict[str, Quat]
    fault: str | None


@dataclass(frozen=True)
class PointingArm:
    """One arm of a skeleton, for pointing.

    Attributes:
        skeleton: its proportions.
        side: "l" or "r".
    """

    skeleton: Skeleton
    side: str

    @property
    def hand(self) -> str:
        """For people."""
        return {"l": "left", "r": "right"}[self.side]

    @property
    def missing(self) -> list[str]:
        """The joints that the skeleton lacks, without which an arm cannot point; nothing else may be asked for then."""
        return [joint for name in _NEEDED if (joint := self._joint(name)) not in self.skeleton]

    @cached_property
    def joints(self) -> frozenset[str]:
        """The joints that it turns."""
        return frozenset((*map(self._joint, _NEEDED[:3]), *self._fingers))

    def aim(self, body: Body, target: Vec3) -> ArmPose:
        """Points at a target, or as nearly as is natural.

        Args:
            body: where its trunk is.
            target: in the figure's frame, m.
        """
        above = body.place(body.skeleton.chain(self._joint("shoulder"))[-2]).rotation
        way = rotate(conjugate(above), subtract(target, body.place(self._joint("shoulder")).position))
        goal, fault = self._reachable(way)
        upper_arm = self._upper_arm(goal)
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
        """The sign of x on this arm's side of the figure, which faces +z."""
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
        """The direction of the stretched index finger in the axes of the hand: as the forearm goes."""
        return unit(self._arm.lower)

    @cached_property
    def _stick(self) -> float:
        """From the elbow to where the target may be nearest, m."""
        bones = [length(self.skeleton.offset(self._joint(f"index{i}"))) for i in (2, 3)]
        hand = dot(self._knuckle, self._along) + sum(bones) + _TIP * bones[-1]
        return length(self._arm.lower) + hand + _CLEARANCE

    def _reachable(self, way: Vec3) -> tuple[Vec3, str | None]:
        """The way from the shoulder to a target, in the axes of the shoulder's parent, as far as an arm can point."""
        far, upper = length(way), length(self._arm.upper)
        direction = scale(way, 1.0 / far) if far > 0.0 else FORWARD
        # Of the triangle of upper arm, stick and way with the greatest bend, or as great as a short stick allows.
        along = upper * math.cos(_MOST_BEND)
        nearest = along + math.sqrt(max(0.0, along * along + self._stick * self._stick - upper * upper))
        fault = _TOO_NEAR if far < nearest else None
        ahead = rotate(from_euler(-_ELEVATION, self._outward * _AZIMUTH, 0.0), FORWARD)
        turn = between(ahead, direction)
        if angle(turn) > _OPENING:
            direction, fault = rotate(power(turn, _OPENING / angle(turn)), ahead), _BEHIND
        return scale(direction, max(far, nearest)), fault

    def _upper_arm(self, goal: Vec3) -> Vec3:
        """From the shoulder to the elbow, m: as straight toward the goal as leaves room for forearm and hand."""
        low, high = _LEAST_BEND, _MOST_BEND
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
        """Where the elbow is if the upper arm is turned away from the goal by an angle, beside the chest."""
        way = unit(goal)
        side = rotate(from_axis_angle(way, self._outward * _SWIVEL), _hanging(way))
        upper_arm = add(scale(way, math.cos(bend)), scale(side, math.sin(bend)))
        inward = (-self._outward * math.cos(_CROSSING), 0.0, -math.sin(_CROSSING))
        if dot(upper_arm, inward) > 0.0:
            upper_arm = unit(rejected(upper_arm, inward))
        return scale(upper_arm, length(self._arm.upper))

    def _cramped(self, upper_arm: Vec3, forearm: Vec3) -> bool:
        """Whether the fingertip does not fit between elbow and target, or the elbow does not bend so far."""
        # What halving leaves over is nothing to see.
        return length(forearm) < self._stick - 1e-3 or dot(unit(upper_arm), unit(forearm)) < math.cos(_MOST_FLEXION)

    def _pronation(self, axis: Vec3) -> Quat:
        """Half of the turn of the palm: forearm and wrist share it, so that the skin of neither is wrung."""
        return from_axis_angle(unit(axis), 0.5 * self._outward * -_PRONATION)

    def _hand(self, forearm: Quat, way: Vec3) -> Quat:
        """The wrist's rotation with which the line of the index finger goes through the target.

        Args:
            forearm: its rotation, in the axes of the shoulder's parent.
            way: from the wrist to the target in these axes, m.
        """
        base, along = self._knuckle, self._along
        # The point of the finger's line that is as far from the wrist as the target: |base + t along| = |way|.
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
    """The side of a direction where `Arm.solve` has the elbow at swivel 0."""
    return rotate(between(FORWARD, way), _DOWN)


def _swivel(way: Vec3, elbow: Vec3) -> float:
    """The swivel with which `Arm.solve` has the elbow of a wrist in a direction at its place, rad."""
    zero = _hanging(way)
    side = rejected(elbow, way)
    return math.atan2(dot(cross(side, zero), way), dot(side, zero))
