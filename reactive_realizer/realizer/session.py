"""A whole session: on a virtual clock as fast as it can be computed, and the same every time."""

from reactive_realizer.clock.clock import Clock, ManualClock
from reactive_realizer.clock.ticker import Ticker
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.realizer.realizer import Realizer


async def run_until_done(realizer: Realizer, clock: Clock, until: GlobalTime) -> None:
    """Tick until every block has ended, nothing that waits can move any more (that is said), or ``until``.

    On a virtual clock a tick is not left while slow work requested in it is outstanding: its result enters at the next.
    """
    async for tick in Ticker(clock).ticks():
        await realizer.step(tick)
        if isinstance(clock, ManualClock):
            await realizer.settle()
        if tick.time >= until or not (realizer.busy or realizer.scheduler.blocks.alive):
            return
        if not realizer.busy and realizer.scheduler.stuck(tick.time):
            realizer.scheduler.warn_stuck()
            realizer.feedback.flush(tick.time)
            return
