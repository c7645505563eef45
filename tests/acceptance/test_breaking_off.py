"""Motions that end or are interrupted while moving slow down before they return."""

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from reactive_realizer.embodiment.quaternion import difference, rotation_vector
from reactive_realizer.testing.pilot import RealizerPilot

FRAME = 0.02
HARDEST = 2.0
"""rad/s from frame to frame: 100 rad/s², about what an elbow brakes with in fast movements."""

CONDUCT = '<bmlt:procanimation id="m" name="conduct-3-beat" mode="RIGHT_HAND" start="0" end="2"/>'
CROSSING = '<posture id="m"><stance type="STANDING"/><pose part="ARMS" lexeme="ARMS_CROSSED"/></posture>'
SITTING = '<posture id="m"><stance type="SITTING"/></posture>'
INTERRUPT = '<bmla:interrupt id="i" target="a"/>'


def velocities(pilot: RealizerPilot, joint: str) -> NDArray[np.float64]:
    """How a joint turns from each frame to the next, (frames - 1, 3), rad/s."""
    turns = [body.rotation(joint) for body in pilot.bodies()]
    return np.array([rotation_vector(difference(a, b)) for a, b in pairwise(turns)]) / FRAME


def brakes(pilot: RealizerPilot, joint: str, since: float) -> Any:
    """By how much that changes from frame to frame from a time on, rad/s."""
    changes = np.linalg.norm(np.diff(velocities(pilot, joint), axis=0), axis=1)
    return changes[round(since / FRAME) - 2 :].max()


def fast(pilot: RealizerPilot, joint: str, time: float) -> float:
    """How fast a joint turns just before a time, degrees a second."""
    return math.degrees(np.linalg.norm(velocities(pilot, joint)[round(time / FRAME) - 2]))


async def test_an_animation_that_ends_in_motion_does_not_stop_dead(still: RealizerPilot) -> None:
    still.block("a", CONDUCT)
    await still.advance(4)
    joint = max(("r_elbow", "r_shoulder"), key=lambda joint: fast(still, joint, 2.0))
    speed = math.radians(fast(still, joint, 2.0))
    assert speed > 1.0
    assert brakes(still, joint, 2.0) < 0.45 * speed


@pytest.mark.parametrize(
    ("motion", "joint", "time"),
    [
        (CROSSING, "l_shoulder", 0.4),
        (CROSSING, "r_elbow", 0.4),
        ('<gesture id="m" lexeme="OFFER" mode="RIGHT_HAND"/>', "r_elbow", 0.3),
        ('<gesture id="m" lexeme="CHOP" mode="RIGHT_HAND"/>', "r_elbow", 0.3),
        ('<pointing id="m" target="floor" mode="RIGHT_HAND"/>', "r_shoulder", 0.3),
        ('<gaze id="m" target="floor" influence="WAIST"/>', "vl5", 0.26),
        ('<head id="m" lexeme="NOD" amount="1"/>', "skullbase", 0.1),
    ],
)
async def test_an_interrupted_motion_slows_down_and_then_returns(
    still: RealizerPilot, motion: str, joint: str, time: float
) -> None:
    still.block("a", motion)
    await still.advance(time)
    still.block("b", INTERRUPT)
    await still.advance(2)
    speed = math.radians(fast(still, joint, time))
    assert speed > 0.3
    assert brakes(still, joint, time) < min(HARDEST, 0.45 * speed)
    assert np.linalg.norm(velocities(still, joint)[-1]) < 0.01


async def test_the_pelvis_of_an_interrupted_change_of_stance_slows_down_and_then_returns(still: RealizerPilot) -> None:
    still.block("a", SITTING)
    await still.advance(0.8)
    still.block("b", INTERRUPT)
    await still.advance(2)
    speeds = np.diff([body.root[1] for body in still.bodies()]) / FRAME
    assert speeds.min() < -0.4
    assert np.abs(np.diff(speeds)).max() < 0.2
    assert still.bodies()[-1].root[1] == pytest.approx(0.0, abs=0.001)


@pytest.mark.parametrize("stance", ["CROUCHING", "LYING"])
async def test_the_feet_stay_above_the_ground(still: RealizerPilot, stance: str) -> None:
    still.block("a", f'<posture id="m"><stance type="{stance}"/></posture>')
    await still.advance(0.7)
    still.block("b", INTERRUPT)
    await still.advance(2)
    heels = [min(body.transform(f"{side}_ankle").position[1] for side in "lr") for body in still.bodies()]
    assert min(heels) > heels[0] - 0.001
