"""Single glances aside (``rr:glance``), in frames."""

import pytest

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import rotation_vector
from reactive_realizer.testing.pilot import RealizerPilot

from .seen import EYES, PLATEAU, at, between, miss, put, sight, speeds

OWN = 'xmlns:rr="urn:reactive-realizer:1"'


def eyes(body: Body) -> tuple[float, float]:
    """How far the left eye is turned to the left and up in the head, rad."""
    down, left, _ = rotation_vector(body.rotation(EYES[0]))
    return left, -down


@pytest.mark.parametrize(("left", "up"), [(10, 0), (-10, 0), (0, 8), (0, -8), (-6, 5)])
async def test_a_glance_turns_the_eyes_aside_and_back_and_leaves_the_head(
    pilot: RealizerPilot, left: float, up: float
) -> None:
    put(pilot, "t", 10, 0)
    pilot.block("a", '<gaze id="g" target="t" influence="EYES" start="0" end="9"/>')
    await pilot.advance(1)
    pilot.block("b", f'<rr:glance {OWN} id="g" left="{left}" up="{up}" start="0.5" end="1"/>')
    await pilot.advance(3)
    shown, start, end = pilot.bodies(), *(at(pilot, pilot.feedback.time(f"b:g:{point}")) for point in ("start", "end"))
    before, aside, after = eyes(shown[start - 2]), eyes(shown[end - 2]), eyes(shown[end + 8])
    for number, turn in enumerate((left, up)):
        assert aside[number] - before[number] == pytest.approx(turn * 0.01745, abs=0.01)
        assert after[number] == pytest.approx(before[number], abs=0.005)
    assert between(sight(shown[start], "skullbase"), sight(shown[end], "skullbase")) < 1.0
    assert max(speeds(shown)) < PLATEAU
    assert pilot.feedback.warnings == []


async def test_eyes_are_aside_of_a_target_after_one_saccade_and_back_on_it_after_another(pilot: RealizerPilot) -> None:
    target = put(pilot, "t", 0, 0)
    pilot.block("a", '<gaze id="g" target="t" start="0" end="9"/>')
    await pilot.advance(2)
    pilot.block("b", f'<rr:glance {OWN} id="g" left="8" up="0" start="0" end="0.5"/>')
    await pilot.advance(2)
    start = at(pilot, pilot.feedback.time("b:g:start"))
    misses = [miss(body, target) for body in pilot.bodies()]
    assert misses[start - 2] < 0.5
    assert min(misses[start + 4 : start + 24]) > 7.0
    assert max(misses[start + 30 :]) < 0.5


async def test_a_glance_without_times_lasts_about_as_long_as_a_fixation(pilot: RealizerPilot) -> None:
    pilot.block("b", f'<rr:glance {OWN} id="g" left="8" up="0"/>')
    await pilot.advance(1)
    assert pilot.feedback.time("b:g:end") - pilot.feedback.time("b:g:start") == pytest.approx(0.3, abs=0.011)


async def test_eyes_turn_no_further_than_they_can(pilot: RealizerPilot) -> None:
    put(pilot, "t", 30, 0)
    pilot.block("a", '<gaze id="g" target="t" influence="EYES" start="0" end="9"/>')
    pilot.block("b", f'<rr:glance {OWN} id="g" left="40" up="0" start="1" end="2"/>')
    await pilot.advance(3)
    assert max(eyes(body)[0] for body in pilot.bodies()) < 0.72
