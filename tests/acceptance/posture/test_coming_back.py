"""What a shift has covered comes back when it ends, and what joins late comes in: by easing, and on its feet."""

from itertools import pairwise

import numpy as np
import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.vector import distance
from reactive_realizer.testing.pilot import open_pilot

from .soles import FRAME, heights, slides, speeds
from .standing import CROSSED, SIT, STAND, body, crossed, sits

OPEN = f'{STAND}<pose part="LEGS" lexeme="LEGS_OPEN"/>'
CROSSED_LEGS = f'{STAND}<pose part="LEGS" lexeme="LEGS_CROSSED"/>'
LEANING = f'{STAND}<pose part="WHOLEBODY" lexeme="LEANING_FORWARD"/>'
UNHURRIED = 1.2
"""m/s of a pelvis that nobody hurries."""


def root_speeds(pilot):
    """How fast the root goes from each frame to the next, m/s."""
    return np.array([distance(a.root, b.root) for a, b in pairwise(pilot.bodies())]) / FRAME


def jolts(pilot):
    """By how much the speed of the root changes from frame to frame, m/s."""
    return np.abs(np.diff(root_speeds(pilot)))


async def shifted(pilot, below: str, above: str) -> float:
    """When a shift has ended above a posture that goes on."""
    pilot.block("a", f'<posture id="p" start="0" end="12">{below}</posture>')
    await pilot.advance(4)
    pilot.block("b", f'<postureShift id="s" start="0" end="2">{above}</postureShift>')
    await pilot.advance(5)
    assert pilot.feedback.warnings == []
    return pilot.feedback.time("b:s:end")


# --- what a shift has covered


async def test_who_got_up_by_a_shift_while_he_was_to_sit_sits_down_again_and_does_not_fall(either) -> None:
    end = await shifted(either, SIT, STAND)
    assert not sits(body(either, end))
    assert root_speeds(either).max() < UNHURRIED
    assert jolts(either).max() < 0.05
    assert sits(body(either, 8.9))


@pytest.mark.parametrize("legs", [OPEN, CROSSED_LEGS])
async def test_the_feet_step_back_to_where_a_posture_wants_them(either, legs) -> None:
    await shifted(either, legs, STAND)
    wide, narrow, again = (body(either, time).place("l_ankle").position for time in (3.9, 6.0, 8.9))
    assert distance(wide, narrow) > 0.05
    assert distance(wide, again) < 0.005
    assert slides(either.bodies()).max() < 0.1
    assert heights(either.bodies()).min() > -0.001


async def test_arms_that_a_shift_has_let_down_cross_again_without_a_flick(either) -> None:
    await shifted(either, STAND + CROSSED, STAND)
    assert [crossed(body(either, time)) for time in (3.9, 6.0, 8.9)] == [True, False, True]
    ways = np.linalg.norm(np.diff(either.path("r_wrist"), axis=0), axis=1)
    assert np.abs(np.diff(ways)).max() / FRAME < 0.25


@pytest.mark.parametrize("shift", [LEANING, STAND])
async def test_a_shift_that_began_together_with_the_posture_below_it_leaves_it_in_the_same_way(either, shift) -> None:
    either.block(
        "b", f'<posture id="p" start="0" end="5">{CROSSED_LEGS}</posture><postureShift id="s">{shift}</postureShift>'
    )
    await either.advance(6)
    assert slides(either.bodies()).max() < 0.1
    assert speeds(either.bodies()).max() < 2.5


async def test_who_has_got_up_in_a_hurry_does_not_sink_again(either) -> None:
    """To stand is to take the place of sitting, which is left in its own time."""
    either.block("a", f'<postureShift id="s">{SIT}</postureShift>')
    await either.advance(3)
    either.block("b", f'<postureShift id="s" start="0" end="0.6">{OPEN}</postureShift>', composition="REPLACE")
    await either.advance(3)
    heights_of_root = [shown.root[1] for shown in either.bodies()]
    assert min(heights_of_root[185:]) > heights_of_root[-1] - 0.01


async def test_who_is_getting_up_is_not_thrown_when_everything_is_replaced_again(either) -> None:
    either.block("a", f'<postureShift id="s">{SIT}</postureShift>')
    await either.advance(3)
    either.block("b", f'<postureShift id="s" start="0.1" end="0.3">{CROSSED}</postureShift>', composition="REPLACE")
    await either.advance(0.6)
    either.block("c", composition="REPLACE")
    await either.advance(3)
    assert jolts(either).max() < 0.05


# --- what joins late


async def late(pilot, kind: str, stance: str, begun: float = 1.0) -> None:
    """A posture whose start has passed by as much."""
    pilot.predict("t", "hit", 1.0)
    await pilot.advance(1.0 + begun)
    pilot.block("b", f'<{kind} id="p" start="anticipators:t:hit">{stance}</{kind}>')
    await pilot.advance(4)
    assert pilot.feedback.time("b:p:start") == 1.0
    assert pilot.feedback.warnings == []


@pytest.mark.parametrize("begun", [0.3, 1.5])
@pytest.mark.parametrize("legs", [OPEN, CROSSED_LEGS])
async def test_the_feet_step_into_a_posture_that_joins_late(either, legs, begun) -> None:
    await late(either, "posture", legs, begun)
    assert slides(either.bodies()).max() < 0.1
    assert heights(either.bodies()).min() > -0.001


@pytest.mark.parametrize("begun", [0.5, 1.0, 1.5])
@pytest.mark.parametrize("kind", ["posture", "postureShift"])
async def test_who_is_late_to_sit_down_does_not_fall_onto_the_seat(either, kind, begun) -> None:
    await late(either, kind, SIT, begun)
    assert root_speeds(either).max() < UNHURRIED
    assert jolts(either).max() < 0.15
    lowest = min(b.root[1] for b in either.bodies())
    assert lowest == pytest.approx(body(either, 4.5).root[1], abs=0.01)


async def test_whoever_looks_later_at_a_posture_that_began_in_time_sees_all_of_it() -> None:
    async with open_pilot(SceneOptions(voice="text")) as pilot:
        pilot.block("b", f'<posture id="p" start="0" end="9">{SIT}</posture>')
        await pilot.advance(4)
        pilot.watch()
        await pilot.advance(0.1)
        assert sits(pilot.bodies()[0])


async def test_nor_does_who_is_to_sit_down_in_no_time(either) -> None:
    """A shift that starts and ends between two frames is never shown, and yet stays."""
    either.predict("t", "hit", 1.01)
    either.block("b", f'<postureShift id="s" start="1.005" end="anticipators:t:hit">{SIT}</postureShift>')
    await either.advance(4)
    assert root_speeds(either).max() < UNHURRIED
    assert sits(body(either, 3.9))
