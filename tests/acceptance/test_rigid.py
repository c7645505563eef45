"""Rigid behaviors stay rigid: ties that they cannot meet are dropped by every strategy (thesis 7.1.4)."""

from collections.abc import AsyncIterator

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.assertions import assert_linked, assert_time
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .living_time import HIT, LOST, WELL, moves, nod, synchronize, texts, wait


@pytest.fixture(params=["convex", "embr", "smartbody"])
async def pilot(request: pytest.FixtureRequest) -> AsyncIterator[RealizerPilot]:
    async with open_pilot(SceneOptions(voice="text", strategy=request.param, verify=True)) as pilot:
        yield pilot


async def test_a_speech_that_cannot_start_early_enough_ends_late(pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", 3.0)
    pilot.block("b", WELL.format(f' end="{HIT}"') + nod("n", start="s:m"))
    await moves(pilot, 1, ("hit", 1.3), 4)
    assert_time(pilot.feedback, "b:s:start", 1.0)
    assert_time(pilot.feedback, "b:s:end", 2.34)
    assert_linked(pilot.feedback, "b:n:start", "b:s:m")
    assert [LOST in said and f"s:end = {HIT}" in said for said in texts(pilot)] == [True]


async def test_the_end_of_a_playing_speech_does_not_follow_a_later_prediction(pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", 1.5)
    pilot.block("b", WELL.format(f' end="{HIT}"') + nod("n", start="s:m") + wait("w", 0.1, start=HIT))
    await moves(pilot, 0.5, ("hit", 3.0), 4)
    assert_time(pilot.feedback, "b:s:end", 1.5)
    assert_linked(pilot.feedback, "b:n:start", "b:s:m")
    assert_time(pilot.feedback, "b:w:start", 3.0)
    assert [f"s:end = {HIT} {LOST}: it is off by 1.50 s" in said for said in texts(pilot)] == [True]


@pytest.mark.parametrize("moved", [2.0, None])
async def test_a_behavior_tied_to_the_end_of_a_speech_follows_the_speech_and_not_the_prediction(
    moved: float | None,
) -> None:
    for strategy in ("convex", "embr"):
        async with open_pilot(SceneOptions(voice="text", strategy=strategy, verify=True)) as pilot:
            pilot.predict("t", "hit", 1.5)
            pilot.block("b", WELL.format(f' end="{HIT}"') + nod("n", start="s:end"))
            await moves(pilot, 0.5, ("hit", moved), 4)
            assert_time(pilot.feedback, "b:s:end", 1.5)
            assert_linked(pilot.feedback, "b:n:start", "b:s:end")


async def test_a_speech_moves_as_a_whole_before_its_start(pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", 2.0)
    pilot.block("b", WELL.format("") + synchronize("s:m", HIT))
    await moves(pilot, 0.5, ("hit", 3.0), 0.5, ("hit", 2.5), 4)
    assert_time(pilot.feedback, "b:s:start", 2.2)
    assert_time(pilot.feedback, "b:s:end", 3.54)
    assert texts(pilot) == []


async def test_a_playing_speech_stays_whole_when_the_start_that_it_shares_is_predicted_anew(
    pilot: RealizerPilot,
) -> None:
    """The start of the dropped speech is at 0 s from the shared start, but for rounding."""
    dropped = WELL.replace('id="s"', 'id="z"').format(f' start="{HIT}"')
    beat = '<gesture id="q" lexeme="BEAT" mode="RIGHT_HAND" start="s:m+1"/>'
    late = '<constraint><after ref="q:stroke-0.2"><sync ref="z:end+1"/></after></constraint>'
    pilot.block("b", WELL.format(' start="z:start"') + beat + dropped + late)
    pilot.predict("t", "hit", 0.5)
    await moves(pilot, 0.6, ("hit", 0.65), 4)
    assert_time(pilot.feedback, "b:s:start", 0.5)
    assert_time(pilot.feedback, "b:s:m", 0.8)
    assert_time(pilot.feedback, "b:s:end", 1.84)
