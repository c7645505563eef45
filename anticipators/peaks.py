"""Finds the peaks of a signal."""

from math import exp
from typing import NamedTuple

from reactive_realizer.clock.units import GlobalTime, Time

_SLOW = 5.0
"""Time constant of the average, s: the duration of several movements."""

_FIRST = 0.5
"""Weight of the first sample in the average, as a time (s): it may be taken at rest or at a peak."""


class _Sample(NamedTuple):
    value: float
    time: GlobalTime


class Peaks:
    """Finds the maximum of a signal each time it rises well above its slow average.

    A peak is recognized when the signal has fallen halfway back; noise of less than half of the rise has no effect.

    Args:
        rise: height of a peak above the average, in the unit of the signal.
    """

    def __init__(self, rise: float) -> None:
        self._rise = rise
        self._average = 0.0
        self._last: Time = None
        self._seen = 0.0
        self._top: _Sample | None = None

    def take(self, value: float, now: GlobalTime) -> Time:
        """Take a sample; the time of the peak that it confirms, if it does."""
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
        """Update the average, which counts only observed time, so that a signal may begin with a peak."""
        if self._last is None:
            self._last, self._average = now, value
        passed = now - self._last
        self._seen += passed
        self._average += (value - self._average) * _weight(passed) / _weight(max(self._seen, _FIRST))
        self._last = now


def _weight(seconds: float) -> float:
    """The weight of the last seconds in a slow average over all time."""
    return 1 - exp(-seconds / _SLOW)
