"""How an expression leaves the mouth to words, and takes it back."""

from reactive_realizer.clock.units import GlobalTime

WHILE_SPEAKING = 0.5
"""Share of an expression's mouth that is shown while words need the mouth."""

_YIELDING = 0.15
"""s, from all of the mouth to that share, or back."""


class MouthShare:
    """The share of its mouth that an expression shows: all of it, or what speech leaves."""

    def __init__(self) -> None:
        self._share = 1.0
        self._time = GlobalTime(0.0)

    def at(self, now: GlobalTime, speaking: bool) -> float:
        """The share now, 0 to 1; on its way since the last call to where it should be."""
        furthest = (1.0 - WHILE_SPEAKING) * (now - self._time) / _YIELDING
        way = (WHILE_SPEAKING if speaking else 1.0) - self._share
        self._share += max(-furthest, min(furthest, way))
        self._time = now
        return self._share
