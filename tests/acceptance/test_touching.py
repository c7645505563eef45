"""Hands that touch, take and put down targets, from BML to frames."""

import math
from collections.abc import AsyncIterator

import numpy as np
import numpy.typing as npt
import pytest

from reactive_realizer.bml.names import BMLA, OWN
from reactive_realizer.embodiment.quaternion import angle, conjugate, from_axis_angle, multiply, rotate
from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.testing.pilot import RealizerPilot

from .conftest import OpenStill

NEAR = 0.01
BOX = (-0.2, 1.15, 0.4)
HIGH = (-0.3, 1.4, 0.35)


@pytest.fixture(params=["female", "male"])
async def pilot(request: pytest.FixtureRequest, open_still: OpenStill) -> AsyncIterator[RealizerPilot]:
    async with open_still(avatar=request.param) as pilot:
        pilot.move("box", BOX)
        yield pilot


def reach(action: str, attributes: str = "", target: str = "box") -> str:
    return f'<pointing xmlns:rr="{OWN}" id="p" target="{target}" rr:reach="{action}" {attributes}/>'


def gaps(pilot: RealizerPilot, side: str, target: Vec3, first: float, last: float) -> npt.NDArray[np.float64]:
    """Distances of the tip of a middle finger from a target in the frames between two times, m."""
    times = [frame.time for frame in pilot.frames["alice"]]
    shown = [body for time, body in zip(times, pilot.bodies(), strict=True) if first <= time <= last]
    joints = [[np.array(body.transform(f"{side}_middle{i}").position) for i in (2, 3)] for body in shown]
    return np.array([np.linalg.norm(2.0 * outer - inner - target) for inner, outer in joints])


def box(pilot: RealizerPilot) -> Vec3:
    position = pilot.realizer.world.position("box")
    assert position is not None
    return position


def holder(pilot: RealizerPilot) -> Vec3:
    return pilot.bodies()[-1].transform("r_middle3").position


async def test_the_fingertips_of_the_nearer_hand_stay_at_the_target(pilot: RealizerPilot) -> None:
    pilot.block("b", reach("touch", 'ready="1" relax="2"'))
    await pilot.advance(3)
    assert gaps(pilot, "r", BOX, 1.0, 2.0).max() < NEAR
    assert gaps(pilot, "l", BOX, 0.0, 3.0).min() > 0.3
    assert pilot.feedback.warnings == []


async def test_the_mode_chooses_the_hand(pilot: RealizerPilot) -> None:
    pilot.block("b", reach("TOUCH", 'mode="LEFT_HAND" ready="1" relax="2"', "0.1 1.2 0.35"))
    await pilot.advance(2)
    assert gaps(pilot, "l", (0.1, 1.2, 0.35), 1.0, 2.0).max() < NEAR


async def test_they_follow_a_target_that_moves(pilot: RealizerPilot) -> None:
    pilot.block("b", reach("touch", 'ready="1" relax="3"'))
    for step in range(100):
        share = max(0.0, min(1.0, (step - 60) / 30))
        pilot.move("box", (BOX[0] - 0.1 * share, BOX[1] + 0.1 * share, BOX[2]))
        await pilot.advance(0.03)
    assert gaps(pilot, "r", box(pilot), 2.8, 3.0).max() < NEAR
    assert pilot.feedback.warnings == []


async def test_a_hand_goes_as_near_as_it_can_and_a_warning_says_how_far_the_target_is(pilot: RealizerPilot) -> None:
    pilot.block("b", reach("touch", 'mode="RIGHT_HAND" ready="1" relax="2"', "-0.2 1.3 1.6"))
    await pilot.advance(3)
    (warning,) = pilot.feedback.of("warningFeedback")
    assert "the right hand does not reach '-0.2 1.3 1.6': it is" in warning.text
    near = gaps(pilot, "r", (-0.2, 1.3, 1.6), 1.2, 2.0)
    assert near.max() < gaps(pilot, "r", (-0.2, 1.3, 1.6), 0.0, 0.1).min() - 0.3


async def test_a_target_that_is_taken_follows_the_hand_when_it_has_arrived(pilot: RealizerPilot) -> None:
    pilot.block("b", reach("take", 'ready="1" relax="1.4" end="2.5"'))
    await pilot.advance(0.95)
    assert box(pilot) == BOX
    await pilot.advance(0.3)
    assert np.linalg.norm(np.subtract(box(pilot), BOX)) < 0.05
    await pilot.advance(2)
    assert np.linalg.norm(np.subtract(box(pilot), holder(pilot))) < NEAR
    assert box(pilot)[1] < BOX[1] - 0.2
    assert pilot.feedback.warnings == []


async def test_what_a_hand_carries_stays_where_it_is_put(pilot: RealizerPilot) -> None:
    pilot.block("b", reach("take", 'mode="RIGHT_HAND"'))
    pilot.block("c", reach("put", 'mode="RIGHT_HAND"', "-0.3 1.2 0.3"), composition="APPEND")
    await pilot.advance(8)
    assert pilot.feedback.status("c") == "DONE"
    assert box(pilot) == (-0.3, 1.2, 0.3)


async def test_it_may_be_taken_and_put_down_in_one_block_after_a_walk(pilot: RealizerPilot) -> None:
    pilot.move("box", (0.0, 1.1, 1.5))
    take = reach("take", 'mode="RIGHT_HAND" start="w:end"')
    put = reach("put", 'mode="RIGHT_HAND" start="p:end"', "0.1 1 1.4").replace('id="p"', 'id="q"')
    walk = '<locomotion id="w" target="box"><bmlt:parameter name="distance" value="0.4"/></locomotion>'
    pilot.block("b", walk + take + put)
    await pilot.advance(9)
    assert pilot.feedback.warnings == []
    assert box(pilot) == (0.1, 1.0, 1.4)


async def test_a_reach_that_is_interrupted_on_its_way_takes_nothing(pilot: RealizerPilot) -> None:
    pilot.block("b", reach("take", 'ready="1"'))
    await pilot.advance(0.8)
    pilot.block("c", composition="REPLACE")
    await pilot.advance(2)
    assert box(pilot) == BOX


async def test_a_hand_that_does_not_reach_its_target_takes_nothing(pilot: RealizerPilot) -> None:
    pilot.move("box", (0.0, 1.2, 2.0))
    pilot.block("b", reach("take"))
    await pilot.advance(4)
    assert box(pilot) == (0.0, 1.2, 2.0)


async def test_a_client_that_moves_a_target_takes_it_out_of_the_hand(pilot: RealizerPilot) -> None:
    pilot.block("b", reach("take"))
    await pilot.advance(4)
    pilot.move("box", HIGH)
    await pilot.advance(1)
    assert box(pilot) == HIGH


async def test_eyes_follow_what_a_hand_carries(pilot: RealizerPilot) -> None:
    pilot.block("b", reach("take") + '<gaze id="g" target="box" start="p:end" end="p:end+2"/>')
    await pilot.advance(5)
    assert pilot.feedback.warnings == []
    assert pilot.feedback.status("b") == "DONE"


@pytest.mark.parametrize("word", ["hold", " Hold "])
async def test_a_hand_holds_on_to_a_target_that_moves_long_after_its_block(pilot: RealizerPilot, word: str) -> None:
    pilot.block("b", reach(word, 'ready="1"'))
    pilot.block("c", '<head id="h" lexeme="NOD"/>', composition="APPEND")
    await pilot.advance(20)
    pilot.move("box", HIGH)
    await pilot.advance(2)
    assert gaps(pilot, "r", BOX, 1.0, 19.9).max() < NEAR
    assert gaps(pilot, "r", HIGH, 21.0, 22.0).max() < NEAR
    assert pilot.feedback.time("b:p:strokeEnd") == 1.0
    assert not pilot.feedback.reached("b:p:end")
    assert pilot.feedback.status("c") == "DONE"


@pytest.mark.parametrize(
    "ends",
    [
        f'<rr:release xmlns:rr="{OWN}" id="e" mode="RIGHT_HAND"/>',
        f'<rr:release xmlns:rr="{OWN}" id="e" mode="BOTH_HANDS"/>',
        '<gesture id="e" lexeme="BEAT" mode="RIGHT_HAND"/>',
        f'<interrupt xmlns="{BMLA}" id="e" target="b"/>',
    ],
    ids=["release", "release of both hands", "gesture", "interrupt"],
)
async def test_a_hold_ends_when_its_hand_is_released_or_used_or_its_block_is_interrupted(
    pilot: RealizerPilot, ends: str
) -> None:
    pilot.block("b", reach("hold", 'mode="RIGHT_HAND" ready="1"'))
    await pilot.advance(5)
    pilot.block("c", ends)
    await pilot.advance(4)
    assert pilot.feedback.warnings == []
    assert pilot.feedback.time("b:p:end") == pytest.approx(5.0, abs=0.011)
    assert gaps(pilot, "r", BOX, 8.5, 9.0).min() > 0.3


AHEAD = (0.0, 1.15, 0.4)
RELEASE = f'<rr:release xmlns:rr="{OWN}" id="e" mode="RIGHT_HAND"/>'


async def test_a_hold_of_both_hands_ends_as_a_whole_and_the_release_of_one_says_so(pilot: RealizerPilot) -> None:
    pilot.move("box", AHEAD)
    pilot.block("b", reach("hold", 'mode="BOTH_HANDS" ready="1"'))
    await pilot.advance(3)
    pilot.block("c", RELEASE)
    await pilot.advance(3)
    assert pilot.feedback.time("b:p:end") == pytest.approx(3.0, abs=0.011)
    (warning,) = pilot.feedback.of("warningFeedback")
    assert (warning.id, warning.text) == (
        "c:e",
        "line 1, column 153: b:p holds on with both hands, so it ends for both; "
        "to release them one by one, hold on with each in a pointing of its own",
    )


async def test_hands_that_hold_on_in_pointings_of_their_own_are_released_one_by_one(pilot: RealizerPilot) -> None:
    pilot.move("box", AHEAD)
    other = reach("hold", 'mode="LEFT_HAND" ready="1"').replace('"p"', '"q"')
    pilot.block("b", reach("hold", 'mode="RIGHT_HAND" ready="1"') + other)
    await pilot.advance(3)
    pilot.block("c", RELEASE)
    await pilot.advance(3)
    assert pilot.feedback.warnings == []
    assert pilot.feedback.time("b:p:end") == pytest.approx(3.0, abs=0.011)
    assert not pilot.feedback.reached("b:q:end")
    assert gaps(pilot, "l", AHEAD, 1.0, 6.0).max() < 3.0 * NEAR


async def test_what_uses_the_other_hand_leaves_a_hold(pilot: RealizerPilot) -> None:
    pilot.block("b", reach("hold", 'mode="RIGHT_HAND" ready="1"'))
    await pilot.advance(2)
    pilot.block("c", f'<gesture id="g" lexeme="BEAT"/><rr:release xmlns:rr="{OWN}" id="e" mode="LEFT_HAND"/>')
    await pilot.advance(4)
    assert pilot.feedback.warnings == []
    assert pilot.feedback.status("c") == "DONE"
    assert gaps(pilot, "r", BOX, 1.0, 6.0).max() < NEAR


async def test_a_hold_with_a_tied_end_ends_then(pilot: RealizerPilot) -> None:
    pilot.block("b", reach("hold", 'start="0" end="3"'))
    await pilot.advance(4)
    assert pilot.feedback.time("b:p:end") == 3.0


@pytest.mark.parametrize("heading", [0.0, 40.0])
async def test_a_hand_that_holds_on_turns_with_its_target(pilot: RealizerPilot, heading: float) -> None:
    turn = from_axis_angle((0.0, 1.0, 0.0), math.radians(heading))
    pilot.move("box", BOX, turn)
    pilot.block("b", reach("hold", 'mode="RIGHT_HAND" ready="1"'))
    await pilot.advance(3)
    about = (math.sin(math.radians(heading)), 0.0, math.cos(math.radians(heading)))
    pilot.move("box", BOX, multiply(from_axis_angle(about, math.radians(20)), turn))
    await pilot.advance(2)
    before, after = (pilot.bodies()[number].transform("r_wrist").rotation for number in (140, -1))
    done = multiply(after, conjugate(before))
    assert math.degrees(angle(done)) == pytest.approx(20, abs=1)
    assert rotate(done, about) == pytest.approx(about, abs=0.01)
    assert gaps(pilot, "r", BOX, 4.5, 5.0).max() < NEAR
    assert pilot.feedback.warnings == []


async def test_a_hand_that_only_touches_does_not_turn_with_its_target(pilot: RealizerPilot) -> None:
    pilot.move("box", BOX, (1.0, 0.0, 0.0, 0.0))
    pilot.block("b", reach("touch", 'mode="RIGHT_HAND" ready="1" relax="6"'))
    await pilot.advance(3)
    pilot.move("box", BOX, from_axis_angle((0.0, 0.0, 1.0), math.radians(20)))
    await pilot.advance(2)
    before, after = (pilot.bodies()[number].transform("r_wrist").rotation for number in (140, -1))
    assert math.degrees(angle(multiply(after, conjugate(before)))) < 1.0


async def test_an_unknown_word_drops_the_behavior(pilot: RealizerPilot) -> None:
    pilot.block("b", reach("throw"))
    await pilot.advance(0.5)
    (warning,) = pilot.feedback.of("warningFeedback")
    assert "reach='throw' of <pointing>: not one of TOUCH, TAKE, PUT, HOLD" in warning.text
