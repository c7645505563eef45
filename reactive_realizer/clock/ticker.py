"""Ticks: the moments at which the realizer acts."""

from collections import deque
from collections.abc import AsyncIterator
from dataclasses import dataclass, field
from math import ceil, floor
from typing import Self

from reactive_realizer.clock.clock import Clock
from reactive_realizer.clock.units import RESOLUTION, GlobalTime, is_due

RATE = 100
"""Ticks per second."""

FRAME_EVERY = 2
"""Ticks per frame: poses are composed at 50 Hz."""


@dataclass(frozen=True, slots=True)
class Tick:
    """A moment of realizer time; it covers the time since the previous one.

    Attributes:
        number: n; the tick's time is n / RATE, the decimal fraction itself rather than a sum of steps.
        previous: time of the previous tick, s; -1 for the first.
        frame: whether a pose is to be composed.
        time: seconds on the realizer's clock.
    """

    number: int
    previous: GlobalTime
    frame: bool = False
    time: GlobalTime = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "time", tick_time(self.number))

    @classmethod
    def following(cls, last: "Tick | None", number: int) -> Self:
        """Tick ``number`` after ``last``, which is None for the first."""
        if last is None:
            return cls(number, GlobalTime(-1.0), frame=True)
        return cls(number, last.time, number // FRAME_EVERY > last.number // FRAME_EVERY)

    @classmethod
    def on_time(cls, number: int, frame: bool = False) -> Self:
        """Tick ``number``, with none skipped before it."""
        return cls(number, tick_time(number - 1), frame)

    @property
    def left_out(self) -> range:
        """The numbers of the ticks that were skipped since the previous one, because this one is late."""
        return range(max(0, round(self.previous * RATE) + 1), self.number)


def tick_time(number: int) -> GlobalTime:
    """The time of tick ``number``, s."""
    return GlobalTime(number / RATE)


def next_tick(time: GlobalTime) -> GlobalTime:
    """The time of the tick after the one at ``time``, s."""
    return tick_time(round(time * RATE) + 1)


def first_tick(time: GlobalTime) -> int:
    """The number of the first tick at which a time is due."""
    number = ceil((time - RESOLUTION) * RATE)
    return number if is_due(time, tick_time(number)) else number + 1


class Ticker:
    """Makes ticks from a clock; a tick that is late covers the whole interval since the previous one.

    Attributes:
        overruns: number of ticks that were skipped because an earlier one took too long.
        lateness: of the last thousand ticks, s.
    """

    def __init__(self, clock: Clock) -> None:
        self.clock = clock
        self.overruns = 0
        self.lateness: deque[float] = deque(maxlen=1000)

    def late(self, *shares: float) -> dict[float, float]:
        """The lateness (s) that shares of the last ticks, such as 0.99, have not exceeded; empty before the second."""
        late = sorted(self.lateness)
        return {share: late[min(len(late) - 1, int(share * len(late)))] for share in shares} if len(late) > 1 else {}

    async def ticks(self) -> AsyncIterator[Tick]:
        """Ticks forever, each at its time."""
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
