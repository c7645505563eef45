"""Times of all points of a behavior from those that are known (thesis 8.7.3, figure 8.12)."""

from collections.abc import Mapping, Sequence


def average_stretch(offsets: Sequence[float], known: Mapping[int, float]) -> float:
    """How much longer than preferred the behavior is between its first and last known points; 1 if that says nothing.

    Args:
        offsets: preferred times (s) of the points after the first.
        known: times (s) by index.
    """
    indices = sorted(known)
    if len(indices) < 2:
        return 1.0
    first, last = indices[0], indices[-1]
    preferred = offsets[last] - offsets[first]
    return (known[last] - known[first]) / preferred if preferred > 0 else 1.0


def ratio_between(offsets: Sequence[float], before: int, index: int, after: int) -> float:
    """How far a point is on its preferred way between two others: stretching is uniform."""
    preferred = offsets[after] - offsets[before]
    return (offsets[index] - offsets[before]) / preferred if preferred > 0 else 0.0
