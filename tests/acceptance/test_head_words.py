"""Head lexemes, in frames."""

from typing import Any

import numpy as np
import pytest

from reactive_realizer.embodiment.quaternion import Quat, multiply
from reactive_realizer.testing.pilot import RealizerPilot

from .conftest import OpenStill

PITCH, YAW, ROLL = 0, 1, 2
"""Components of a turn: positive is down, to the figure's left, and toward its right shoulder."""


async def nod(pilot: RealizerPilot, behavior: str) -> tuple[np.ndarray, np.ndarray]:
    """Times and turns of the whole head against the chest while a head movement plays, (F, 3), rad."""
    pilot.block("b", behavior)
    while not pilot.feedback.reached("b:end"):
        await pilot.advance(0.1)
    await pilot.advance(1.0)
    assert pilot.feedback.status("b") == "DONE"
    assert pilot.feedback.warnings == []
    joints = pilot.realizer.characters["alice"].humanoid.avatar.skeleton.joints
    neck, skull = joints.index("vc4"), joints.index("skullbase")
    frames = pilot.frames["alice"]
    turns = [turn(multiply(tuple(f.rotations[neck]), tuple(f.rotations[skull]))) for f in frames]
    return np.array([frame.time for frame in frames]), np.array(turns)


def turn(rotation: Quat) -> np.ndarray:
    """Axis times angle, rad, of a turn of less than a half."""
    w, *axis = rotation
    angle = 2.0 * np.arccos(np.clip(abs(w), 0.0, 1.0)) * np.sign(w)
    turn: np.ndarray = angle * np.array(axis) / max(np.linalg.norm(axis), 1e-12)
    return turn


@pytest.mark.parametrize(
    ("lexeme", "way"),
    {
        "UP": {PITCH: -1},
        "DOWN": {PITCH: 1},
        "LEFT": {YAW: 1},
        "RIGHT": {YAW: -1},
        "UP_LEFT": {PITCH: -1, YAW: 1},
        "UP_RIGHT": {PITCH: -1, YAW: -1},
        "DOWN_LEFT": {PITCH: 1, YAW: 1},
        "DOWN_RIGHT": {PITCH: 1, YAW: -1},
        "ROTATE_LEFT": {YAW: 1},
        "ROTATE_RIGHT": {YAW: -1},
        "TILT_LEFT": {ROLL: -1},
        "TILT_RIGHT": {ROLL: 1},
        "TILT_FORWARD": {PITCH: 1},
        "TILT_BACKWARD": {PITCH: -1},
    }.items(),
)
async def test_the_head_moves_according_to_the_lexeme_and_returns(still: RealizerPilot, lexeme: str, way: Any) -> None:
    times, turns = await nod(still, f'<head id="h" lexeme="{lexeme}" amount="1"/>')
    there = turns[np.searchsorted(times, still.feedback.time("b:h:stroke"))]
    for axis in (PITCH, YAW, ROLL):
        assert np.sign(there[axis]) == way[axis] if axis in way else abs(there[axis]) < 0.1
        assert axis not in way or abs(there[axis]) > np.radians(5)
    ready, relax = (still.feedback.time(f"b:h:{sync}") for sync in ("ready", "relax"))
    held = turns[(times > ready) & (times < relax)]
    np.testing.assert_allclose(held, np.broadcast_to(there, held.shape), atol=0.02)
    np.testing.assert_allclose(turns[-1], turns[0], atol=1e-6)


@pytest.mark.parametrize(
    ("lexeme", "axis"), [("NOD", PITCH), ("SHAKE", YAW), ("TILT", ROLL), ("TOSS", PITCH), ("UP", PITCH)]
)
async def test_the_head_repeats_as_often_as_requested(still: RealizerPilot, lexeme: str, axis: Any) -> None:
    times, turns = await nod(still, f'<head id="h" lexeme="{lexeme}" repetition="3" amount="1"/>')
    strokes = [still.feedback.time(f"b:h:stroke:{i}") for i in (1, 2, 3)]
    assert np.ptp(np.diff(strokes)) < 1e-6, "evenly"
    peaks = [turns[np.searchsorted(times, stroke), axis] for stroke in strokes]
    assert min(np.abs(peaks)) > 0.9 * np.abs(turns[:, axis]).max()


async def test_half_the_amount_turns_half_as_far(open_still: OpenStill) -> None:
    ways = []
    for amount in (0.4, 0.8):
        async with open_still() as pilot:
            _, turns = await nod(pilot, f'<head id="h" lexeme="LEFT" amount="{amount}"/>')
            ways.append(turns[:, YAW].max())
    assert ways[0] / ways[1] == pytest.approx(0.5, abs=0.02)


async def test_head_movements_add_to_gaze(still: RealizerPilot) -> None:
    times, turns = await nod(
        still, '<gaze id="g" target="floor" start="0" end="6"/><head id="h" lexeme="TILT_RIGHT" amount="1" start="2"/>'
    )
    before, there = (turns[np.searchsorted(times, time)] for time in (1.9, still.feedback.time("b:h:stroke")))
    assert before[PITCH] > 0.1, "it looks down"
    assert there[PITCH] == pytest.approx(before[PITCH], abs=0.1)
    assert there[ROLL] - before[ROLL] > 0.2
