"""The way back to rest of a motion that was cut: the engine's own, it blocks nothing."""

from dataclasses import dataclass, replace

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.pose import Layer
from reactive_realizer.engines.animation.easing import minimum_jerk, share

DURATION = 0.6
"""s; at this pace a hand that is let go at shoulder height stays below 2 m/s."""


@dataclass(frozen=True, slots=True)
class Release:
    """A layer that leaves."""

    layer: Layer
    since: GlobalTime

    def over(self, now: GlobalTime) -> bool:
        """Whether nothing of it is left."""
        return now >= self.since + DURATION

    def at(self, now: GlobalTime) -> Layer:
        """What is left of it."""
        gone = minimum_jerk(share(now, self.since, self.since + DURATION))
        return replace(self.layer, weight=self.layer.weight * (1.0 - gone), priority=-1)
