"""A jump of the eyes from one direction to another (thesis 4.2.2)."""

import math

PEAK_VELOCITY = 8.7
"""rad/s, which no saccade exceeds (thesis 4.2.2)."""


def saccade_duration(amplitude: float) -> float:
    """How long a saccade of an amplitude (rad) takes, s: linear, 21 ms and 2.2 ms for each degree.

    R. H. S. Carpenter, "Movements of the Eyes" (1988).
    """
    return 0.021 + 0.0022 * math.degrees(amplitude)


def saccade_progress(amplitude: float, passed: float) -> float:
    """The part of a saccade (amplitude in rad) that is done a time (s) after it began, 0 to 1.

    Its velocity rises and falls as a cosine does, in the same way, to at most `PEAK_VELOCITY`: small saccades reach
    twice their mean velocity, which grows with the amplitude; those over 12 degrees stay a while at the peak.
    """
    duration = saccade_duration(amplitude)
    if passed >= duration:
        return 1.0
    if passed > 0.5 * duration:
        return 1.0 - saccade_progress(amplitude, duration - passed)
    # The way is as long as the peak velocity makes it in the whole time, less one of the two rises.
    rise = min(0.5 * duration, duration - amplitude / PEAK_VELOCITY)
    peak = 1.0 / (duration - rise)
    if passed >= rise:
        return peak * (passed - 0.5 * rise)
    return 0.5 * peak * (passed - rise / math.pi * math.sin(math.pi * passed / rise))
