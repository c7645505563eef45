"""A clock that moves with the ticks wakes what waits for it in the tick that it waits for."""

import asyncio
from collections.abc import Coroutine

from reactive_realizer.clock.tick_clock import TickClock
from reactive_realizer.clock.ticker import RATE, tick_time


async def woken(clock: TickClock, wait: Coroutine[None, None, None]) -> int | None:
    """The number of the tick in which a wait returns; None if it does not within a second."""
    first = round(clock.now() * RATE) + 1
    async with asyncio.TaskGroup() as group:
        task = group.create_task(wait)
        await asyncio.sleep(0)
        for number in range(first, first + RATE):
            clock.advance(tick_time(number))
            await asyncio.sleep(0)
            if task.done():
                return number
        task.cancel()
    return None


async def test_a_wait_returns_in_the_first_tick_at_or_after_its_moment() -> None:
    assert [await woken(clock := TickClock(), clock.wait_until(moment)) for moment in (0.3, 0.301, 7.0)] == [
        30,
        31,
        None,
    ]


async def test_a_moment_that_has_passed_comes_in_the_next_tick() -> None:
    clock = TickClock()
    clock.advance(tick_time(50))
    assert await woken(clock, clock.wait_until(0.5)) == 51


async def test_sleep_counts_from_the_present_tick() -> None:
    clock = TickClock()
    clock.advance(tick_time(20))
    assert await woken(clock, clock.sleep(0.1)) == 30


async def test_it_stands_still_between_two_ticks() -> None:
    clock = TickClock()
    clock.advance(tick_time(3))
    await asyncio.sleep(0.02)
    assert clock.now() == 0.03


async def test_nothing_remains_of_a_wait_that_was_canceled() -> None:
    clock = TickClock()
    async with asyncio.TaskGroup() as group:
        task = group.create_task(clock.wait_until(0.1))
        await asyncio.sleep(0)
        task.cancel()
    assert not clock.advance(tick_time(100))
