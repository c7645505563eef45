"""A motion in its place among others."""

from dataclasses import dataclass

from reactive_realizer.embodiment.pose import Layer
from reactive_realizer.engines.animation.easing import minimum_jerk, share
from reactive_realizer.engines.animation.motion_unit import Moment, MotionUnit, layer_of


@dataclass(frozen=True, slots=True, eq=False)
class Part:
    """A motion shifted to a start and stretched to an end, as SmartBody's TimeShiftWarp and Blend do (4.2.2).

    Attributes:
        motion: of its own phase 0 to 1.
        start: s of the whole.
        end: s of the whole, after the start.
        ease_in: s in which its weight comes, from the start.
        ease_out: s in which its weight goes, until the end.
    """

    motion: MotionUnit
    start: float
    end: float
    ease_in: float = 0.0
    ease_out: float = 0.0

    def plays(self, time: float) -> bool:
        """Whether it shows something at a time, s."""
        return self.start <= time <= self.end

    def time(self, sync: str) -> float:
        """When it reaches one of its own sync points, s.

        Raises:
            KeyError: it has no such point.
        """
        return self.start + self.motion.key_positions[sync] * (self.end - self.start)

    def layer(self, time: float, moment: Moment) -> Layer:
        """What it shows.

        Args:
            time: s of the whole.
            moment: of the whole.

        Raises:
            RealizerError: as `layer_of`.
        """
        return layer_of(self.motion, moment._replace(phase=share(time, self.start, self.end)))

    def weight(self, time: float) -> float:
        """How much of it is shown at a time, 0 to 1: SmartBody's blending curve."""
        come = minimum_jerk(share(time, self.start, self.start + self.ease_in))
        gone = minimum_jerk(share(time, self.end - self.ease_out, self.end)) if self.ease_out else 0.0
        return come * (1.0 - gone)
