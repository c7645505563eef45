"""Clocks: the source of realizer time."""

import asyncio
import time
from typing import Protocol

from reactive_realizer.clock.units import GlobalTime


class Clock(Protocol):
    """Realizer time: it starts at 0 and never goes backwards.

    Attributes:
        epoch: POSIX time (s) of its 0, to compare with times of other programs.
    """

    epoch: float

    def now(self) -> GlobalTime:
        """Seconds since the clock was started."""
        ...

    async def wait_until(self, moment: GlobalTime) -> None:
        """Return at or after a moment."""
        ...


class SystemClock:
    """The machine's monotonic clock."""

    def __init__(self) -> None:
        self._start = time.monotonic()
        self.epoch = time.time()

    def now(self) -> GlobalTime:
        """Seconds since the clock was made."""
        return GlobalTime(time.monotonic() - self._start)

    async def wait_until(self, moment: GlobalTime) -> None:
        """Sleep; if the moment has passed, only let other tasks run."""
        await asyncio.sleep(max(0.0, moment - self.now()))


class ManualClock:
    """A virtual clock for tests and offline runs: it stands still, and waiting sets it to the moment."""

    def __init__(self) -> None:
        self._now = GlobalTime(0.0)
        self.epoch = 0.0

    def now(self) -> GlobalTime:
        """The time that the clock was set to."""
        return self._now

    async def wait_until(self, moment: GlobalTime) -> None:
        """Set the clock to a moment.

        Raises:
            ValueError: the moment has passed.
        """
        if moment < self._now:
            raise ValueError(f"the clock is at {self._now:.7f} and cannot go back to {moment:.7f}")
        self._now = moment
