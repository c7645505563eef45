"""Spontaneous blinks, and those with large turns of gaze."""

import math
from random import Random

from reactive_realizer.engines.animation.easing import share, smoothstep
from reactive_realizer.engines.animation.idle_movements import Episodes

USUAL_RATE = 17.0
"""Blinks per minute of a person at rest; 26 in conversation, 4.5 while reading.

A. R. Bentivoglio and others, "Analysis of blink rate patterns in normal subjects" (Movement Disorders 12, 1997).
"""

_CLOSING = 0.085
_OPENING = 0.15
"""Durations of the phases of a blink, s. Closing is faster than opening by 40 to 47 %.

C. Sforza and others, "Spontaneous blinking in healthy persons: an optoelectronic study of eyelid motion" (Ophthalmic
and Physiological Optics 28, 2008).
"""

_SPREAD = 0.65
"""Standard deviation of the logarithm of the time between blinks, our choice: their coefficient of variation is 0.7."""

_PARTIAL = 0.2
"""Share of the blinks at random intervals that close the lids only in part (ours)."""

_DEPTH = (0.45, 0.8)
"""How far those close at least and at most."""

_SHORTEST = 0.5
"""Shortest time from one blink to the next, s."""

_LONGEST = 4.0
"""Longest time, relative to the mean (ours): one much longer gap would dominate the intervals of some minutes."""


class Blinks:
    """Blinks at random intervals, and one with each large turn of gaze.

    Most intervals are short and a few are long, as in most people (E. Ponder and W. P. Kennedy, "On the act of
    blinking", Quarterly Journal of Experimental Physiology 18, 1927): their logarithms are distributed normally.
    """

    def __init__(self, random: Random, per_minute: float) -> None:
        """Draw from a generator that must not be shared.

        Args:
            random: the generator.
            per_minute: rate of the blinks at random intervals, above 0.
        """
        mean = 60.0 / per_minute
        self._episodes = Episodes(1.0, lambda: (_drawn_interval(random, mean), _drawn_depth(random)))
        self._requested = -math.inf

    def request_blink(self, time: float) -> None:
        """Blink at a time as well, s. People do so with large turns of gaze.

        C. Evinger and others, "Not looking while leaping: the linkage of blinking and saccadic gaze shifts"
        (Experimental Brain Research 100, 1994).
        """
        if time - self._requested >= _CLOSING + _OPENING:
            self._requested = time

    def closed(self, time: float, advanced: float, pace: float) -> float:
        """Return how far the lids are closed, 0 to 1.

        Args:
            time: s.
            advanced: how far the random intervals have advanced, s; the time itself at their own rate.
            pace: at which they advance now, relative to their own rate.
        """
        now, _ = self._episodes.at(advanced)
        # The first episode starts with open eyes. However often they come, blinks take their time.
        own = now.what * _shut((advanced - now.since) / pace) if now.since > 0.0 and pace > 0.0 else 0.0
        return max(own, _shut(time - self._requested))


def _drawn_interval(random: Random, mean: float) -> float:
    middle = math.log(mean) - 0.5 * _SPREAD * _SPREAD
    return max(_SHORTEST, min(_LONGEST * mean, random.lognormvariate(middle, _SPREAD)))


def _drawn_depth(random: Random) -> float:
    return random.uniform(*_DEPTH) if random.random() < _PARTIAL else 1.0


def _shut(passed: float) -> float:
    if passed < _CLOSING:
        return smoothstep(share(passed, 0.0, _CLOSING))
    return smoothstep(1.0 - share(passed, _CLOSING, _CLOSING + _OPENING))
