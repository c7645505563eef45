"""Inertialization: motion plays in full from the start, and its offset from the pose shown before decays.

D. Bollo, "Inertialization: high-performance animation transitions in Gears of War" (GDC 2018): no two motions are
blended; only the offset decays to 0.
"""

from collections.abc import Mapping

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import Quat, angle, difference, multiply, power
from reactive_realizer.embodiment.vector import ZERO, Vec3, add, scale, subtract
from reactive_realizer.engines.animation.easing import minimum_jerk, share
from reactive_realizer.engines.animation.motion_unit import MotionPose


def inertialized(goal: Mapping[str, Quat], offsets: Mapping[str, Quat], left: float) -> dict[str, Quat]:
    """Return a goal pose with the remaining offsets.

    Args:
        goal: joint -> rotation local to the parent.
        offsets: joint -> turn from the goal to the pose shown, at the time of the jump.
        left: remaining share of the offsets, 0 to 1.
    """
    return {
        joint: multiply(turn, power(offsets[joint], left)) if joint in offsets else turn for joint, turn in goal.items()
    }


_START_DURATION, _LARGEST_SHARE = 0.3, 0.25
"""Time in which the offset at the start decays, s, and its limit as a share of the motion."""

_LATE = 0.05
"""A motion that is first sampled later than this joins late, s."""


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
        self._over, self._late = min(_LARGEST_SHARE, _START_DURATION / duration), _LATE / duration
        self._entered: float | None = None
        self._turns: Mapping[str, Quat] = {}
        self._way = ZERO

    def __call__(self, posed: MotionPose, phase: float) -> MotionPose:
        """Return the pose to show at a phase. The first call determines whether the motion joins late."""
        if self._entered is None:
            late = phase > self._late
            self._entered = phase if late else 0.0
            self._begin(posed if late else self._first)
        left = 1.0 - minimum_jerk(share(phase, self._entered, self._entered + self._over))
        if left == 0.0:
            return posed
        return posed._replace(
            rotations=inertialized(posed.rotations, self._turns, left), root=self._moved(posed.root, left)
        )

    def _begin(self, first: MotionPose) -> None:
        goals = first.rotations.items()
        self._turns = {joint: difference(goal, self._body.rotation(joint)) for joint, goal in goals}
        self._way = ZERO if first.root is None else subtract(self._body.root, first.root)

    def _moved(self, root: Vec3 | None, left: float) -> Vec3 | None:
        return None if root is None else add(root, scale(self._way, left))


_JUMP_DURATION = 0.5
"""Time in which the offset of a jump decays, s: as long as a gaze takes to turn."""

_FOLLOWED = 2.0
"""A joint whose goal turns faster than this has jumped to a new goal, rad/s."""

_GAP = 0.1
"""Goals further apart in time than this are unrelated, s."""


class InertializedGoal:
    """Inertializes jumps of a goal pose, such as that of a gaze; slower changes are followed."""

    def __init__(self) -> None:
        self._time = GlobalTime(0.0)
        self._since = GlobalTime(-_JUMP_DURATION)
        self._left: dict[str, Quat] = {}
        self._goal: Mapping[str, Quat] = {}
        self._shown: Mapping[str, Quat] = {}

    def leave(self, shown: Mapping[str, Quat], now: GlobalTime) -> None:
        """Treat the next goal as a jump from the pose shown at a time."""
        self._time, self._goal, self._shown = now, shown, shown

    def __call__(self, goal: Mapping[str, Quat], now: GlobalTime) -> Mapping[str, Quat]:
        """Return the pose to show for a goal in a frame, joint -> rotation."""
        passed = now - self._time
        if not 0.0 <= passed <= _GAP:
            self._left = {}
        elif self._jumps(goal, passed):
            self._since = self._time
            self._left = {joint: difference(turn, self._shown.get(joint, turn)) for joint, turn in goal.items()}
        self._time, self._goal = now, goal
        self._shown = self._settled(goal, now)
        return self._shown

    def _jumps(self, goal: Mapping[str, Quat], passed: float) -> bool:
        if goal == self._goal:
            return False
        ways = (angle(difference(self._goal.get(joint, turn), turn)) for joint, turn in goal.items())
        return max(ways, default=0.0) > _FOLLOWED * passed

    def _settled(self, goal: Mapping[str, Quat], now: GlobalTime) -> Mapping[str, Quat]:
        rest = 1.0 - minimum_jerk(share(now, self._since, self._since + _JUMP_DURATION))
        if rest == 0.0 or not self._left:
            return goal
        return inertialized(goal, self._left, rest)


_CHANGE_DURATION = 0.3
"""Time in which the offset of a parameter that jumps decays, s: a change takes about as long as a movement."""


class InertializedChange:
    """Inertializes jumps of the parameters of a motion; the motion itself, and slower changes, are followed.

    The motion says by which poses it jumped: those of the old and of the new parameters at the same time. A fast motion
    is therefore never taken for a jump.
    """

    def __init__(self) -> None:
        self._last = self._since = GlobalTime(-_CHANGE_DURATION)
        self._left: Mapping[str, Quat] = {}

    def change(self, before: Mapping[str, Quat], after: Mapping[str, Quat], now: GlobalTime) -> None:
        """Take note of a change of parameters.

        Args:
            before: joint -> rotation now, with the old parameters.
            after: the same, with the new ones.
            now: s.
        """
        ways = {joint: difference(turn, before[joint]) for joint, turn in after.items() if joint in before}
        if max(map(angle, ways.values()), default=0.0) > _FOLLOWED * (now - self._last):
            shown = self._offset(before, now)
            self._since = now
            self._left = {joint: difference(turn, shown.get(joint, turn)) for joint, turn in after.items()}

    def __call__(self, goal: Mapping[str, Quat], now: GlobalTime) -> Mapping[str, Quat]:
        """Return the pose to show in a frame, joint -> rotation."""
        self._last = now
        return self._offset(goal, now)

    def _offset(self, goal: Mapping[str, Quat], now: GlobalTime) -> Mapping[str, Quat]:
        rest = 1.0 - minimum_jerk(share(now, self._since, self._since + _CHANGE_DURATION))
        return inertialized(goal, self._left, rest) if rest > 0.0 and self._left else goal
