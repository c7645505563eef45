"""Joints follow what moves slowly; what jumps they go to as people do."""

from collections.abc import Mapping

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.quaternion import Quat, angle, difference
from reactive_realizer.engines.animation.easing import minimum_jerk, share
from reactive_realizer.engines.animation.inertia import faded

_DURATION = 0.5
"""s, as long as a gaze takes to turn there at first."""

_FOLLOWED = 2.0
"""rad/s; a joint whose goal turns faster has a new goal."""

_GAP = 0.1
"""s; of two goals further apart nobody saw the one when the other was shown."""


class Settling:
    """Takes the jumps out of goals: what a jump leaves between shown and wanted fades (`faded`)."""

    def __init__(self) -> None:
        self._time = GlobalTime(0.0)
        self._since = GlobalTime(-_DURATION)
        self._left: dict[str, Quat] = {}
        self._goal: Mapping[str, Quat] = {}
        self._shown: Mapping[str, Quat] = {}

    def leave(self, shown: Mapping[str, Quat], now: GlobalTime) -> None:
        """Whatever the goal of the next frame is, the joints come to it from how they are shown at a time."""
        self._time, self._goal, self._shown = now, shown, shown

    def __call__(self, goal: Mapping[str, Quat], now: GlobalTime) -> Mapping[str, Quat]:
        """What to show of a goal, joint -> rotation, in the frame of a time."""
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
        rest = 1.0 - minimum_jerk(share(now, self._since, self._since + _DURATION))
        if rest == 0.0 or not self._left:
            return goal
        return faded(goal, self._left, rest)
