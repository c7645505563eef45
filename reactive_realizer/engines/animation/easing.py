"""How people start and stop."""


def minimum_jerk(progress: float) -> float:
    """The share of a reach that is done, 0..1, after a share of its time; at rest at both ends.

    T. Flash and N. Hogan, "The coordination of arm movements" (Journal of Neuroscience 5, 1985): of all such movements
    the hand takes the one of least jerk.
    """
    t = min(1.0, max(0.0, progress))
    return t * t * t * (10.0 + t * (6.0 * t - 15.0))


def smoothstep(progress: float) -> float:
    """The share that is done, 0..1, of what need only be at rest at both ends: 3t^2 - 2t^3, t from 0 to 1."""
    return progress * progress * (3.0 - 2.0 * progress)


def share(value: float, start: float, end: float) -> float:
    """How far a value lies between start and end, 0..1; 1 where they coincide, for then it is past."""
    if end <= start:
        return 1.0
    return min(1.0, max(0.0, (value - start) / (end - start)))
