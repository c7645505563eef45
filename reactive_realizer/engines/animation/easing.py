"""Easing functions."""


def minimum_jerk(progress: float) -> float:
    """Return the completed share of a reach, 0 to 1, after a share of its time; its speed is 0 at both ends.

    Hand movements minimize jerk: T. Flash and N. Hogan, "The coordination of arm movements" (Journal of Neuroscience 5,
    1985).
    """
    t = min(1.0, max(0.0, progress))
    return t * t * t * (10.0 + t * (6.0 * t - 15.0))


MINIMUM_JERK_PEAK = 1.875
"""The highest speed of a minimum-jerk movement, relative to its average speed."""


def smoothstep(progress: float) -> float:
    """Return 3t^2 - 2t^3, t from 0 to 1: a share from 0 to 1 whose speed is 0 at both ends."""
    return progress * progress * (3.0 - 2.0 * progress)


def share(value: float, start: float, end: float) -> float:
    """Return the position of a value between start and end, 0 to 1; 1 if they coincide."""
    if end <= start:
        return 1.0
    return min(1.0, max(0.0, (value - start) / (end - start)))
