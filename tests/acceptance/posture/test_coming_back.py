"""Postures that become visible again after a shift, and postures in no time."""

from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.vector import distance
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .soles import FRAME, heights, slides, speeds
from .standing import CROSSED, SIT, STAND, body, crossed, sits

OPEN = f'{STAND}<pose part="LEGS" lexeme="LEGS_OPEN"/>'
CROSSED_LEGS = f'{STAND}<pose part="LEGS" lexeme="LEGS_CROSSED"/>'
LEANING = f'{STAND}<pose part="WHOLEBODY" lexeme="LEANING_FORWARD"/>'
UNHURRIED = 1.2
"""Speed limit of a pelvis in an unhurried change of stance, m/s."""


def root_speeds(pilot: RealizerPilot) -> NDArray[np.float64]:
    """The speed of the root from each frame to the next, m/s."""
    return np.array([distance(a.root, b.root) for a, b in pairwise(pilot.bodies())]) / FRAME


def jolts(pilot: RealizerPilot) -> NDArray[np.float64]:
    """By how much the speed of the root changes from frame to frame, m/s."""
    return np.abs(np.diff(root_speeds(pilot)))


async def shifted(pilot: RealizerPilot, below: str, above: str) -> float:
    """When a shift has ended above a posture that goes on."""
    pilot.block("a", f'<posture id="p" start="0" end="12">{below}</posture>')
    await pilot.advance(4)
    pilot.block("b", f'<postureShift id="s" start="0" end="2">{above}</postureShift>')
    await pilot.advance(5)
    assert pilot.feedback.warnings == []
    return pilot.feedback.time("b:s:end")


# --- what a shift has covered


async def test_a_figure_that_got_up_by_a_shift_sits_down_again_smoothly(
    either: RealizerPilot,
) -> None:
    end = await shifted(either, SIT, STAND)
    assert not sits(body(either, end))
    assert root_speeds(either).max() < UNHURRIED
    assert jolts(either).max() < 0.05
    assert sits(body(either, 8.9))


@pytest.mark.parametrize("legs", [OPEN, CROSSED_LEGS])
async def test_the_feet_step_back_to_the_place_of_a_posture(alternating: RealizerPilot, legs: str) -> None:
    await shifted(alternating, legs, STAND)
    wide, narrow, again = (body(alternating, time).transform("l_ankle").position for time in (3.9, 6.0, 8.9))
    assert distance(wide, narrow) > 0.05
    assert distance(wide, again) < 0.005
    assert slides(alternating.bodies()).max() < 0.1
    assert heights(alternating.bodies()).min() > -0.001


async def test_arms_that_a_shift_has_lowered_cross_again_smoothly(either: RealizerPilot) -> None:
    await shifted(either, STAND + CROSSED, STAND)
    assert [crossed(body(either, time)) for time in (3.9, 6.0, 8.9)] == [True, False, True]
    ways = np.linalg.norm(np.diff(either.path("r_wrist"), axis=0), axis=1)
    assert np.abs(np.diff(ways)).max() / FRAME < 0.25


@pytest.mark.parametrize("shift", [LEANING, STAND])
async def test_a_shift_that_starts_with_the_posture_below_uncovers_it_in_the_same_way(
    alternating: RealizerPilot, shift: Any
) -> None:
    alternating.block(
        "b", f'<posture id="p" start="0" end="5">{CROSSED_LEGS}</posture><postureShift id="s">{shift}</postureShift>'
    )
    await alternating.advance(6)
    assert slides(alternating.bodies()).max() < 0.1
    assert speeds(alternating.bodies()).max() < 2.5


async def test_a_figure_that_got_up_quickly_does_not_sink_again(either: RealizerPilot) -> None:
    """Standing replaces sitting, which takes its own time to end."""
    either.block("a", f'<postureShift id="s">{SIT}</postureShift>')
    await either.advance(3)
    either.block("b", f'<postureShift id="s" start="0" end="0.6">{OPEN}</postureShift>', composition="REPLACE")
    await either.advance(3)
    heights_of_root = [shown.root[1] for shown in either.bodies()]
    assert min(heights_of_root[185:]) > heights_of_root[-1] - 0.01


async def test_replacing_everything_while_getting_up_causes_no_jump(either: RealizerPilot) -> None:
    either.block("a", f'<postureShift id="s">{SIT}</postureShift>')
    await either.advance(3)
    either.block("b", f'<postureShift id="s" start="0.1" end="0.3">{CROSSED}</postureShift>', composition="REPLACE")
    await either.advance(0.6)
    either.block("c", composition="REPLACE")
    await either.advance(3)
    assert jolts(either).max() < 0.05


async def test_a_posture_that_started_in_time_is_complete_in_a_later_first_frame() -> None:
    async with open_pilot(SceneOptions(voice="text")) as pilot:
        pilot.block("b", f'<posture id="p" start="0" end="9">{SIT}</posture>')
        await pilot.advance(4)
        pilot.watch()
        await pilot.advance(0.1)
        assert sits(pilot.bodies()[0])


async def test_sitting_down_in_no_time_is_no_fall_either(either: RealizerPilot) -> None:
    """A shift that starts and ends between two frames is never shown, and yet stays."""
    either.predict("t", "hit", 1.01)
    either.block("b", f'<postureShift id="s" start="1.005" end="anticipators:t:hit">{SIT}</postureShift>')
    await either.advance(4)
    assert root_speeds(either).max() < UNHURRIED
    assert sits(body(either, 3.9))
