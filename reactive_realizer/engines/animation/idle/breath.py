"""Air that goes in and out."""

from random import Random

from reactive_realizer.engines.animation.easing import share, smoothstep
from reactive_realizer.engines.animation.idle.episodes import Episodes

_LASTS = (3.4, 4.8)
"""s, the shortest breath and the longest: 12.5 to 17.6 a minute."""

_DEPTH = (0.7, 1.2)
"""The shallowest and the deepest."""

_IN = 0.42
"""Air goes in for this share of a breath."""


class Breath:
    """Breaths of a person at rest, no two of which are alike.

    From breath to breath depth varies more than time: M. J. Tobin and others, "Variability of resting respiratory drive
    and timing in healthy subjects" (Journal of Applied Physiology 65, 1988). How many there are, how much of each is
    breathing in and how much they vary is our choice, within what people do.
    """

    def __init__(self, random: Random) -> None:
        """Draws from a generator that nobody else draws from."""
        self._random = random
        self._last = self._breath()
        self._episodes = Episodes(self._last, self._draw)
        self._begun = random.uniform(0.0, _LASTS[0])

    def air(self, time: float) -> float:
        """How full the lungs are at a time, s: 0 when air has gone out, about 1 when it has come in."""
        passed = time + self._begun
        (since, (lasts, depth)), _ = self._episodes.at(passed)
        done = (passed - since) / lasts
        return depth * smoothstep(share(done, 0.0, _IN) if done < _IN else share(1.0 - done, 0.0, 1.0 - _IN))

    def _draw(self) -> tuple[float, tuple[float, float]]:
        lasts, _ = self._last
        self._last = self._breath()
        return lasts, self._last

    def _breath(self) -> tuple[float, float]:
        return self._random.uniform(*_LASTS), self._random.uniform(*_DEPTH)
