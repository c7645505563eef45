"""The laws of smooth motion, from frames."""

import pytest

from reactive_realizer.testing.motion_laws import accelerations, angular_accelerations, worst_motion
from reactive_realizer.testing.pilot import RealizerPilot

from .parameter_changes import HEAD, change

MOST, TURNING = 60.0, 220.0
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
