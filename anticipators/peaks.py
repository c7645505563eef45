"""Peaks of a signal."""

from math import exp
from typing import NamedTuple

from reactive_realizer.clock.units import GlobalTime, Time

_SLOW = 5.0
"""Time constant of the average, s: some movements long."""

_FIRST = 0.5
"""So long (s) the first sample counts for all that was before: it may be one of rest, or that of a peak."""


class _Sample(NamedTuple):
    value: float
    time: GlobalTime


class Peaks:
    """Finds where a signal is highest each time it rises well above its slow average.

    A peak is known for one when the signal has fallen halfway back; noise smaller than half of the rise makes none.

    Args:
        rise: how far above the average, in the unit of the signal.
    """

    def __init__(self, rise: float) -> None:
        self._rise = rise
        self._average = 0.0
        self._last: Time = None
        self._seen = 0.0
        self._top: _Sample | None = None

    def take(self, value: float, now: GlobalTime) -> Time:
        """Take a sample; when the peak was that it shows to be one."""
        self._follow(value, now)
        above = value - self._average
        if self._top is None:
            self._top = _Sample(value, now) if above > self._rise else None
        elif value > self._top.value:
            self._top = _Sample(value, now)
        elif above < self._rise / 2:
            peak, self._top = self._top, None
            return peak.time
        return None

    def _follow(self, value: float, now: GlobalTime) -> None:
        """The average is over what was seen: a stream that begins in a peak is understood as soon as any other."""
        if self._last is None:
            self._last, self._average = now, value
        passed = now - self._last
        self._seen += passed
        self._average += (value - self._average) * _weight(passed) / _weight(max(self._seen, _FIRST))
        self._last = now


def _weight(seconds: float) -> float:
    """Of the last seconds, in a slow average over all time."""
    return 1 - exp(-seconds / _SLOW)
