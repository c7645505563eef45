"""Key frames of MURML that are added to other motion (``applymode="superpose"``)."""

from bisect import bisect_right
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, slerp
from reactive_realizer.engines.animation.easing import minimum_jerk, share
from reactive_realizer.engines.animation.motion_unit import Moment, MotionPose, MotionUnit, with_gesture_points
from reactive_realizer.engines.animation.shortest import Profile

_RISE = 0.2
"""Time in which a motion that begins with its first frame gets its weight, s."""


class TurnFrame(NamedTuple):
    """Turns of joints at a time.

    Attributes:
        time: after the start of the motion, s.
        turns: joint -> the turn to be added; other joints have none.
    """

    time: float
    turns: Mapping[str, Quat]


class SuperposedFrames(MotionUnit):
    """Adds turns to what joints do otherwise: from none through the frames, and back to none.

    Args:
        frames: one or more, in the order of time.
        profile: of the way from one frame to the next.
        fade_out: duration of the way back, s.
        fixed: names of the parameters that were read when it was made.
    """

    kind = LayerKind.ADDITIVE

    def __init__(self, frames: Sequence[TurnFrame], profile: Profile, fade_out: float, fixed: frozenset[str]) -> None:
        self.fixed = fixed
        self.parameters = {}
        self.joints = frozenset[str]().union(*(frame.turns for frame in frames))
        self.preferred_duration = frames[-1].time + fade_out
        none = [TurnFrame(0.0, {})] if frames[0].time > 0.0 else []
        self._frames = (*none, *frames, TurnFrame(self.preferred_duration, {}))
        self._times = [frame.time for frame in self._frames]
        self._profile = profile
        self._rise = 0.0 if none else min(_RISE, fade_out)
        ready, relax = (frame.time / self.preferred_duration for frame in (frames[0], frames[-1]))
        self.key_positions = with_gesture_points({"ready": ready, "relax": relax})

    def start(self, body: Body) -> None:
        """Start; the pose of the body has no effect."""

    def pose(self, moment: Moment) -> MotionPose:
        """Return the turns at a moment."""
        time = moment.phase * self.preferred_duration
        after = min(bisect_right(self._times, time), len(self._times) - 1)
        left, right = self._frames[after - 1], self._frames[after]
        profile = minimum_jerk if right is self._frames[-1] else self._profile
        done = profile(share(time, left.time, right.time))
        turns = {
            joint: slerp(left.turns.get(joint, IDENTITY), right.turns.get(joint, IDENTITY), done)
            for joint in self.joints
        }
        return MotionPose(turns, weight=minimum_jerk(share(time, 0.0, self._rise)) if self._rise else 1.0)
