"""Whole sessions: run on a clock, or replayed from recorded inputs."""

from collections.abc import Awaitable, Callable, Iterable

from reactive_realizer.clock.clock import Clock, ManualClock
from reactive_realizer.clock.ticker import Tick, Ticker
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.realizer.inputs import TickInputs
from reactive_realizer.realizer.realizer import Realizer

AfterTick = Callable[[Tick], Awaitable[object]]
"""Called after each tick; the next one waits for it."""


async def no_wait(_tick: Tick) -> None:
    """Have the next tick wait for nothing."""


async def run_until_done(realizer: Realizer, clock: Clock, until: GlobalTime, after_tick: AfterTick = no_wait) -> None:
    """Tick until ``until``, or until every block has ended or can never continue, which is reported.

    On a virtual clock, which runs as fast as ticks are computed, slow work finishes before the next tick, where its
    result enters.
    """
    async for tick in Ticker(clock).ticks():
        await realizer.step(tick)
        await after_tick(tick)
        if isinstance(clock, ManualClock):
            await realizer.settle()
        if tick.time >= until or not (realizer.busy or realizer.scheduler.blocks.asked_for):
            return
        if not (realizer.busy or realizer.expectant) and realizer.scheduler.stuck(tick.time):
            realizer.scheduler.warn_stuck()
            realizer.feedback.flush(tick.time)
            return


async def replay(realizer: Realizer, session: Iterable[TickInputs], after_tick: AfterTick = no_wait) -> None:
    """Play the ticks of a recorded session, and no others, each with its inputs.

    Slow work is done again; its results enter at the ticks at which they did when the session was recorded. The streams
    of anticipators do not run: what they predicted was recorded.

    Args:
        realizer: of the same scene, at its beginning.
        session: its ticks in order.
        after_tick: called after each of them.

    Raises:
        RealizerError: "replay-differs" or "forecast-differs": the realizer requests something else than recorded.
    """
    tick: Tick | None = None
    for entered in session:
        tick = Tick.following(tick, entered.tick)
        await realizer.settle()
        await realizer.step(tick, entered)
        await after_tick(tick)
