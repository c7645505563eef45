"""Faults of the times of one behavior."""

from reactive_realizer.errors import SchedulingFault


class Overtaken(SchedulingFault):
    """Sync points whose times, in s, lost their order (thesis 7.15)."""

    code = "overtaken"
    template = "its sync points lost their order when they moved: {sync} is at {time:g} s, {later} at {late:g} s"
    sync: str
    time: float
    later: str
    late: float


class TooShort(SchedulingFault):
    """A behavior without duration (thesis 7.14)."""

    code = "too-short"
    template = "no time is left between its start and its end"
