"""The low-pass filter for captured motion (thesis 3.2.2.2)."""

import math

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.errors import error

_PASSES = 2
_SLOWEST = 0.1
"""Hz; people hardly move as slowly."""
_EVEN = 0.01
"""How much of a step the distances of even keys may differ, as files write times with few digits."""


def low_pass(values: NDArray[np.float64], times: tuple[float, ...], cutoff: float, name: str) -> NDArray[np.float64]:
    """Values without what is faster than a frequency: a Butterworth filter of second order, there and back.

    Once forward and once backward in time, so that nothing is delayed (equations 3.10 to 3.12, after D. A. Winter,
    "Biomechanics and motor control of human movement"). Each component is filtered by itself. Where the samples are too
    slow to hold that frequency there is nothing to take away.

    Args:
        values: (K, ...), of evenly spaced times.
        times: (K,), s.
        cutoff: Hz.
        name: of what is filtered, for messages.

    Raises:
        RealizerError: "bad-keys": the times are not evenly spaced, or the filter would leave no motion.
    """
    if cutoff < _SLOWEST:
        raise error("bad-keys", animation=name, reason=f"a filter has {_SLOWEST:g} Hz or more, not {cutoff:g}")
    steps = np.diff(times)
    if np.ptp(steps) > _EVEN * np.mean(steps):
        raise error("bad-keys", animation=name, reason="only keys at even distances in time can be filtered")
    rate = 1.0 / float(np.mean(steps))
    if cutoff >= 0.5 * rate:
        return values
    weights = _weights(cutoff, rate)
    return _once(_once(values, weights)[::-1], weights)[::-1]


def _weights(cutoff: float, rate: float) -> tuple[float, float, float]:
    """a0, b1 and b2 of equation 3.11; a1 is 2 a0, a2 is a0."""
    correction = (2.0 ** (1.0 / _PASSES) - 1.0) ** 0.25
    frequency = math.tan(math.pi * cutoff / rate) / correction
    k2 = frequency * frequency
    a0 = k2 / (1.0 + math.sqrt(2.0) * frequency + k2)
    k3 = 2.0 * a0 / k2
    return a0, k3 - 2.0 * a0, 1.0 - 2.0 * a0 - k3


def _once(raw: NDArray[np.float64], weights: tuple[float, float, float]) -> NDArray[np.float64]:
    a0, b1, b2 = weights
    out = raw.copy()
    for i in range(2, len(raw)):
        out[i] = a0 * (raw[i] + 2.0 * raw[i - 1] + raw[i - 2]) + b1 * out[i - 1] + b2 * out[i - 2]
    return out
