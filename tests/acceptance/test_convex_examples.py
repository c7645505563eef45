"""The scheduling examples of the thesis (7.1.3, 7.2.2) as BML, in any order, with the default strategy."""

from collections.abc import AsyncIterator

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .scheduling_examples import BEAT_ON_NOD, BEATS, NOD_3_TO_5, NOD_AROUND, NOD_ON_SPEECH, SPEECH

PAINTING = '<speech id="speech1"><text>As you can see <sync id="s1"/>on this painting.</text></speech>'
POINT = '<gesture id="point1" lexeme="BEAT" stroke="speech1:s1"/>'
WALK = '<wait id="walk1" duration="{}"/>'
AFTER = """
<constraint><after ref="walk1:end"><sync ref="point1:start"/></after></constraint>
<constraint><after ref="2"><sync ref="speech1:start"/></after></constraint>
"""


@pytest.fixture
async def pilot() -> AsyncIterator[RealizerPilot]:
    async with open_pilot(SceneOptions(voice="text", strategy="convex")) as pilot:
        yield pilot


@pytest.mark.parametrize("order", [1, -1], ids=["a", "b"])
@pytest.mark.parametrize(("walk", "first"), [(1.0, "speech1"), (6.0, "point1")])
async def test_26_speech_and_pointing_start_as_early_as_their_after_constraints_allow(
    pilot: RealizerPilot, order: int, walk: float, first: str
) -> None:
    pilot.block("bml1", "".join([PAINTING, POINT, WALK.format(walk), AFTER][::order]))
    await pilot.advance(12)
    told = pilot.feedback
    assert told.warnings == []
    assert told.time("bml1:point1:stroke") == told.time("bml1:speech1:s1")
    assert told.time("bml1:walk1:start") == 0.0
    reached = {"speech1": 2.0, "point1": walk}
    for id_, earliest in reached.items():
        start = told.time(f"bml1:{id_}:start")
        assert start == pytest.approx(earliest) if id_ == first else start >= earliest - 1e-9


@pytest.mark.parametrize("order", [1, -1], ids=["a", "b"])
async def test_27_a_nod_is_timed_by_the_words_that_it_is_tied_to(pilot: RealizerPilot, order: int) -> None:
    pilot.block("bml1", "".join([SPEECH, NOD_ON_SPEECH][::order]))
    await pilot.advance(5)
    told = pilot.feedback
    assert told.warnings == []
    assert told.time("bml1:nod1:start") == told.time("bml1:speech1:start") == 0.0
    assert told.time("bml1:nod1:end") == told.time("bml1:speech1:sync1") > 0.2


@pytest.mark.parametrize("order", [1, -1], ids=["a", "b"])
async def test_28_a_beat_on_the_stroke_of_a_nod_follows_it(pilot: RealizerPilot, order: int) -> None:
    pilot.block("bml1", "".join([NOD_3_TO_5, BEAT_ON_NOD][::order]))
    await pilot.advance(8)
    told = pilot.feedback
    assert told.warnings == []
    assert (told.time("bml1:nod1:start"), told.time("bml1:nod1:end")) == (3.0, 5.0)
    assert told.time("bml1:beat1:stroke") == told.time("bml1:nod1:stroke")


@pytest.mark.parametrize("order", [1, -1], ids=["a", "b"])
async def test_29_a_nod_around_two_gestures_is_scheduled_without_losses(pilot: RealizerPilot, order: int) -> None:
    pilot.block("bml1", "".join([BEATS, NOD_AROUND][::order]))
    await pilot.advance(14)
    told = pilot.feedback
    assert told.warnings == []
    assert told.time("bml1:nod1:start") == 0.0
    assert told.time("bml1:g1:start") == pytest.approx(2.0)
    assert told.time("bml1:g2:start") == told.time("bml1:g1:end")
    assert told.time("bml1:nod1:end") == pytest.approx(told.time("bml1:g2:end") + 3.0)
    assert told.time("bml1:g1:end") - told.time("bml1:g1:start") > 0.5
