"""The formulas of pegs: times from times, global, in seconds; None while unknown."""

from collections.abc import Callable

from reactive_realizer.clock.units import GlobalTime, Time


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


def not_before(distances: tuple[float, ...]) -> Callable[..., Time]:
    """The first time, or the latest of the others with their distances (s); each of them is waited for."""

    def formula(natural: Time, *bounds: Time) -> Time:
        known = [b + d for b, d in zip(bounds, distances, strict=True) if b is not None]
        return None if natural is None or len(known) < len(bounds) else GlobalTime(max(natural, *known))

    return formula


def not_after(distances: tuple[float, ...]) -> Callable[..., Time]:
    """The first time, or the earliest of the others with their distances (s), as far as they are known."""

    def formula(natural: Time, *bounds: Time) -> Time:
        if natural is None:
            return None
        return GlobalTime(min([natural, *(b + d for b, d in zip(bounds, distances, strict=True) if b is not None)]))

    return formula


def latest(floor: GlobalTime) -> Callable[..., Time]:
    """The latest of them and the floor."""

    def formula(*times: Time) -> Time:
        known = [time for time in times if time is not None]
        return max([floor, *known]) if len(known) == len(times) else None

    return formula
