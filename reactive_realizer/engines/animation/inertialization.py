"""Inertialization of legs and root at the start of a motion (`embodiment.inertialization` has that of other joints).

Only the offset from the pose shown before decays, before the feet are planted.
"""

from collections.abc import Mapping

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.inertialization import remaining
from reactive_realizer.embodiment.joints import LOWER_BODY
from reactive_realizer.embodiment.quaternion import Quat, difference, multiply, power
from reactive_realizer.embodiment.vector import ZERO, Vec3, add, scale, subtract
from reactive_realizer.engines.animation.easing import share
from reactive_realizer.engines.animation.motion_unit import MotionPose

_START_DURATION, _LARGEST_SHARE = 0.3, 0.25
"""Time in which the offset at the start decays, s, and its limit as a share of the motion."""

_LATE = 0.05
"""A motion that is first sampled later than this joins late, s."""


def start_duration(duration: float) -> float:
    """Return the time in which the offset at the start of a motion of some duration decays, s."""
    return min(_START_DURATION, _LARGEST_SHARE * duration)


class InertializedStart:
    """Inertializes the start of a motion that begins with a fixed pose instead of the current one.

    The motion plays in full, without a jump. A motion to which a transition led has no offset and keeps its speed.
    """

    def __init__(self, body: Body, first: MotionPose, duration: float) -> None:
        """Start.

        Args:
            body: at the start of the motion.
            first: pose of the motion at its start.
            duration: preferred duration of the motion, s.
        """
        self._body, self._first = body, first
        self._over, self._late = start_duration(duration) / duration, _LATE / duration
        self._entered: float | None = None
        self._turns: Mapping[str, Quat] = {}
        self._way = ZERO

    def __call__(self, posed: MotionPose, phase: float) -> MotionPose:
        """Return the pose to show at a phase. The first call determines whether the motion joins late."""
        if self._entered is None:
            late = phase > self._late
            self._entered = phase if late else 0.0
            self._begin(posed if late else self._first)
        left = remaining(share(phase, self._entered, self._entered + self._over))
        if left == 0.0 or (not self._turns and posed.root is None):
            return posed
        turned = {joint: multiply(posed.rotations[joint], power(turn, left)) for joint, turn in self._turns.items()}
        return posed._replace(rotations={**posed.rotations, **turned}, root=self._moved(posed.root, left))

    def _begin(self, first: MotionPose) -> None:
        goals = ((joint, goal) for joint, goal in first.rotations.items() if joint in LOWER_BODY)
        self._turns = {joint: difference(goal, self._body.rotation(joint)) for joint, goal in goals}
        self._way = ZERO if first.root is None else subtract(self._body.root, first.root)

    def _moved(self, root: Vec3 | None, left: float) -> Vec3 | None:
        return None if root is None else add(root, scale(self._way, left))
