"""Saccades start at the times of pegs, independently of frames (thesis 4.2.2)."""

import math

import pytest

from reactive_realizer.engines.animation.gaze.eye_controller import saccade_progress
from reactive_realizer.testing.pilot import RealizerPilot

from .seen import FAR, FRAME, at, leaving, put, sight

ODD = [0.0, 0.003, 0.0081, 0.013, 0.017]
"""s between a peg and the frame before it."""


@pytest.mark.parametrize("later", ODD)
@pytest.mark.parametrize("element", ["gaze", "gazeShift"])
async def test_a_saccade_starts_at_the_time_of_the_start_and_not_with_a_frame(
    pilot: RealizerPilot, element: str, later: float
) -> None:
    put(pilot, "t", 25, 5, FAR)
    pilot.block("b", f'<{element} id="g" target="t" start="{0.5 + later}" end="3"/>')
    await pilot.advance(1.2)
    assert pilot.feedback.time("b:g:start") == pytest.approx(0.6 + later)
    assert leaving(pilot, 1.0) == pytest.approx(0.6 + later, abs=5e-4)


@pytest.mark.parametrize("later", ODD)
async def test_eyes_return_at_the_time_of_relax(pilot: RealizerPilot, later: float) -> None:
    put(pilot, "rest", -10, 0, FAR)
    put(pilot, "t", 20, 5, FAR)
    glance = f'<gaze id="g" target="t" influence="EYES" start="1" relax="{2 + later}" end="3"/>'
    pilot.block("b", f'<gazeShift id="s" target="rest" influence="EYES" start="0" end="0.5"/>{glance}')
    await pilot.advance(2.6)
    assert pilot.feedback.time("b:g:relax") == pytest.approx(2.1 + later)
    assert leaving(pilot, 2.5) == pytest.approx(2.1 + later, abs=5e-4)


@pytest.mark.parametrize("later", ODD)
async def test_eyes_return_at_the_time_of_an_interruption(pilot: RealizerPilot, later: float) -> None:
    put(pilot, "rest", -10, 0, FAR)
    put(pilot, "t", 20, 5, FAR)
    pilot.block("a", '<gazeShift id="s" target="rest" influence="EYES" start="0" end="0.5"/>')
    pilot.block("b", '<gaze id="g" target="t" influence="EYES" start="1" end="6"/>')
    pilot.block("c", f'<bmla:interrupt id="i" target="b" start="{2 + later}"/>')
    await pilot.advance(2.6)
    assert pilot.feedback.time("b:g:end") == pytest.approx(2.1 + later)
    assert leaving(pilot, 2.5) == pytest.approx(2.1 + later, abs=5e-4)


@pytest.mark.parametrize("later", [0.0, 0.01])
async def test_eyes_return_at_the_tick_in_which_a_block_replaces_everything(still: RealizerPilot, later: float) -> None:
    await still.advance(0.02)
    put(still, "t", 20, 5, FAR)
    still.block("b", '<gazeShift id="s" target="t" influence="EYES" start="0" end="0.5"/>')
    await still.advance(0.98 + later)
    still.block("c", composition="REPLACE")
    await still.advance(0.5)
    assert leaving(still, 1.4) == pytest.approx(1.0 + later, abs=5e-4)


async def test_a_saccade_to_a_new_target_starts_from_the_current_eyes(
    pilot: RealizerPilot,
) -> None:
    put(pilot, "one", -30, 0, FAR)
    put(pilot, "two", 30, 0, FAR)
    shift = '<gazeShift id="{}" target="{}" influence="EYES" start="{}" end="{}"/>'
    pilot.block("b", shift.format("one", "one", 0.503, 0.53) + shift.format("two", "two", 0.531, 1))
    await pilot.advance(1.2)
    one, two = (pilot.feedback.time(f"b:{id_}:start") for id_ in ("one", "two"))
    yaws = [math.degrees(math.atan2(x, z)) for x, _, z in map(sight, pilot.bodies())]
    first = yaws[at(pilot, one)]
    middle = first - (30.0 + first) * saccade_progress(math.radians(30.0 + first), two - one)
    amplitude = 30.0 - middle
    after = [number for number in range(len(yaws)) if number * FRAME >= two]
    law = [30.0 - amplitude * (1 - saccade_progress(math.radians(amplitude), number * FRAME - two)) for number in after]
    assert -8.0 < middle < -4.0
    assert [yaws[number] for number in after] == pytest.approx(law, abs=0.05)
