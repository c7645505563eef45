"""A clock that moves with the ticks of a realizer."""

import asyncio

from reactive_realizer.clock.units import GlobalTime, is_due


class TickClock:
    """Realizer time for tasks beside the ticks: it stands still between two ticks.

    So a task that waits only for this clock and for inputs does the same in every run of the same session, live, as
    fast as possible, or late.
    """

    def __init__(self) -> None:
        self._now = GlobalTime(0.0)
        self._alarms: dict[asyncio.Future[None], GlobalTime] = {}

    def now(self) -> GlobalTime:
        """The time of the present tick, or of the last one, s."""
        return self._now

    async def wait_until(self, moment: float) -> None:
        """Return in the first tick at or after a moment; if it has passed, in the next tick."""
        await self.wait(asyncio.get_running_loop().create_future(), moment)

    async def sleep(self, seconds: float) -> None:
        """Wait for some seconds."""
        await self.wait_until(self._now + seconds)

    async def wait(self, awaited: "asyncio.Future[None]", moment: float) -> None:
        """Return when a future is done, and complete it in the first tick at or after a moment."""
        self._alarms[awaited] = GlobalTime(moment)
        try:
            await awaited
        finally:
            del self._alarms[awaited]

    def advance(self, now: GlobalTime) -> bool:
        """Set the time, and complete what waits for it; whether there was something."""
        self._now = now
        due = [awaited for awaited, moment in self._alarms.items() if is_due(moment, now) and not awaited.done()]
        for awaited in due:
            awaited.set_result(None)
        return bool(due)
