"""The formulas of pegs: times from times, global, in seconds; None while unknown."""

from collections.abc import Callable, Iterable, Iterator
from math import inf

from reactive_realizer.clock.units import RESOLUTION, GlobalTime, Time, has_passed


def shifted_by(offset: float) -> Callable[[Time], Time]:
    """A distance (s) from another time."""

    def formula(link: Time) -> Time:
        return None if link is None else GlobalTime(link + offset)

    return formula


def between(ratio: float) -> Callable[[Time, Time], Time]:
    """A fraction of the way between two others."""

    def formula(before: Time, after: Time) -> Time:
        if before is None or after is None:
            return None
        return GlobalTime(before + ratio * (after - before))

    return formula


def not_before(bounds: tuple[float, ...], ceilings: tuple[float, ...]) -> Callable[..., Time]:
    """The first time, or the latest bound that is not after any ceiling; None while a bound is unknown.

    Args:
        bounds: distance (s) from each time after the first that is a bound.
        ceilings: from each of those that follow.
    """

    def formula(natural: Time, *others: Time) -> Time:
        if natural is None or None in others[: len(bounds)]:
            return None
        ceiling = min(_known(others[len(bounds) :], ceilings), default=inf) + RESOLUTION
        return GlobalTime(max([natural, *(t for t in _known(others[: len(bounds)], bounds) if t <= ceiling)]))

    return formula


def not_after(bounds: tuple[float, ...], floors: tuple[float, ...]) -> Callable[..., Time]:
    """The first time, or the earliest known bound that is not before any floor.

    Args:
        bounds: distance (s) from each time after the first that is a bound.
        floors: from each of those that follow.
    """

    def formula(natural: Time, *others: Time) -> Time:
        if natural is None:
            return None
        floor = max(_known(others[len(bounds) :], floors), default=-inf) - RESOLUTION
        return GlobalTime(min([natural, *(t for t in _known(others[: len(bounds)], bounds) if t >= floor)]))

    return formula


def until(offset: float, limit: float | None) -> Callable[[Time, Time], Time]:
    """A distance (s) from the second time, but not before the first one, and at most ``limit`` (s) after that."""

    def formula(start: Time, awaited: Time) -> Time:
        if start is None:
            return None
        ends = [] if limit is None else [start + limit]
        ends += [] if awaited is None else [max(start, awaited + offset)]
        return GlobalTime(min(ends)) if ends else None

    return formula


def unless_late(least: float, earliest: float) -> Callable[[Time, Time], Time]:
    """The first time, or ``earliest`` (s) after the second one if it is less than ``least`` (s) after that."""

    def formula(time: Time, start: Time) -> Time:
        if time is None or start is None:
            return None
        return GlobalTime(start + earliest) if has_passed(time, start + least) else time

    return formula


def latest(floor: GlobalTime) -> Callable[..., Time]:
    """The latest of several times and the floor; None while one of them is unknown."""

    def formula(*times: Time) -> Time:
        known = [time for time in times if time is not None]
        return max([floor, *known]) if len(known) == len(times) else None

    return formula


class Later:
    """The result of another formula, later by some seconds.

    Attributes:
        formula: the other formula.
        seconds: negative for earlier.
    """

    __slots__ = ("formula", "seconds")

    def __init__(self, formula: Callable[..., Time], seconds: float) -> None:
        self.formula = formula
        self.seconds = seconds

    def later(self, seconds: float) -> "Later":
        """The result of the same formula, later by some more seconds."""
        return Later(self.formula, self.seconds + seconds)

    def __call__(self, *times: Time) -> Time:
        """The time; None while the other formula gives none."""
        time = self.formula(*times)
        return None if time is None else GlobalTime(time + self.seconds)


def not_after_next(formula: Callable[..., Time], distance: float) -> Callable[..., Time]:
    """The result of another formula for all times but the last, and no later than at a distance (s) from the last.

    None while that result is unknown; an unknown last time has no effect.
    """

    def bounded(*times: Time) -> Time:
        time, successor = formula(*times[:-1]), times[-1]
        return time if time is None or successor is None else min(time, GlobalTime(successor + distance))

    return bounded


def not_before_previous(formula: Callable[..., Time], distance: float) -> Callable[..., Time]:
    """The result of another formula for all times but the last, and no earlier than at a distance (s) from the last.

    None while that result is unknown; an unknown last time has no effect.
    """

    def bounded(*times: Time) -> Time:
        time, previous = formula(*times[:-1]), times[-1]
        return time if time is None or previous is None else max(time, GlobalTime(previous + distance))

    return bounded


def not_earlier(formula: Callable[..., Time], earliest: GlobalTime) -> Callable[..., Time]:
    """The result of another formula, and not before a time if it is known."""

    def bounded(*times: Time) -> Time:
        time = formula(*times)
        return None if time is None else max(time, earliest)

    return bounded


def _known(times: Iterable[Time], distances: Iterable[float]) -> Iterator[float]:
    return (time + distance for time, distance in zip(times, distances, strict=True) if time is not None)
