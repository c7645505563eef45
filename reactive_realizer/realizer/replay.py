"""A session again, from what entered the first time."""

from collections.abc import Iterable

from reactive_realizer.clock.ticker import Tick
from reactive_realizer.realizer.entered import Entered
from reactive_realizer.realizer.realizer import Realizer


async def replay(realizer: Realizer, session: Iterable[Entered]) -> None:
    """Play the ticks of a session, no others, each with what it took in.

    Slow work is done as it was then; whenever it is ready now, it is handed over at the tick at which it was then.

    Args:
        realizer: of the same scene, at its beginning.
        session: its ticks in order.

    Raises:
        RealizerError: "replay-differs": the realizer asks for other work than it did then.
    """
    tick: Tick | None = None
    for entered in session:
        tick = Tick.following(tick, entered.tick)
        for entry in entered.inputs:
            realizer.put(entry, tick.time)
        await realizer.settle()
        await realizer.step(tick, entered.work)
