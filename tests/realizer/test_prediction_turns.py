"""Predictions of clients that move many sync points take turns, and the last one always enters."""

from collections.abc import AsyncIterator

import pytest

from reactive_realizer.pegboard.peg_key import anticipator_key
from reactive_realizer.realizer import prediction_turns
from reactive_realizer.testing.pilot import RealizerPilot, block, open_pilot


@pytest.fixture
async def pilot() -> AsyncIterator[RealizerPilot]:
    async with open_pilot() as pilot:
        yield pilot


@pytest.fixture
def few_moves(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(prediction_turns, "_MOVES", 20)


def time_of(pilot: RealizerPilot, anticipator: str) -> float | None:
    peg = pilot.realizer.board.get(anticipator_key(anticipator, "hit"))
    return None if peg is None else peg.value


async def moved(pilot: RealizerPilot, *anticipators: str, ticks: int) -> list[int]:
    """How often points move that are predicted anew for each of some ticks."""
    times = {each: list[float | None]() for each in anticipators}
    for tick in range(ticks):
        for each in anticipators:
            pilot.predict(each, "hit", 90 + tick)
        await pilot.tick()
        for each in anticipators:
            times[each].append(time_of(pilot, each))
    return [len(set(each)) for each in times.values()]


async def waiting(pilot: RealizerPilot, anticipator: str, number: int) -> None:
    """Have behaviors wait for a point."""
    pilot.predict(anticipator, "hit", 80)
    waits = (f'<wait id="w{i}" start="anticipators:{anticipator}:hit" duration="1"/>' for i in range(number))
    pilot.perform(block(f"for-{anticipator}", "".join(waits)))
    await pilot.advance(1.5)


async def test_a_point_that_moves_few_others_moves_in_each_tick(pilot: RealizerPilot, few_moves: None) -> None:
    await waiting(pilot, "one", 5)
    assert await moved(pilot, "one", ticks=40) == [40]


async def test_a_point_that_moves_many_others_moves_less_often_and_last_to_where_it_was_predicted_last(
    pilot: RealizerPilot, few_moves: None
) -> None:
    await waiting(pilot, "many", 100)
    (times,) = await moved(pilot, "many", ticks=40)
    assert 3 <= times <= 6
    await pilot.advance(0.2)
    assert time_of(pilot, "many") == 90 + 39


async def test_a_point_waits_for_its_turn_only(pilot: RealizerPilot, few_moves: None) -> None:
    for each in ("a", "b", "c"):
        await waiting(pilot, each, 50)
    await waiting(pilot, "quiet", 1)
    *_, quiet = await moved(pilot, "a", "b", "c", "quiet", ticks=120)
    assert quiet >= 6


async def test_blocks_do_not_wait_for_predictions(pilot: RealizerPilot, few_moves: None) -> None:
    await waiting(pilot, "many", 100)
    await moved(pilot, "many", ticks=10)
    pilot.block("b", '<wait id="w" duration="0.1"/>')
    now = pilot.now
    await moved(pilot, "many", ticks=20)
    assert pilot.feedback.time("b:start") == pytest.approx(now)
