"""A trajectory that overshoots its target and returns."""

from math import pi, sin


def overshoot(share: float) -> float:
    """The fraction of the change after a fraction of the time, both from 0; 1 at the end."""
    return share + 0.6 * sin(pi * share)
