"""Inverse kinematics of a limb of two bones, in closed form.

After D. Tolani, A. Goswami and N. I. Badler, "Real-time inverse kinematics techniques for anthropomorphic limbs"
(Graphical Models 62, 2000): the goal fixes the elbow to a circle about the line from shoulder to wrist, and the swivel
angle says where on it.
"""

import math
from dataclasses import dataclass

from reactive_realizer.embodiment.quaternion import Quat, between, from_axis_angle, from_frames, rotate
from reactive_realizer.embodiment.skeleton import Skeleton
from reactive_realizer.embodiment.vector import FORWARD, Vec3, add, cross, dot, length, rejected, scale, unit

_DOWN: Vec3 = (0.0, -1.0, 0.0)
# Turning about it by the right hand takes a hanging forearm forward.
_HINGE: Vec3 = (-1.0, 0.0, 0.0)
# Past this share of its length an arm is slowed down toward full extension, where an elbow would otherwise snap.
_SOFT_FROM = 0.98
# An upper arm and a forearm that touch leave this angle between them, rad: about 150 degrees of flexion.
_FOLDED = math.radians(30.0)
_NEARLY_ZERO = 1e-9


@dataclass(frozen=True, slots=True)
class Arm:
    """One arm in the H-Anim default pose: hanging, its elbow flexing forward.

    Attributes:
        upper: from the shoulder to the elbow, m.
        lower: from the elbow to the wrist, m.
    """

    upper: Vec3
    lower: Vec3

    @classmethod
    def of(cls, skeleton: Skeleton, side: str) -> "Arm":
        """The left ("l") or right ("r") arm of a skeleton."""
        return cls(skeleton.offset(f"{side}_elbow"), skeleton.offset(f"{side}_wrist"))

    @property
    def reach(self) -> float:
        """Goals up to this distance from the shoulder (m) are reached exactly, others as nearly as looks natural."""
        return _SOFT_FROM * (length(self.upper) + length(self.lower))

    def solve(self, goal: Vec3, swivel: float = 0.0) -> tuple[Quat, Quat]:
        """Rotations of shoulder and elbow that bring the wrist to a goal.

        Args:
            goal: from the shoulder to the wrist, in the axes of the shoulder's parent, m. One that is too far or too
                near is taken where its direction meets what can be reached.
            swivel: turn of the elbow about the line to the goal, rad. At 0 the elbow is below a goal in front and
                behind a goal below; positive turns the elbow toward the figure's right.
        """
        far = length(goal)
        way = scale(goal, 1.0 / far) if far > _NEARLY_ZERO else FORWARD
        axis = unit(rejected(_HINGE, unit(self.upper)))
        elbow, wrist = self._bent(axis, self._reachable(far))
        straight = unit(wrist)
        # Behind the arm, across its hinge: where a bent elbow points; defined for a straight one too.
        side = unit(rejected(cross(self.upper, axis), straight))
        return from_frames(straight, side, way, _elbow_side(way, swivel)), elbow

    def _reachable(self, far: float) -> float:
        """The distance to take the wrist to: never quite the arm's length, never nearer than a folded arm."""
        upper, lower = length(self.upper), length(self.lower)
        folded = math.sqrt(upper * upper + lower * lower - 2.0 * upper * lower * math.cos(_FOLDED))
        soft = self.reach
        if far > soft:
            rest = upper + lower - soft
            far = soft + rest * (1.0 - math.exp((soft - far) / rest))
        return max(far, folded)

    def _bent(self, axis: Vec3, far: float) -> tuple[Quat, Vec3]:
        """The elbow's rotation about its hinge, and the wrist as seen from an unturned shoulder, at a distance."""
        upper, lower = self.upper, self.lower
        across, along = cross(axis, lower), rejected(lower, axis)
        # |upper + lower turned by a|^2 is constant + 2 (p cos a + q sin a) = constant + 2 r cos(a - a0).
        p, q = dot(upper, along), dot(upper, across)
        fixed = dot(upper, upper) + dot(lower, lower) + 2.0 * dot(upper, axis) * dot(lower, axis)
        cosine = (far * far - fixed) / (2.0 * math.hypot(p, q))
        turn = from_axis_angle(axis, math.atan2(q, p) + math.acos(max(-1.0, min(1.0, cosine))))
        return turn, add(upper, rotate(turn, lower))


def _elbow_side(way: Vec3, swivel: float) -> Vec3:
    """The unit vector across the way to the goal toward which the elbow goes.

    Swivel 0 is where the smallest turn from forward to the way takes "down" (as in AsapRealizer, so that its files
    look alike); only straight backward, where nobody gestures, is there no such turn.
    """
    down = rotate(between(FORWARD, way), _DOWN)
    return rotate(from_axis_angle(way, -swivel), down)
