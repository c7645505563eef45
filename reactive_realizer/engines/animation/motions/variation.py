"""Repetitions that differ: people do not make a stroke twice in the same way, nor the same stroke with both hands.

Variations come from the seed of a character, so that a session is repeatable. All sizes are ours but that of the delay.
"""

import math
from collections import deque
from random import Random
from typing import NamedTuple

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engines.animation.easing import share

_SMALLER = 0.08
"""By which share a stroke is smaller than authored at most. None is larger: it may touch something."""

_WAVES = (0.6, 1.6)
"""Fewest and most waves in which the size varies during a motion."""

_SHIFT = 0.03
"""By which share of a phase its middle comes earlier or later at most."""

_DELAY = (0.030, 0.060)
"""Shortest and longest delay of the other hand, s.

P. Stucchi and P. Viviani, "Cerebral dominance and asynchrony between bimanual two-dimensional movements" (Journal of
Experimental Psychology: Human Perception and Performance 19, 1993), measured about 25 ms for drawing.
"""


class Variation(NamedTuple):
    """Describes how one performance of a motion differs from the authored one. Its sync points stay where they are.

    Attributes:
        waves: in which its size varies.
        begin: of these waves, as a share of one.
        shift: by which share of a phase its middle comes later.
        delay: of the other hand, s.
    """

    waves: float
    begin: float
    shift: float
    delay: float

    @classmethod
    def drawn(cls, random: Random) -> "Variation":
        """Return another variation each time."""
        return cls(random.uniform(*_WAVES), random.random(), random.uniform(-_SHIFT, _SHIFT), random.uniform(*_DELAY))

    def size(self, phase: float) -> float:
        """Return the size at a phase of the motion, relative to the authored one."""
        return 1.0 - 0.5 * _SMALLER * (1.0 + math.sin(2.0 * math.pi * (self.waves * phase + self.begin)))

    def shifted(self, progress: float) -> float:
        """Return the progress between two sync points, 0 to 1, for an even one; its speed is the same at both ends."""
        left = progress * (1.0 - progress)
        return progress + 16.0 * self.shift * left * left


class TrailingPhase:
    """The phase in which a motion was a moment ago."""

    def __init__(self, delay: float) -> None:
        """Trail by some time, s."""
        self._delay = delay
        self._frames: deque[tuple[GlobalTime, float]] = deque()

    def __call__(self, phase: float, now: GlobalTime) -> float:
        """Return the phase before, for the phase of a frame; at first, the one of the first frame."""
        frames, then = self._frames, now - self._delay
        frames.append((now, phase))
        while len(frames) > 1 and frames[1][0] <= then:
            frames.popleft()
        (since, before), (until, after) = frames[0], frames[min(1, len(frames) - 1)]
        return before + (after - before) * share(then, since, until)
