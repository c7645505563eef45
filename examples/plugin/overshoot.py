"""A trajectory of one's own: further than it should, and back."""

from math import pi, sin


def overshoot(share: float) -> float:
    """The share of the way after a share of the time, both 0 to 1; 1 after all of it."""
    return share + 0.6 * sin(pi * share)
