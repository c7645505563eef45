"""Maps time to the phase of a motion whose pegs may move while it plays."""

from collections.abc import Callable, Mapping, Sequence
from math import exp
from typing import NamedTuple

from reactive_realizer.clock.units import RESOLUTION, GlobalTime, Time
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.reactive.cell import Scan, Source


class Progress(NamedTuple):
    """The progress through the key positions of a motion.

    Attributes:
        reached: number of key positions that were reached.
        time: for which it was computed, s.
        phase: 0 to 1.
        rate: of the phase, 1/s; None where it is that which the next key position asks for.
    """

    reached: int = 0
    time: GlobalTime = GlobalTime(0.0)
    phase: float = 0.0
    rate: float | None = None


def advanced(
    last: Progress,
    phases: Sequence[float],
    time_of: Callable[[int], Time],
    now: GlobalTime,
    smoothing: float = 0.0,
    stroke: int | None = None,
) -> Progress:
    """The progress at a time, not before that of the last one.

    The phase advances linearly from each key position to the next, to arrive when its sync point is due. If a point
    moves, the rate changes from now on, but not the phase itself: a motion is slowed down or sped up, and never jumps
    or turns back. It passes over unknown points to the next known one, and stands still while no further point is
    known. An unknown stroke is reached with the next known point at the latest, so the motion goes no further than to
    the stroke until then.

    Args:
        last: the last progress.
        phases: of the key positions, 0 to 1, in the order in which they are reached.
        time_of: returns the time of the sync point of a key position.
        now: s.
        smoothing: time constant with which the rate adapts to a point that has moved, s.
        stroke: number of the key position of the stroke; None if there is none.
    """
    reached, since, phase, rate = last
    while (key := _next_known(reached, len(phases), time_of)) is not None:
        number, time = key
        if time > now + RESOLUTION:
            goal = stroke if stroke is not None and reached <= stroke < number else number
            # A point that was unknown may have been passed over.
            way, rate = _way(max(phases[goal] - phase, 0.0), time - since, rate, now - since, smoothing)
            return Progress(reached, now, phase + way, rate)
        phase, since, rate = max(phase, phases[number]), max(since, time), None
        reached = number + 1
    return Progress(reached, now, phase)


def _way(left: float, whole: float, rate: float | None, passed: float, smoothing: float) -> tuple[float, float]:
    """The way to go in some time, and the rate then.

    The rate approaches exponentially, from the present one, the constant rate that covers what is left in the time that
    is left. It gives the same way however often it is asked for.

    Args:
        left: way to the next key position.
        whole: time until then, s, more than 0.
        rate: present rate, 1/s; None for a constant one.
        passed: s, less than the whole time.
        smoothing: time constant, s.
    """
    if rate is not None and rate * smoothing > left:
        smoothing = left / rate
    if rate is None or smoothing <= 0.0 or abs(rate * whole - left) < _EVEN:
        return left * passed / whole, left / whole
    final = (left - rate * _reach(whole, smoothing)) / (whole - _reach(whole, smoothing))
    return (
        final * passed + (rate - final) * _reach(passed, smoothing),
        final + (rate - final) * exp(-passed / smoothing),
    )


_EVEN = 1e-9
"""A rate that misses the next key position by less is taken as constant."""


def _reach(time: float, smoothing: float) -> float:
    """How far a decaying rate of 1 goes in some time."""
    return smoothing * (1.0 - exp(-time / smoothing))


def _next_known(first: int, end: int, time_of: Callable[[int], Time]) -> tuple[int, GlobalTime] | None:
    """The first key position from a number on whose time is known, with the time; None if there is none."""
    for number in range(first, end):
        if (time := time_of(number)) is not None:
            return number, time
    return None


def progress_cell(unit: PlanUnit, phases: Sequence[float], time: Source[GlobalTime]) -> Scan[Progress]:
    """A cell with the progress of a unit: it follows the time and the pegs of the unit.

    Args:
        unit: with one key position for each of its points.
        phases: of the key positions, 0 to 1.
        time: of the present tick.
    """
    pegs = [point.peg for point in unit.points]

    def formula(last: Progress, now: GlobalTime, *times: Time) -> Progress:
        return advanced(last, phases, times.__getitem__, now)

    return Scan(time.graph, str(unit.key("progress")), Progress(), (time, *pegs), formula)


_SMOOTHING = 0.1
"""Time constant with which the rate of a motion adapts to a point that has moved, s."""


class PhaseClock:
    """The phase of a unit, `advanced` whenever it is asked for; its rate is smooth.

    Args:
        keys: sync id -> phase, 0 to 1, in the order in which they are reached.
    """

    def __init__(self, keys: Mapping[str, float]) -> None:
        self._syncs, self._phases = tuple(keys), tuple(keys.values())
        self._stroke = self._syncs.index("stroke") if "stroke" in keys else None
        self._progress = Progress()

    @property
    def phase(self) -> float:
        """The phase at the last time."""
        return self._progress.phase

    def advance(self, unit: PlanUnit, now: GlobalTime) -> float:
        """The phase at a time, not before that of the last call."""
        self._progress = advanced(
            self._progress, self._phases, lambda k: unit.time(self._syncs[k]), now, _SMOOTHING, self._stroke
        )
        return self._progress.phase
