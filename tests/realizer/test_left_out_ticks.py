"""A late tick plays the ticks that were left out, but only those in which something was due."""

from collections.abc import AsyncIterator

import pytest

from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.effects import Play
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot


@pytest.fixture
async def pilot() -> AsyncIterator[RealizerPilot]:
    async with open_pilot() as pilot:
        await pilot.advance(0.01)
        yield pilot


@pytest.fixture
def played(pilot: RealizerPilot, monkeypatch: pytest.MonkeyPatch) -> list[Tick]:
    """The ticks that Alice's wait engine is asked to play."""
    engine = next(engine for engine in pilot.realizer.characters["alice"].engines if engine.name.endswith("/wait"))
    ticks: list[Tick] = []
    play = engine.play

    def note(tick: Tick) -> Play:
        ticks.append(tick)
        return play(tick)

    monkeypatch.setattr(engine, "play", note)
    return ticks


async def test_ticks_that_were_left_out_are_played_if_something_was_due_in_them(
    pilot: RealizerPilot, played: list[Tick]
) -> None:
    pilot.block("b", '<wait id="v" start="0.5" duration="0.734"/><wait id="w" start="3" duration="1"/>')
    await pilot.tick()
    played.clear()
    await pilot.realizer.step(Tick(500, GlobalTime(0.01), frame=False))
    assert sorted({tick.number for tick in played}) == [51, 125, 301, 401]
    assert [tick for tick in played if tick.left_out] == []


async def test_no_tick_of_a_long_pause_is_played_if_nothing_was_due(pilot: RealizerPilot, played: list[Tick]) -> None:
    pilot.block("b", '<wait id="w" start="4000" duration="1"/>')
    await pilot.tick()
    played.clear()
    await pilot.realizer.step(Tick(360_000, GlobalTime(0.01), frame=False))
    assert played == []


async def test_a_pause_of_a_month_takes_no_longer_than_what_was_due_in_it(
    pilot: RealizerPilot, played: list[Tick]
) -> None:
    pilot.block("b", '<wait id="v" start="0.5" duration="1"/><wait id="w" start="80000" duration="1"/>')
    await pilot.tick()
    played.clear()
    await pilot.realizer.step(Tick(300_000_000, GlobalTime(0.01), frame=False))
    assert {tick.number for tick in played} == {51, 151, 8_000_001, 8_000_101}


async def test_only_the_late_tick_itself_makes_a_frame(pilot: RealizerPilot) -> None:
    pilot.watch()
    pilot.block("b", '<gesture id="g" lexeme="BEAT"/>')
    await pilot.tick()
    await pilot.realizer.step(Tick(101, GlobalTime(0.01), frame=True))
    assert [frame.time for frame in pilot.frames["alice"]] == [1.01]
    assert pilot.realizer.time == pilot.realizer.board.time == 1.01


async def test_a_point_that_cannot_be_reached_yet_does_not_cause_every_tick_to_be_played(
    pilot: RealizerPilot, played: list[Tick]
) -> None:
    pilot.block("b", '<wait id="v" duration="9"/><wait id="w" start="anticipators:user:ready" end="1"/>')
    await pilot.tick()
    played.clear()
    await pilot.realizer.step(Tick(500, GlobalTime(0.01), frame=False))
    assert len(played) <= 3
