"""The laws of smooth motion, from frames."""

import pytest

from reactive_realizer.testing.motion_laws import accelerations, angular_accelerations, worst_motion
from reactive_realizer.testing.pilot import RealizerPilot

from .parameter_changes import HEAD, change

MOST, TURNING = 60.0, 240.0
"""m/s² of a wrist, and rad/s² of its joints; the limits of catching up are 50 and 200."""

TURNED = 200.0
"""Degrees/s of the head in the world."""


@pytest.mark.parametrize(
    ("lexeme", "moved", "to"), [("BEAT", 1.35, 1.4), ("OFFER", 1.4, 1.45), ("WAVE", 1.3, 1.35), ("CHOP", 1.35, 1.4)]
)
async def test_a_hurried_hand_brakes_before_it_arrives(
    still: RealizerPilot, lexeme: str, moved: float, to: float
) -> None:
    still.predict("t", "hit", 2.0)
    still.block("b", f'<gesture id="g" lexeme="{lexeme}" mode="RIGHT_HAND" ready="anticipators:t:hit"/>')
    await still.advance(moved)
    still.predict("t", "hit", to)
    await still.advance(2)
    bodies, last = still.bodies(), round(50 * still.feedback.time("b:g:strokeStart")) + 3
    assert accelerations(bodies, "r_wrist")[:last].max() < MOST
    assert max(angular_accelerations(bodies, f"r_{j}")[:last].max() for j in ("shoulder", "elbow", "wrist")) < TURNING


@pytest.mark.parametrize("lexeme", ["NOD", "SHAKE", "TILT", "TOSS"])
@pytest.mark.parametrize(("before", "after"), [(1, 0.1), (0.1, 1)])
async def test_a_head_whose_amount_jumps_does_not_jump(
    still: RealizerPilot, lexeme: str, before: float, after: float
) -> None:
    head = HEAD.format(before).replace("NOD", lexeme)
    jumps = (
        change(f"p{time}", f'start="{time / 10}"', target="h", parameter="amount", type="instant", targetValue=value)
        for time, value in ((12, after), (16, before), (25, after))
    )
    still.block("b", head + "".join(jumps))
    await still.advance(4)
    assert worst_motion(still.bodies())["head_deg_s"] < TURNED
    assert still.feedback.warnings == []


@pytest.mark.parametrize("first", ["BEAT", "WAVE", "CHOP"])
@pytest.mark.parametrize("time", [0.25, 0.4, 0.7])
async def test_an_arm_goes_over_to_a_gesture_that_replaces_another_one_with_the_velocity_that_it_has(
    still: RealizerPilot, first: str, time: float
) -> None:
    still.block("a", f'<gesture id="g" lexeme="{first}" mode="RIGHT_HAND"/>')
    await still.advance(time)
    still.block("b", '<gesture id="g" lexeme="OFFER" mode="RIGHT_HAND"/>', composition="REPLACE")
    await still.advance(2)
    begin = round(50 * still.feedback.time("b:g:start"))
    assert accelerations(still.bodies(), "r_wrist")[begin - 4 : begin + 10].max() < 40.0
    assert still.feedback.warnings == []


async def test_an_arm_does_not_jump_when_the_amount_of_its_gesture_does(still: RealizerPilot) -> None:
    jump = change("p", 'start="0.5"', target="g", parameter="amount", type="instant", targetValue=0.3)
    still.block("b", f'<gesture id="g" lexeme="CHOP" mode="RIGHT_HAND" start="0.1"/>{jump}')
    await still.advance(3)
    assert accelerations(still.bodies(), "r_wrist").max() < MOST
    assert still.feedback.warnings == []


async def test_a_hurried_arm_does_not_stop_where_another_amount_leaves_it_in_its_place(still: RealizerPilot) -> None:
    still.block("b", '<gesture id="g" lexeme="BEAT" mode="BOTH_HANDS" stroke="0.6"/>')
    await still.advance(0.26)
    # The hands are then where the new amount wants them one frame later.
    still.block("c", change("p", 'start="0"', target="b:g", parameter="amount", type="instant", targetValue=0.9))
    await still.advance(2)
    assert accelerations(still.bodies(), "r_wrist").max() < MOST
