"""Free behaviors: they follow others, and behaviors that are tied to one of their points are tied to each other."""

from collections.abc import AsyncIterator

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.bml.names import BMLT
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

TRANSITION = (
    '<bmlt:transition xmlns:bmlt="http://hmi.ewi.utwente.nl/bmlt" id="f" class="SlerpTransition" start="{}" end="{}">'
    '<bmlt:parameter name="joints" value="r_shoulder r_elbow"/></bmlt:transition>'
)
FREE = ['<wait id="f" start="{}" end="{}"/>', TRANSITION]
NOD = '<head id="n" lexeme="NOD" {}/>'
SAY = '<speech id="s" start="1"><text>hello you there</text></speech>'


@pytest.fixture(params=["convex", "embr"])
async def pilot(request: pytest.FixtureRequest) -> AsyncIterator[RealizerPilot]:
    async with open_pilot(SceneOptions(voice="text", strategy=request.param, verify=True)) as pilot:
        yield pilot


@pytest.mark.parametrize("free", FREE, ids=["wait", "transition"])
@pytest.mark.parametrize("turned", [False, True], ids=["", "the other way round"])
async def test_a_behavior_at_the_end_of_a_free_one_starts_at_the_time_of_that_end(
    pilot: RealizerPilot, free: str, turned: bool
) -> None:
    parts = [free.format(1, 3), NOD.format('start="f:end+0.5"')]
    pilot.block("b", "".join(reversed(parts) if turned else parts))
    await pilot.advance(5)
    assert pilot.feedback.time("b:f:start") == 1
    assert pilot.feedback.time("b:f:end") == 3
    assert pilot.feedback.time("b:n:start") == 3.5
    assert pilot.feedback.warnings == []


@pytest.mark.parametrize("free", FREE, ids=["wait", "transition"])
async def test_an_after_constraint_on_the_end_of_a_free_behavior_applies_to_the_tied_point(
    pilot: RealizerPilot, free: str
) -> None:
    after = '<constraint><after ref="f:end+0.5"><sync ref="n:start"/></after></constraint>'
    pilot.block("b", free.format(1, 3) + NOD.format("") + after)
    await pilot.advance(5)
    assert pilot.feedback.time("b:f:end") == 3
    assert pilot.feedback.time("b:n:start") == 3.5
    assert pilot.feedback.warnings == []


@pytest.mark.parametrize("free", FREE, ids=["wait", "transition"])
async def test_two_behaviors_tied_to_one_point_of_a_free_behavior_are_tied_to_each_other(
    pilot: RealizerPilot, free: str
) -> None:
    pilot.block("b", SAY + free.format("s:end", "s:end+2") + NOD.format('end="f:start"'))
    await pilot.advance(6)
    assert pilot.feedback.time("b:n:end") == pytest.approx(pilot.feedback.time("b:s:end"))
    assert pilot.feedback.warnings == []


@pytest.mark.parametrize("free", FREE, ids=["wait", "transition"])
async def test_behaviors_at_both_ends_of_a_free_behavior_are_not_tied_to_each_other(
    pilot: RealizerPilot, free: str
) -> None:
    pilot.block("b", NOD.format('start="1"') + SAY.replace('"1"', '"4"') + free.format("n:end", "s:start"))
    await pilot.advance(7)
    assert pilot.feedback.time("b:n:start") == 1
    assert pilot.feedback.time("b:n:end") == pytest.approx(1.7)
    assert pilot.feedback.time("b:f:end") == 4
    assert pilot.feedback.warnings == []


async def test_a_behavior_at_the_end_of_a_chain_of_free_behaviors_starts_at_that_end(pilot: RealizerPilot) -> None:
    waits = '<wait id="v" start="1" end="2"/><wait id="w" start="v:end" end="v:end+1"/>'
    pilot.block("b", NOD.format('start="w:end"') + waits)
    await pilot.advance(5)
    assert pilot.feedback.time("b:n:start") == 3
    assert pilot.feedback.warnings == []


async def test_of_two_ties_of_one_point_of_a_free_behavior_the_required_one_is_kept() -> None:
    waits = '<wait id="w" start="0" duration="0.3"/><wait id="f" start="1" end="3"/>'
    meet = '<synchronize><sync ref="w:end"/><sync ref="f:start"/></synchronize>'
    async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
        pilot.block("b", f"{waits}<required><constraint>{meet}</constraint></required>")
        await pilot.advance(4)
        assert [pilot.feedback.time(point) for point in ("b:w:start", "b:w:end", "b:f:end")] == [0, 0.3, 3]
        assert pilot.feedback.time("b:f:start") == 0.3


async def test_a_free_behavior_before_an_unknown_time_plays(pilot: RealizerPilot) -> None:
    change = '<x:trajectory type="instant" targetValue="0.2"/>'
    pilot.block(
        "b",
        NOD.format("")
        + f'<x:parametervaluechange xmlns:x="{BMLT}" id="v" target="b:n" paramId="amount" start="n:start">{change}'
        "</x:parametervaluechange>"
        '<constraint><before ref="anticipators:t:one"><sync ref="v:end"/></before></constraint>',
    )
    await pilot.advance(5)
    assert pilot.feedback.status("b") == "DONE"
    assert pilot.feedback.reached("b:v:end")
    assert pilot.feedback.warnings == []
