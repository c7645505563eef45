"""Ticks: the moments at which the realizer looks."""

from collections import deque
from collections.abc import AsyncIterator
from dataclasses import dataclass
from math import floor
from typing import Self

from reactive_realizer.clock.clock import Clock
from reactive_realizer.clock.units import RESOLUTION, GlobalTime

RATE = 100
"""Ticks a second."""

FRAME_EVERY = 2
"""Ticks a frame: poses are composed at 50 Hz."""


@dataclass(frozen=True, slots=True)
class Tick:
    """One look at the clock.

    Attributes:
        number: n; the tick's time is n / RATE, the decimal fraction itself rather than a sum of steps.
        previous: time of the tick before, -1 s before the first; the tick covers what lies between.
        frame: whether a pose is to be composed.
    """

    number: int
    previous: GlobalTime
    frame: bool = False

    @classmethod
    def following(cls, last: "Tick | None", number: int) -> Self:
        """Tick ``number`` where ``last`` was the one before; None where it is the first."""
        if last is None:
            return cls(number, GlobalTime(-1.0), frame=True)
        return cls(number, last.time, number // FRAME_EVERY > last.number // FRAME_EVERY)

    @classmethod
    def on_time(cls, number: int, frame: bool = False) -> Self:
        """Tick ``number`` right after the one before it."""
        return cls(number, tick_time(number - 1), frame)

    @property
    def left_out(self) -> range:
        """The numbers of the ticks that would have been since the last one, had this one not come late."""
        return range(max(0, round(self.previous * RATE) + 1), self.number)

    @property
    def time(self) -> GlobalTime:
        """Seconds on the realizer's clock."""
        return tick_time(self.number)


def tick_time(number: int) -> GlobalTime:
    """When tick ``number`` is."""
    return GlobalTime(number / RATE)


class Ticker:
    """Makes ticks from a clock; a tick that comes late covers the whole interval, nothing is caught up one by one.

    Attributes:
        overruns: ticks that were left out because the one before took too long.
        lateness: how late (s) the last thousand ticks were.
    """

    def __init__(self, clock: Clock) -> None:
        self.clock = clock
        self.overruns = 0
        self.lateness: deque[float] = deque(maxlen=1000)

    async def ticks(self) -> AsyncIterator[Tick]:
        """Ticks for ever, each at its time."""
        last: Tick | None = None
        while True:
            number = 0 if last is None else last.number + 1
            await self.clock.wait_until(tick_time(number))
            now = self.clock.now()
            latest = max(number, floor((now + RESOLUTION) * RATE))
            self.overruns += latest - number
            self.lateness.append(now - tick_time(number))
            last = Tick.following(last, latest)
            yield last
