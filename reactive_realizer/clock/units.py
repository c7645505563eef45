"""Seconds, with their frame of reference in the type."""

from typing import NewType

GlobalTime = NewType("GlobalTime", float)
"""Seconds on the realizer's clock; 0 is the first tick."""

Time = GlobalTime | None
"""A global time; None while it is unknown."""

BlockTime = NewType("BlockTime", float)
"""Seconds since the start of a BML block."""

RESOLUTION = 1e-9
"""Times closer than this (s) are equal: sums of decimal fractions differ by rounding and must not miss a tick."""


def is_due(time: GlobalTime | float | None, now: GlobalTime | float) -> bool:
    """Whether a time has come; an unknown time never has."""
    return time is not None and time <= now + RESOLUTION


def has_passed(time: GlobalTime | float | None, since: GlobalTime | float) -> bool:
    """Whether a time came before another one; an unknown time did not."""
    return time is not None and time < since - RESOLUTION
