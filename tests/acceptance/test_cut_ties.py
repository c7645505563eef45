"""Warnings about ties to interrupted points name the point as it is written in BML."""

from typing import Any

import pytest

from reactive_realizer.testing.pilot import RealizerPilot

from .living_time import after, nod, synchronize, texts

# Of a nod that nothing stretches strokeEnd, relax and end are one peg.
LATE = nod("late", start="1")


@pytest.mark.parametrize("stop", ["", 'include="late"'])
@pytest.mark.parametrize("sync", ["strokeEnd", "relax", "end"])
async def test_a_cut_point_of_another_block_is_named(pilot: RealizerPilot, sync: str, stop: str) -> None:
    pilot.block("t", LATE + '<wait id="w" duration="9"/>')
    pilot.block("b", nod("n", start=f"t:late:{sync}+1"))
    await pilot.advance(1.1)
    pilot.block("stop", f'<bmla:interrupt id="i" target="t" {stop}/>')
    await pilot.tick()
    assert [f"t:late:{sync} was interrupted" in said for said in texts(pilot)] == [True]


@pytest.mark.parametrize("sync", ["strokeEnd", "relax", "end"])
async def test_a_point_of_a_block_that_was_revoked_is_named(pilot: RealizerPilot, sync: str) -> None:
    pilot.block("first", '<wait id="w" duration="9"/>')
    pilot.block("l", nod("n"), composition="APPEND")
    pilot.block("b", nod("m", start=f"l:n:{sync}") + nod("o", start="m:end"))
    await pilot.advance(0.1)
    pilot.block("stop", **{"bmla:interrupt": "l"})
    await pilot.tick()
    assert [f"it depends on l:n:{sync}, which will never come" in said for said in texts(pilot)] == [True, True]


@pytest.mark.parametrize("tied", ["{}", "b:{}"])
@pytest.mark.parametrize("sync", ["strokeEnd", "relax", "end"])
async def test_a_cut_point_of_the_same_block_is_named(pilot: RealizerPilot, sync: str, tied: str) -> None:
    pilot.block("b", LATE + nod("n", start=tied.format(f"late:{sync}")))
    await pilot.advance(1.1)
    pilot.block("stop", '<bmla:interrupt id="i" target="b" include="late"/>')
    await pilot.tick()
    assert [f"b:late:{sync} was interrupted" in said for said in texts(pilot)] == [True]


async def test_a_cut_point_is_named_although_a_playing_behavior_shares_its_time(pilot: RealizerPilot) -> None:
    speech = '<speech id="s"><text>one two three <sync id="m"/>four</text></speech>'
    pilot.block("b", speech + nod("n", start="s:m") + nod("o", start="n:start"))
    await pilot.advance(0.1)
    pilot.block("stop", '<bmla:interrupt id="i" target="b" include="n"/>')
    await pilot.tick()
    assert ["b:n:start was interrupted" in said for said in texts(pilot)] == [True]


@pytest.mark.parametrize("constraint", [synchronize("n:start", "t:late:end"), after("t:late:end", "n:start")])
async def test_a_cut_point_in_a_constraint_is_named(pilot: RealizerPilot, constraint: Any) -> None:
    pilot.block("t", LATE)
    pilot.block("b", nod("n") + constraint)
    await pilot.advance(1.1)
    pilot.block("stop", **{"bmla:interrupt": "t"})
    await pilot.tick()
    assert ["t:late:end was interrupted" in said for said in texts(pilot)] == [True]


async def test_a_behavior_tied_to_a_point_reached_at_the_interruption_gets_no_warning(pilot: RealizerPilot) -> None:
    speech = '<speech id="s"><text>one two <sync id="m"/>three four five six</text></speech>'
    pilot.block("b", speech + nod("n", start="s:m+0.5"))
    pilot.block("stop", '<bmla:interrupt id="i" target="b" include="s" start="b:s:m"/>')
    await pilot.advance(3)
    assert texts(pilot) == []
    assert pilot.feedback.time("b:n:start") == pytest.approx(pilot.feedback.time("b:s:m") + 0.5)


async def test_a_playing_behavior_keeps_its_predicted_end_when_it_was_tied_to_a_revoked_block(
    pilot: RealizerPilot,
) -> None:
    pilot.block("first", '<wait id="w" duration="1"/>')
    pilot.block("l", nod("n"), **{"bmla:appendAfter": "first"})
    pilot.block("b", '<gaze id="g" target="bluebox" start="0" end="l:n:end+1"/>')
    await pilot.advance(0.5)
    expected = pilot.feedback.predicted("b:g:end")
    pilot.block("stop", '<bmla:interrupt id="i" target="l"/>')
    await pilot.advance(4)
    assert ["l:n:end was interrupted" in said for said in texts(pilot)] == [True]
    assert pilot.feedback.time("b:g:end") == pytest.approx(expected)
