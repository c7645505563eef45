"""Gazes that start after their time."""

import math
from itertools import pairwise

import pytest

from reactive_realizer.testing.pilot import RealizerPilot

from .seen import FAR, FRAME, between, miss, put, sight, speeds

PLANNED = 1.0


@pytest.mark.parametrize("late", [0.1, 0.3, 0.4])
@pytest.mark.parametrize("kind", ["gaze", "gazeShift"])
async def test_a_late_gaze_turns_the_head_at_its_usual_pace_and_the_eyes_at_once(
    pilot: RealizerPilot, kind: str, late: float
) -> None:
    await pilot.advance(0.1)
    target = put(pilot, "t", 36, 8, FAR)
    pilot.predict("a", "hit", PLANNED)
    await pilot.advance(PLANNED - 0.1 + late)
    pilot.block("b", f'<{kind} id="g" target="t" start="anticipators:a:hit"/>')
    await pilot.advance(2)
    assert pilot.feedback.time("b:g:start") == PLANNED
    shown = pilot.bodies()
    turning = speeds(shown, "skullbase")
    turned = math.radians(between(sight(shown[0], "skullbase"), sight(shown[110], "skullbase")))
    assert max(turning) < 1.1 * 1.875 * turned / 0.5, "the peak of minimum jerk"
    assert max(abs(b - a) for a, b in pairwise(turning)) < 0.6
    arrived = round((PLANNED + late + 0.25) / FRAME)
    assert max(miss(body, target) for body in shown[arrived:100]) < 0.5
