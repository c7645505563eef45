"""Inverse kinematics of a limb of two bones, in closed form.

After D. Tolani, A. Goswami and N. I. Badler, "Real-time inverse kinematics techniques for anthropomorphic limbs"
(Graphical Models 62, 2000): the goal fixes the elbow to a circle about the line from shoulder to wrist, and the swivel
angle says where on it; likewise the knee.
"""

import math
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import ClassVar, NamedTuple, Self

from reactive_realizer.embodiment.quaternion import Quat, between, from_axis_angle, from_frames, rotate
from reactive_realizer.embodiment.skeleton import Skeleton
from reactive_realizer.embodiment.vector import FORWARD, Vec3, add, cross, dot, length, rejected, scale, unit

_DOWN: Vec3 = (0.0, -1.0, 0.0)
# An upper and a lower half that touch leave this angle between them, rad: about 150 degrees of flexion.
_FOLDED = math.radians(30.0)
_NEARLY_ZERO = 1e-9


class _Circle(NamedTuple):
    """Where the end of a limb may be while its middle turns about a hinge.

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
    def of(cls, axis: Vec3, upper: Vec3, lower: Vec3) -> Self:
        """That of two bones."""
        across, along = cross(axis, lower), rejected(lower, axis)
        p, q = dot(upper, along), dot(upper, across)
        fixed = dot(upper, upper) + dot(lower, lower) + 2.0 * dot(upper, axis) * dot(lower, axis)
        return cls(axis, fixed, math.hypot(p, q), math.atan2(q, p))

    def turn(self, far: float) -> float:
        """The angle at which the end is at a distance from the first joint, or as nearly as it can be, rad."""
        if self.swing < _NEARLY_ZERO:
            return self.begin
        cosine = (far * far - self.fixed) / (2.0 * self.swing)
        return self.begin + math.acos(max(-1.0, min(1.0, cosine)))


@dataclass(frozen=True)
class Limb:
    """An arm or a leg in the H-Anim default pose, hanging; in its middle, an elbow or a knee, it bends one way.

    What follows from its bones alone is found once.

    Attributes:
        upper: from its first joint to its middle, m.
        lower: from its middle to its end, m.
    """

    upper: Vec3
    lower: Vec3

    JOINTS: ClassVar[tuple[str, str, str]]
    """Where it begins, its middle and its end: H-Anim names without the side."""
    HINGE: ClassVar[Vec3]
    """Turning about it by the right hand bends the middle the way it bends."""
    AHEAD: ClassVar[Vec3]
    """A direction from the first joint to the end in which it is known where the middle goes without swivel ..."""
    SIDE: ClassVar[Vec3]
    """... namely this way."""
    SOFT_FROM: ClassVar[float]
    """Past this share of its length it is slowed down toward full extension, where it would otherwise snap."""

    @classmethod
    def of(cls, skeleton: Skeleton, side: str) -> Self:
        """The left ("l") or right ("r") one of a skeleton.

        Raises:
            KeyError: the skeleton lacks a joint of it.
        """
        _, middle, end = cls.JOINTS
        return cls._of_bones(skeleton.offset(f"{side}_{middle}"), skeleton.offset(f"{side}_{end}"))

    @classmethod
    @lru_cache
    def _of_bones(cls, upper: Vec3, lower: Vec3) -> Self:
        return cls(upper, lower)

    @cached_property
    def reach(self) -> float:
        """Goals up to this distance from the first joint (m) are reached, others as nearly as looks natural."""
        return self.SOFT_FROM * self._length

    def solve(self, goal: Vec3, swivel: float = 0.0) -> tuple[Quat, Quat]:
        """Rotations of the first and the middle joint that bring the end to a goal.

        Args:
            goal: from the first joint to the end, in the axes of the first joint's parent, m. One that is too far or
                too near is taken where its direction meets what can be reached.
            swivel: turn of the middle about the line to the goal, rad. At 0 an elbow is below a goal in front and
                behind a goal below, a knee in front of a goal below; positive turns by the left hand: an elbow toward
                the figure's right, a knee toward its left.

        Raises:
            ZeroDivisionError: a bone has no length.
        """
        far = length(goal)
        way = scale(goal, 1.0 / far) if far > _NEARLY_ZERO else self.AHEAD
        middle, end = self._bent(self._circle, self._reachable(far))
        straight = unit(end)
        # Across the limb and its hinge: where a bent middle points; defined for a straight one too.
        side = unit(rejected(cross(self.upper, self._circle.axis), straight))
        return from_frames(straight, side, way, self._middle_side(way, swivel)), middle

    def missed(self, goal: Vec3) -> float:
        """How far from a goal the end stays, m; both as `solve` has them."""
        far = length(goal)
        return abs(self._reachable(far) - far)

    @cached_property
    def _length(self) -> float:
        return length(self.upper) + length(self.lower)

    @cached_property
    def _folded(self) -> float:
        """From the first joint to the end of a folded limb, m."""
        upper, lower = length(self.upper), length(self.lower)
        return math.sqrt(upper * upper + lower * lower - 2.0 * upper * lower * math.cos(_FOLDED))

    @cached_property
    def _circle(self) -> "_Circle":
        return _Circle.of(unit(rejected(self.HINGE, unit(self.upper))), self.upper, self.lower)

    def _reachable(self, far: float) -> float:
        """The distance to take the end to: never quite the limb's length, never nearer than a folded limb."""
        soft = self.reach
        if far > soft:
            rest = self._length - soft
            far = soft + rest * (1.0 - math.exp((soft - far) / rest))
        return max(far, self._folded)

    def bent(self, axis: Vec3, far: float) -> tuple[Quat, Vec3]:
        """The middle's rotation about a hinge, and the end as seen from an unturned first joint, at a distance."""
        return self._bent(_Circle.of(axis, self.upper, self.lower), far)

    def _bent(self, circle: "_Circle", far: float) -> tuple[Quat, Vec3]:
        turn = from_axis_angle(circle.axis, circle.turn(far))
        return turn, add(self.upper, rotate(turn, self.lower))

    def _middle_side(self, way: Vec3, swivel: float) -> Vec3:
        """The unit vector across the way to the goal toward which the middle goes.

        Swivel 0 is where the smallest turn from AHEAD to the way takes SIDE (as in AsapRealizer, so that its files look
        alike); only straight opposite, where nobody reaches, is there no such turn.
        """
        side = rotate(between(self.AHEAD, way), self.SIDE)
        return rotate(from_axis_angle(way, -swivel), side)


class Arm(Limb):
    """From shoulder to wrist; an elbow flexes forward."""

    JOINTS = ("shoulder", "elbow", "wrist")
    HINGE = (-1.0, 0.0, 0.0)
    AHEAD, SIDE = FORWARD, _DOWN
    SOFT_FROM = 0.98


class Leg(Limb):
    """From hip to ankle; a knee flexes backward. Feet stand where they are to: it is slowed down only at the last."""

    JOINTS = ("hip", "knee", "ankle")
    HINGE = (1.0, 0.0, 0.0)
    AHEAD, SIDE = _DOWN, FORWARD
    SOFT_FROM = 0.998
