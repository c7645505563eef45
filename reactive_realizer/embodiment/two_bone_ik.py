"""Closed-form inverse kinematics of a limb with two bones.

After D. Tolani, A. Goswami and N. I. Badler, "Real-time inverse kinematics techniques for anthropomorphic limbs"
(Graphical Models 62, 2000): the goal restricts the elbow to a circle about the line from shoulder to wrist, and the
swivel angle selects a point on it. The knee is solved the same way.
"""

import math
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import ClassVar, NamedTuple, Self

from reactive_realizer.embodiment.body import Skeleton
from reactive_realizer.embodiment.quaternion import Quat, between, from_axis_angle, from_frames, rotate
from reactive_realizer.embodiment.vector import FORWARD, Vec3, add, cross, dot, length, rejected, scale, unit

_DOWN: Vec3 = (0.0, -1.0, 0.0)
# The angle between upper and lower half of a fully flexed limb, rad: about 150 degrees of flexion.
_FOLDED = math.radians(30.0)
_NEARLY_ZERO = 1e-9

_MOST_CIRCLES = 256
"""Number of cached circles: knees bend about the same ones for as long as a posture lasts."""


class _Circle(NamedTuple):
    """The circle on which the end of a limb moves while its middle joint turns about a hinge.

    |upper + lower turned by a|^2 is fixed + 2 (p cos a + q sin a) = fixed + 2 r cos(a - a0).

    Attributes:
        axis: of the hinge, a unit vector.
        fixed: m^2.
        swing: r, m^2.
        begin: a0, rad.
    """

    axis: Vec3
    fixed: float
    swing: float
    begin: float

    @classmethod
    @lru_cache(_MOST_CIRCLES)
    def of(cls, axis: Vec3, upper: Vec3, lower: Vec3) -> Self:
        """Return the circle of two bones."""
        across, along = cross(axis, lower), rejected(lower, axis)
        p, q = dot(upper, along), dot(upper, across)
        fixed = dot(upper, upper) + dot(lower, lower) + 2.0 * dot(upper, axis) * dot(lower, axis)
        return cls(axis, fixed, math.hypot(p, q), math.atan2(q, p))

    def turn(self, far: float) -> float:
        """Return the angle that brings the end to a distance from the first joint, or as near as possible, rad."""
        if self.swing < _NEARLY_ZERO:
            return self.begin
        cosine = (far * far - self.fixed) / (2.0 * self.swing)
        return self.begin + math.acos(max(-1.0, min(1.0, cosine)))


@dataclass(frozen=True)
class Limb:
    """An arm or a leg that hangs in the H-Anim default pose; its middle joint, elbow or knee, bends one way.

    Values that depend on the bones alone are cached.

    Attributes:
        upper: from the first joint to the middle joint, m.
        lower: from the middle joint to the end, m.
    """

    upper: Vec3
    lower: Vec3

    JOINTS: ClassVar[tuple[str, str, str]]
    """First joint, middle joint and end: H-Anim names without the side."""
    HINGE: ClassVar[Vec3]
    """The right-handed turn about this axis bends the middle joint."""
    AHEAD: ClassVar[Vec3]
    """A direction from the first joint to the end, for which `SIDE` is the middle joint's direction at swivel 0."""
    SIDE: ClassVar[Vec3]
    """The direction of the middle joint at swivel 0, if the limb points along `AHEAD`."""
    SOFT_FROM: ClassVar[float]
    """From this share of its length on, the limb approaches full extension softly; otherwise it would snap."""

    @classmethod
    def of(cls, skeleton: Skeleton, side: str) -> Self:
        """Return the left ("l") or right ("r") limb of a skeleton.

        Raises:
            KeyError: the skeleton lacks one of its joints.
        """
        _, middle, end = cls.JOINTS
        return cls._of_bones(skeleton.offset(f"{side}_{middle}"), skeleton.offset(f"{side}_{end}"))

    @classmethod
    @lru_cache
    def _of_bones(cls, upper: Vec3, lower: Vec3) -> Self:
        return cls(upper, lower)

    @cached_property
    def reach(self) -> float:
        """Distance from the first joint up to which goals are reached exactly, m.

        Goals further away are reached only as nearly as looks natural.
        """
        return self.SOFT_FROM * self._length

    def solve(self, goal: Vec3, swivel: float = 0.0) -> tuple[Quat, Quat]:
        """Return the rotations of the first and the middle joint that bring the end to a goal.

        Args:
            goal: from the first joint to the end, in the axes of the first joint's parent, m. A goal that is too far or
                too near is moved along its direction until it can be reached.
            swivel: turn of the middle joint about the line to the goal, rad. At 0, an elbow is below a goal in front
                and behind a goal below; a knee is in front of a goal below. Positive turns are left-handed: an elbow
                turns toward the figure's right, a knee toward its left.

        Raises:
            ZeroDivisionError: a bone has no length.
        """
        far = length(goal)
        way = scale(goal, 1.0 / far) if far > _NEARLY_ZERO else self.AHEAD
        middle, end = self._bent(self._circle, self._reachable(far))
        straight = unit(end)
        # Perpendicular to limb and hinge: the direction of a bent middle joint, defined for a straight limb too.
        side = unit(rejected(self._across, straight))
        return from_frames(straight, side, way, self._middle_side(way, swivel)), middle

    def flexed(self, goal: Vec3) -> Quat:
        """Return the rotation of the middle joint alone, as `solve` does: it only depends on how far the goal is."""
        middle, _ = self._bent(self._circle, self._reachable(length(goal)))
        return middle

    def missed(self, goal: Vec3) -> float:
        """Return the distance at which the end stays from a goal, m, as `solve` places it."""
        far = length(goal)
        return abs(self._reachable(far) - far)

    @cached_property
    def _across(self) -> Vec3:
        """A vector perpendicular to the first bone and the hinge."""
        return cross(self.upper, self._circle.axis)

    @cached_property
    def _length(self) -> float:
        return length(self.upper) + length(self.lower)

    @cached_property
    def _folded(self) -> float:
        """Distance from the first joint to the end of a fully flexed limb, m."""
        upper, lower = length(self.upper), length(self.lower)
        return math.sqrt(upper * upper + lower * lower - 2.0 * upper * lower * math.cos(_FOLDED))

    @cached_property
    def _circle(self) -> "_Circle":
        return _Circle.of(unit(rejected(self.HINGE, unit(self.upper))), self.upper, self.lower)

    def _reachable(self, far: float) -> float:
        """Return the distance to which the end is brought: within the lengths of the straight and the folded limb."""
        soft = self.reach
        if far > soft:
            rest = self._length - soft
            far = soft + rest * (1.0 - math.exp((soft - far) / rest))
        return max(far, self._folded)

    def bent(self, axis: Vec3, far: float) -> tuple[Quat, Vec3]:
        """Return the rotation of the middle joint about a hinge that brings the end to a distance, and the end.

        The end is relative to an unturned first joint.
        """
        return self._bent(_Circle.of(axis, self.upper, self.lower), far)

    def _bent(self, circle: "_Circle", far: float) -> tuple[Quat, Vec3]:
        turn = from_axis_angle(circle.axis, circle.turn(far))
        return turn, add(self.upper, rotate(turn, self.lower))

    def _middle_side(self, way: Vec3, swivel: float) -> Vec3:
        """Return the unit vector, perpendicular to the line to the goal, toward which the middle joint goes.

        At swivel 0 it is SIDE after the smallest turn from AHEAD to the goal, as in AsapRealizer, so that its files
        look alike. That turn is undefined only straight opposite, where no limb reaches.
        """
        side = rotate(between(self.AHEAD, way), self.SIDE)
        return rotate(from_axis_angle(way, -swivel), side) if swivel else side


class Arm(Limb):
    """From shoulder to wrist; the elbow flexes forward."""

    JOINTS = ("shoulder", "elbow", "wrist")
    HINGE = (-1.0, 0.0, 0.0)
    AHEAD, SIDE = FORWARD, _DOWN
    SOFT_FROM = 0.98


class Leg(Limb):
    """From hip to ankle; the knee flexes backward. It softens only near full extension: feet should stay in place."""

    JOINTS = ("hip", "knee", "ankle")
    HINGE = (1.0, 0.0, 0.0)
    AHEAD, SIDE = _DOWN, FORWARD
    SOFT_FROM = 0.998
