"""The examples of the thesis on how SmartBody's scheduler depends on the order of behaviors, as BML (7.2.2, 7.3.5)."""

from collections.abc import AsyncIterator
from typing import Any

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .scheduling_examples import BEAT_ON_NOD, BEATS, NOD_3_TO_5, NOD_AROUND, NOD_ON_SPEECH, SPEECH


@pytest.fixture
async def pilot() -> AsyncIterator[RealizerPilot]:
    async with open_pilot(SceneOptions(voice="text", strategy="smartbody")) as pilot:
        yield pilot


@pytest.mark.parametrize("order", [(SPEECH, NOD_ON_SPEECH), (NOD_ON_SPEECH, SPEECH)], ids=["27a", "27b"])
async def test_27_a_nod_is_timed_by_the_words_that_it_is_tied_to_in_either_order(
    pilot: RealizerPilot, order: Any
) -> None:
    pilot.block("bml1", "".join(order))
    await pilot.advance(5)
    told = pilot.feedback
    assert told.warnings == []
    assert told.time("bml1:nod1:start") == told.time("bml1:speech1:start") == 0.0
    assert told.time("bml1:nod1:end") == told.time("bml1:speech1:sync1") > 0.2


async def test_28a_a_beat_on_the_stroke_of_a_nod_follows_it(pilot: RealizerPilot) -> None:
    pilot.block("bml1", NOD_3_TO_5 + BEAT_ON_NOD)
    await pilot.advance(8)
    told = pilot.feedback
    assert told.warnings == []
    assert (told.time("bml1:nod1:start"), told.time("bml1:nod1:end")) == (3.0, 5.0)
    assert told.time("bml1:beat1:stroke") == told.time("bml1:nod1:stroke")


async def test_28b_in_the_other_order_the_beat_is_placed_first_and_its_tie_to_the_nod_is_given_up(
    pilot: RealizerPilot,
) -> None:
    pilot.block("bml1", BEAT_ON_NOD + NOD_3_TO_5)
    await pilot.advance(8)
    told = pilot.feedback
    assert told.warnings == [("bml1:beat1", "IMPOSSIBLE_TO_SCHEDULE")]
    assert told.time("bml1:beat1:start") == 0.0
    assert (told.time("bml1:nod1:start"), told.time("bml1:nod1:end")) == (3.0, 5.0)


async def test_29a_a_nod_around_two_gestures_is_scheduled_if_it_comes_last(pilot: RealizerPilot) -> None:
    pilot.block("bml1", BEATS + NOD_AROUND)
    await pilot.advance(14)
    told = pilot.feedback
    assert told.warnings == []
    assert told.time("bml1:nod1:start") == 0.0
    assert told.time("bml1:g1:start") == pytest.approx(2.0)
    assert told.time("bml1:g2:start") == told.time("bml1:g1:end")
    assert told.time("bml1:nod1:end") == pytest.approx(told.time("bml1:g2:end") + 3.0)


async def test_29b_a_tie_of_the_nod_is_given_up_if_it_comes_first(pilot: RealizerPilot) -> None:
    pilot.block("bml1", NOD_AROUND + BEATS)
    await pilot.advance(14)
    told = pilot.feedback
    assert told.warnings == [("bml1:nod1", "IMPOSSIBLE_TO_SCHEDULE")]
    assert told.time("bml1:g1:start") == pytest.approx(told.time("bml1:nod1:start") + 2.0)
    assert told.time("bml1:g2:start") == told.time("bml1:g1:end")
    assert told.status("bml1") == "DONE"
