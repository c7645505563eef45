"""Expressivity: four numbers that say how a motion is made, and the laws by which they change it.

After A. Heloir and M. Kipp, "Real-time animation of interactive agents: specification and realization" (Applied
Artificial Intelligence 24, 2010), section 5, whose parameters come from B. Hartmann, M. Mancini and C. Pelachaud,
"Implementing expressive gesture synthesis for embodied conversational agents" (Gesture Workshop 2005).
"""

import math
from collections.abc import Mapping
from typing import Final, NamedTuple, Self

MOST: Final = 1.0
"""Each of the four numbers lies between this with a minus sign and this."""

_SIZE: Final = 0.5
"""By which share spatial extent enlarges a motion at most (the paper leaves its scale to the figure)."""

_DELAY: Final = 1.5
_BACK_SWING: Final = 0.1
_SPEED: Final = 0.2
_PAUSE: Final = 0.3  # s
_BEYOND: Final = 0.12
"""By which share of its way a powerful motion passes its end at most (ours; the paper leaves it to a spline)."""

_EARLY: Final = 2.0 / 3.0
"""The power of time that puts the peak of a bump at 0.35 of it (ours): a hand goes beyond an end at once."""

_LATE: Final = 3.0
"""The power of time that puts the peak of a bump at 0.79 of it (ours): just before a pose is reached."""

HURRIED: Final = 0.6
"""Share of its usual duration below which a movement looks hurried, and accelerates too much (ours)."""


class Expressivity(NamedTuple):
    """The size, duration, force and fluency of a motion, each from -1 to 1; a motion with 0 is unchanged.

    Attributes:
        spatial_extent: greater motions are larger.
        temporal_extent: greater motions are slower.
        power: greater motions swing back before a stroke, are quicker and straighter, and pass its end.
        fluidity: greater motions pause less.
    """

    spatial_extent: float = 0.0
    temporal_extent: float = 0.0
    power: float = 0.0
    fluidity: float = 0.0

    @classmethod
    def of(cls, parameters: Mapping[str, float]) -> Self:
        """The expressivity that parameters of a behavior ask for, by their names in BML; 0 for missing ones."""
        return cls(*(parameters.get(name, 0.0) for name in NAMES))

    @property
    def parameters(self) -> dict[str, float]:
        """The four numbers by their names in BML."""
        return dict(zip(NAMES, self, strict=True))

    @property
    def size(self) -> float:
        """Factor of all distances from the center of a motion."""
        return 1.0 + _SIZE * self.spatial_extent

    @property
    def speed(self) -> float:
        """Factor of the speed of a stroke."""
        return 1.0 + _SPEED * self.power

    @property
    def curvature(self) -> float:
        """Factor of the deviation of a path from a straight line, as of the tension of a Kochanek-Bartels spline."""
        return 1.0 - self.power

    @property
    def back_swing(self) -> float:
        """The length of the back-swing before a stroke, as a share of the length of the stroke."""
        return _BACK_SWING * max(0.0, self.power)

    @property
    def swing_hold(self) -> float:
        """The hold at the end of the back-swing, s."""
        return _PAUSE * max(0.0, self.power)

    @property
    def rest(self) -> float:
        """The pause that halting motion adds at a pose without one, s."""
        return self.pause(0.0)

    def movement(self, duration: float, shortest: float = 0.0, speed: float = 1.0) -> float:
        """The duration of a movement from one pose to the next, s: longer by 1.5 p ln(1 + d), but not hurried.

        Args:
            duration: d, without expressivity, s.
            shortest: that the body allows, s.
            speed: factor of its speed.
        """
        longer = duration + _DELAY * self.temporal_extent * math.log1p(duration)
        return max(shortest, HURRIED * duration, longer / speed)

    def pause(self, duration: float) -> float:
        """The duration of a pause, s: up to 0.3 s shorter or longer."""
        return max(0.0, duration - _PAUSE * self.fluidity)

    def beyond(self, share: float) -> float:
        """The overshoot of a powerful motion past the end of its stroke, as a share of the length of the stroke.

        Args:
            share: of the time in which it comes back, 0 to 1.
        """
        return _BEYOND * max(0.0, self.power) * _bump(share**_EARLY)

    def arriving(self, share: float) -> float:
        """The lead of a motion on its way to a pose, as a share of the way; with negative power, a lag.

        A powerful motion passes the pose shortly before it reaches it.

        Args:
            share: of the time of the way, 0 to 1.
        """
        return _BEYOND * self.power * _bump(share**_LATE)


NAMES: Final = ("spatialExtent", "temporalExtent", "power", "fluidity")
"""The names of the four parameters in BML."""

NEUTRAL: Final = Expressivity()
"""The expressivity that changes nothing."""


def _bump(share: float) -> float:
    """A bump of height 1 in the middle, whose value and speed are 0 at both ends."""
    left = share * (1.0 - share)
    return 64.0 * left * left * left
