"""The demo: its performance starts with the first page, and again on request."""

import pytest

from reactive_realizer.testing.pilot import block

from .conftest import ALICE, Open, wait

PLAY = wait("play", 5)


async def test_the_performance_starts_when_the_first_page_opens_and_not_with_the_second(on_air: Open) -> None:
    async with on_air(ALICE, performance=PLAY) as air:
        planner = await air.connect("?streams=feedback")
        assert planner.hello["demo"] is True
        await air.tick()
        assert not air.live.realizer.busy
        await air.connect()
        await air.tick_until(2.0)
        await planner.hear_feedback('"play:start"')
        await air.connect()
        await air.tick_until(6.0)
        (block,) = air.live.realizer.scheduler.blocks.alive
        start = block.start.value
        assert start is not None
        assert start < 2.0


async def test_the_performance_can_be_restarted_at_any_time(on_air: Open) -> None:
    async with on_air(ALICE, performance=PLAY) as air:
        page = await air.connect()
        await air.tick_until(3.0)
        assert (await page.ask(type="demo"))["type"] == "accepted"
        await air.tick_until(5.0)
        assert "INTERRUPTED" in (await page.hear_feedback('"play:end"'))["xml"]
        await page.hear_feedback('"play:start"')
        assert not air.live.realizer.scheduler.refused


@pytest.mark.parametrize("spoken", ["", "<speech id='s'><text>Hello.</text></speech>"])
async def test_the_metronome_counts_from_the_first_block_that_speaks_or_else_from_the_first_one(
    on_air: Open, spoken: str
) -> None:
    beat = '<wait id="w" start="anticipators:metronome:tick2" duration="0.1"/>'
    intro = block("intro", '<wait id="w" duration="1"/>') if spoken else ""
    async with on_air(ALICE, performance=intro + block("play", spoken + beat, composition="APPEND")) as air:
        page = await air.connect()
        await air.tick_until(6.0)
        begun = float((await page.hear_feedback('"play:start"'))["xml"].partition('globalTime="')[2].partition('"')[0])
        assert f'globalTime="{begun + 2.01:g}"' in (await page.hear_feedback('"play:w:start"'))["xml"]


async def test_opening_a_page_starts_nothing_without_a_performance(on_air: Open) -> None:
    async with on_air() as air:
        assert (await air.connect()).hello["demo"] is False
        assert not air.live.realizer.busy
