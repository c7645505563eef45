"""Smooth curves through given points that do not overshoot between them."""

from bisect import bisect_right
from collections.abc import Sequence
from itertools import pairwise

_HALVINGS = 50
"""Steps in which the time of a value is found, to the resolution of floating-point numbers."""
_ROUNDING = 1e-9


class MonotoneCurve:
    """A curve of cubic polynomials through points, with a continuous slope.

    Between two points it goes in one direction only. The slope at a point is a weighted harmonic mean of those of the
    chords on its sides, 0 where these have different signs (F. N. Fritsch and J. Butland, "A method for constructing
    local monotone piecewise cubic interpolants", SIAM Journal on Scientific and Statistical Computing 5, 1984); at the
    ends it is that of the chord.
    """

    def __init__(self, points: Sequence[tuple[float, float]]) -> None:
        """Put a curve through points.

        Args:
            points: time and value; two or more, with increasing times.
        """
        self._times = [time for time, _ in points]
        self._values = [value for _, value in points]
        steps = [later - earlier for earlier, later in pairwise(self._times)]
        chords = [(b - a) / step for (a, b), step in zip(pairwise(self._values), steps, strict=True)]
        inner = (_slope(*around) for around in zip(chords, chords[1:], steps, steps[1:], strict=False))
        self._slopes = [chords[0], *inner, chords[-1]]

    @property
    def duration(self) -> float:
        """The time of the last point."""
        return self._times[-1]

    def __call__(self, time: float) -> float:
        """Return the value at a time; before the first point and after the last one, it is that of the point."""
        if time <= self._times[0]:
            return self._values[0]
        if time >= self._times[-1]:
            return self._values[-1]
        return self._between(bisect_right(self._times, time) - 1, time)

    def first_time(self, value: float) -> float:
        """Return the first time at which the curve has a value.

        Raises:
            ValueError: it never has it.
        """
        for number, (a, b) in enumerate(pairwise(self._values)):
            if min(a, b) - _ROUNDING <= value <= max(a, b) + _ROUNDING:
                low, high = self._times[number], self._times[number + 1]
                for _ in range(_HALVINGS):
                    middle = 0.5 * (low + high)
                    before = self._between(number, middle) < value if a < b else self._between(number, middle) > value
                    low, high = (middle, high) if before else (low, middle)
                return high
        raise ValueError(f"the curve never has the value {value:g}")

    def _between(self, number: int, time: float) -> float:
        """Return the value at a time between a point and the next one: cubic Hermite interpolation."""
        step = self._times[number + 1] - self._times[number]
        t = (time - self._times[number]) / step
        here, there = self._values[number], self._values[number + 1]
        leaving, arriving = step * self._slopes[number], step * self._slopes[number + 1]
        u = 1.0 - t
        return u * u * ((1.0 + 2.0 * t) * here + t * leaving) + t * t * ((1.0 + 2.0 * u) * there - u * arriving)


def _slope(before: float, after: float, step: float, next_step: float) -> float:
    """Return the slope at a point, from those of the chords on its sides and their durations."""
    if before * after <= 0.0:
        return 0.0
    share = (step + 2.0 * next_step) / (3.0 * (step + next_step))
    return before * after / (share * after + (1.0 - share) * before)
