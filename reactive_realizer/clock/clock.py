"""Clocks: where realizer time comes from."""

import asyncio
import time
from typing import Protocol

from reactive_realizer.clock.units import GlobalTime


class Clock(Protocol):
    """Realizer time, from 0, never backwards.

    Attributes:
        epoch: POSIX time (s) of its 0: what others, who have no realizer clock, can compare with.
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
        """Sleep; at once when the moment has passed, yet never without giving others a turn."""
        await asyncio.sleep(max(0.0, moment - self.now()))


class ManualClock:
    """A clock that stands where it was put: tests and offline runs; waiting is arriving."""

    def __init__(self) -> None:
        self._now = GlobalTime(0.0)
        self.epoch = 0.0

    def now(self) -> GlobalTime:
        """Where the clock was put."""
        return self._now

    async def wait_until(self, moment: GlobalTime) -> None:
        """Go there.

        Raises:
            ValueError: the moment has passed.
        """
        if moment < self._now:
            raise ValueError(f"the clock stands at {self._now:.7f} and does not go back to {moment:.7f}")
        self._now = moment
