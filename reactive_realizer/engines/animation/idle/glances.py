"""Small saccades of eyes that look at nothing in particular."""

import math
from random import Random

from reactive_realizer.engines.animation.easing import minimum_jerk
from reactive_realizer.engines.animation.idle.episodes import Episodes

Direction = tuple[float, float]
"""Yaw to the figure's left and pitch up, rad, from straight ahead."""

# S. P. Lee, J. B. Badler and N. I. Badler, "Eyes Alive" (SIGGRAPH 2002), of a person who listens. An amplitude is
# -6.9 ln(P / 15.7) degrees, P even from 0 to 15.7; frames are of 1/30 s.
_SPREAD = math.radians(6.9)
_DIRECTIONS = {0: 15.54, 45: 6.46, 90: 17.69, 135: 7.44, 180: 16.80, 225: 7.89, 270: 20.38, 315: 7.79}
_AHEAD = (237.5 / 30.0, 47.1 / 30.0)
_ASIDE = (13.0 / 30.0, 7.1 / 30.0)

_FURTHEST = math.radians(5.0)
"""Further aside the head would follow; that is for gaze behaviors."""

_SHORTEST = 0.15
"""s, of a fixation."""

_SACCADE = (0.025, 0.0024 / math.radians(1.0))
"""Duration: s, and s a rad (the same paper)."""


class Glances:
    """Looks aside for a moment every eight seconds or so, and back."""

    def __init__(self, random: Random) -> None:
        """Draws from a generator that nobody else draws from."""
        self._random = random
        self._aside = True
        self._episodes: Episodes[Direction] = Episodes((0.0, 0.0), self._draw)

    def _draw(self) -> tuple[float, Direction]:
        self._aside = not self._aside
        if self._aside:
            return max(_SHORTEST, self._random.gauss(*_ASIDE)), (0.0, 0.0)
        nearest = math.exp(-_FURTHEST / _SPREAD)
        amplitude = -_SPREAD * math.log(self._random.uniform(nearest, 1.0))
        (degrees,) = self._random.choices(tuple(_DIRECTIONS), tuple(_DIRECTIONS.values()))
        angle = math.radians(degrees)
        return max(_SHORTEST, self._random.gauss(*_AHEAD)), (amplitude * math.cos(angle), amplitude * math.sin(angle))

    def at(self, time: float) -> Direction:
        """Where the eyes look."""
        now, before = self._episodes.at(time)
        (x, y), (to_x, to_y) = before.what, now.what
        fixed, more = _SACCADE
        done = minimum_jerk((time - now.since) / (fixed + more * math.hypot(to_x - x, to_y - y)))
        return x + (to_x - x) * done, y + (to_y - y) * done
