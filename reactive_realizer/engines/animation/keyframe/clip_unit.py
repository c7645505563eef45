"""A clip in a plan."""

from reactive_realizer.clock.units import RESOLUTION, GlobalTime
from reactive_realizer.engines.animation.animation_unit import AnimationUnit
from reactive_realizer.engines.animation.keyframe.keyframe_motion_unit import KeyframeMotionUnit
from reactive_realizer.planunit.plan_unit import SyncPoint


class ClipUnit(AnimationUnit):
    """A clip between pegs: it may well be left where its author says so."""

    def gentle_end(self, time: GlobalTime) -> GlobalTime:
        """The next point at which it may be left; without one it is broken off."""
        times = (point.time for point in self._exits())
        return min((GlobalTime(at) for at in times if at is not None and at >= time), default=time)

    def subsiding(self, time: GlobalTime) -> bool:
        """Just at such a point a successor may take over, too."""
        leaving = any(point.fired is not None and abs(point.fired - time) <= RESOLUTION for point in self._exits())
        return leaving or super().subsiding(time)

    def _exits(self) -> list[SyncPoint]:
        exits = self.motion.exits if isinstance(self.motion, KeyframeMotionUnit) else ()
        return [point for point in self.points if point.id in exits]
