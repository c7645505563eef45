"""Shifts of gaze and head, and gazes on top of each other (BML 1.0: gazeShift, headDirectionShift; thesis 8.7.5)."""

import math

import pytest

from reactive_realizer.embodiment.quaternion import angle
from reactive_realizer.embodiment.vector import FORWARD, subtract, unit
from reactive_realizer.testing.pilot import RealizerPilot

from .seen import EYES, FAR, GLANCE, PLATEAU, at, between, miss, place, put, sight, speeds


async def test_a_gaze_shift_stays_and_a_gaze_comes_back_to_it_by_a_saccade(pilot: RealizerPilot) -> None:
    rest, glance = put(pilot, "rest", 20, 0), put(pilot, "glance", -15, 10)
    pilot.block("b", '<gazeShift id="s" target="rest" start="0" end="0.6"/><gaze id="g" target="glance" start="2"/>')
    await pilot.advance(6)
    shown = pilot.bodies()
    relax = pilot.feedback.time("b:g:relax")
    assert miss(shown[at(pilot, 1.9)], rest) < 0.5
    assert miss(shown[at(pilot, relax - 0.1)], glance) < 0.5
    assert miss(shown[at(pilot, relax + 0.2)], rest) < 0.5
    assert miss(shown[-1], rest) < 0.5
    assert between(sight(shown[-1], "skullbase"), sight(shown[at(pilot, 1.9)], "skullbase")) < 1.5
    assert max(speeds(shown)) < PLATEAU + 0.2
    assert not pilot.feedback.warnings


async def test_a_glance_of_the_eyes_leaves_the_head_to_the_gaze_below(pilot: RealizerPilot) -> None:
    put(pilot, "rest", 25, 0)
    glance = put(pilot, "glance", 5, 0)
    gaze = '<gaze id="g" target="glance" influence="EYES" start="2" end="3"/>'
    pilot.block("b", f'<gazeShift id="s" target="rest" start="0" end="0.6"/>{gaze}')
    await pilot.advance(4)
    shown = pilot.bodies()
    assert miss(shown[at(pilot, 2.5)], glance) < 0.5
    noses = [sight(body, "skullbase") for body in shown[at(pilot, 1.5) :]]
    assert max(between(nose, noses[0]) for nose in noses) < 1.5


async def test_the_later_shift_stays_until_a_block_replaces_everything(pilot: RealizerPilot) -> None:
    put(pilot, "one", 20, 0)
    two = put(pilot, "two", -20, 0)
    pilot.block("a", '<gazeShift id="s" target="one" start="0" end="0.5"/>')
    await pilot.advance(1)
    pilot.block("b", '<gazeShift id="s" target="two" start="0" end="0.5"/>')
    await pilot.advance(2)
    assert miss(pilot.bodies()[-1], two) < 0.5
    assert not pilot.feedback.warnings
    pilot.block("c", composition="REPLACE")
    await pilot.advance(2)
    assert between(sight(pilot.bodies()[-1]), FORWARD) < 2 + GLANCE
    assert max(speeds(pilot.bodies())) < PLATEAU + 0.2


async def test_a_shift_of_the_eyes_alone_leaves_the_head(pilot: RealizerPilot) -> None:
    target = put(pilot, "t", 20, 0)
    pilot.block("b", '<gazeShift id="s" target="t" influence="EYES" start="0"/>')
    await pilot.advance(2)
    assert miss(pilot.bodies()[-1], target) < 0.5
    assert between(sight(pilot.bodies()[-1], "skullbase"), FORWARD) < 2


async def test_a_shift_of_the_head_direction_leaves_the_eyes(pilot: RealizerPilot) -> None:
    target = put(pilot, "t", 35, 10, FAR)
    pilot.block("b", '<headDirectionShift id="s" target="t" start="0" end="0.8"/>')
    await pilot.advance(3)
    body = pilot.bodies()[-1]
    toward = unit(subtract(target, place(pilot, 0, 0, 0.0)))
    assert between(sight(body, "skullbase"), toward) < 2
    assert math.degrees(angle(body.rotation(EYES[0]))) < GLANCE
    assert not pilot.feedback.warnings


async def test_a_gaze_overrides_a_head_direction_until_it_ends(pilot: RealizerPilot) -> None:
    put(pilot, "side", 35, 0, FAR)
    front = put(pilot, "front", 0, 0)
    pilot.block("b", '<headDirectionShift id="s" target="side" start="0" end="0.8"/>')
    pilot.block("c", '<gaze id="g" target="front" influence="EYES" start="2" end="4"/>')
    await pilot.advance(3)
    assert miss(pilot.bodies()[-1], front) < 0.5
    assert between(sight(pilot.bodies()[-1], "skullbase"), FORWARD) > 30
    await pilot.advance(2)
    assert math.degrees(angle(pilot.bodies()[-1].rotation(EYES[0]))) < GLANCE


async def test_the_latest_shift_of_head_or_gaze_has_the_head(pilot: RealizerPilot) -> None:
    for name, yaw in (("first", 30), ("second", 5), ("third", -25)):
        put(pilot, name, yaw, 0, FAR)
    shifts = (
        '<headDirectionShift id="a" target="first" start="0" end="0.6"/>'
        '<gazeShift id="b" target="second" start="1" end="1.6"/>'
        '<headDirectionShift id="c" target="third" start="2" end="2.6"/>'
    )
    pilot.block("b", shifts)
    await pilot.advance(4)
    shown = pilot.bodies()
    heads = [sight(shown[at(pilot, time)], "skullbase") for time in (0.95, 1.95, 3.9)]
    # The eyes do their part of the gaze shift.
    assert [math.degrees(math.atan2(x, z)) for x, _, z in heads] == pytest.approx([30, 4.5, -25], abs=3)
    assert between(sight(shown[-1]), unit(subtract(place(pilot, 5, 0, FAR), place(pilot, 0, 0, 0.0)))) < 0.5
    assert max(speeds(shown, "skullbase")) < 3


async def test_the_head_may_be_turned_while_the_eyes_look_at_something(pilot: RealizerPilot) -> None:
    front = put(pilot, "front", 5, 0)
    put(pilot, "side", -25, 0)
    shift = '<headDirectionShift id="s" target="side" start="1" end="2"/>'
    pilot.block("b", f'<gaze id="g" target="front" start="0" end="4"/>{shift}')
    await pilot.advance(1.9)
    shown = pilot.bodies()
    assert max(miss(body, front) for body in shown[at(pilot, 0.6) :]) < 0.5
    assert between(sight(shown[-1], "skullbase"), FORWARD) > 20
    assert not pilot.feedback.warnings
