"""Ticks are at n / 100 s, and a late tick covers the skipped ones."""

import pytest

from reactive_realizer.clock.clock import ManualClock, SystemClock
from reactive_realizer.clock.ticker import Tick, Ticker
from reactive_realizer.clock.units import GlobalTime, is_due


class LateClock(ManualClock):
    """A clock whose waits end late by given delays."""

    def __init__(self, *delays: float) -> None:
        super().__init__()
        self._delays = list(delays)

    async def wait_until(self, moment: GlobalTime) -> None:
        late = self._delays.pop(0) if self._delays else 0.0
        await super().wait_until(GlobalTime(max(moment, self.now()) + late))


async def ticks(clock: ManualClock, count: int) -> tuple[Ticker, list[Tick]]:
    ticker = Ticker(clock)
    found = []
    async for tick in ticker.ticks():
        found.append(tick)
        if len(found) == count:
            return ticker, found
    raise AssertionError


async def test_tick_times_are_exact_hundredths_of_a_second() -> None:
    _, found = await ticks(ManualClock(), 1001)
    assert [tick.time for tick in found[:4]] == [0.0, 0.01, 0.02, 0.03]
    assert found[1000].time == 10.0


async def test_the_first_tick_covers_time_0() -> None:
    _, (first, second) = await ticks(ManualClock(), 2)
    assert first.previous < 0.0
    assert first.time == 0.0
    assert second.previous == 0.0


async def test_every_second_tick_has_a_frame() -> None:
    _, found = await ticks(ManualClock(), 6)
    assert [tick.frame for tick in found] == [True, False, True, False, True, False]


async def test_a_late_tick_covers_the_whole_interval_and_skipped_ticks_are_counted() -> None:
    ticker, found = await ticks(LateClock(0.0, 0.0, 0.053), 4)
    assert [tick.number for tick in found] == [0, 1, 7, 8]
    assert [tick.previous for tick in found] == [-1.0, 0.0, 0.01, 0.07]
    assert ticker.overruns == 5
    assert max(ticker.lateness) == pytest.approx(0.053)


def test_a_tick_knows_the_skipped_ticks_before_it() -> None:
    assert list(Tick(7, GlobalTime(0.01)).left_out) == [2, 3, 4, 5, 6]
    assert not Tick(8, GlobalTime(0.07)).left_out
    assert not Tick.on_time(29).left_out
    assert list(Tick.following(None, 2).left_out) == [0, 1]


async def test_a_skipped_frame_comes_with_the_next_tick() -> None:
    _, found = await ticks(LateClock(0.0, 0.02), 5)
    assert [(tick.number, tick.frame) for tick in found] == [(0, True), (3, True), (4, True), (5, False), (6, True)]


async def test_a_tick_that_is_early_by_rounding_has_its_own_number() -> None:
    _, found = await ticks(LateClock(*[1e-12] * 3), 3)
    assert [tick.number for tick in found] == [0, 1, 2]


async def test_the_manual_clock_cannot_go_back() -> None:
    clock = ManualClock()
    await clock.wait_until(GlobalTime(1.0))
    with pytest.raises(ValueError, match="cannot go back"):
        await clock.wait_until(GlobalTime(0.5))


async def test_the_system_clock_does_not_wait_for_a_past_moment() -> None:
    clock = SystemClock()
    await clock.wait_until(GlobalTime(-1.0))
    assert clock.now() >= 0.0
    assert clock.epoch > 1e9


def test_an_unknown_time_is_never_due_and_rounding_misses_no_tick() -> None:
    assert not is_due(None, 1.0)
    assert is_due(0.1 + 0.2, 0.3)
    assert not is_due(0.31, 0.3)
