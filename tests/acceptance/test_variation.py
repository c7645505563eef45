"""Repetitions differ a little, as the seed of a character says, and so do two hands; sync points stay."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.vector import subtract
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .conftest import OpenStill

FRAME = 0.02
GESTURE = '<gesture id="g" lexeme="{}" mode="{}"/>'
CLAP = """<ProcAnimation prefDuration="0.6">
  <EndEffector target="l_wrist" local="true" translation="-0.12; -0.17 + 0.08*sin(6.283*t); 0.27"/>
  <EndEffector target="r_wrist" local="true" translation="0.12; -0.17 + 0.08*sin(6.283*t); 0.27"/>
  <KeyPosition id="ready" time="0"/>
  <KeyPosition id="stroke" time="0.5"/>
  <KeyPosition id="relax" time="1"/>
</ProcAnimation>"""
CLAPS = """<gesturebinding><MotionUnitSpec type="gesture">
  <constraints><constraint name="lexeme" value="CLAP"/></constraints>
  <MotionUnit type="Gesture" file="clap.xml"/>
</MotionUnitSpec></gesturebinding>"""


def wrist(bodies: Sequence[Body], side: str) -> NDArray[np.float64]:
    """Of an arm, from its shoulder in each frame, mirrored to the right, (F, 3), m."""
    ends = ((body.transform(f"{side}_{joint}").position for joint in ("wrist", "shoulder")) for body in bodies)
    return np.array([subtract(*both) for both in ends]) * (-1.0 if side == "l" else 1.0, 1.0, 1.0)


def delay(bodies: Sequence[Body]) -> float:
    """By how much later the left hand does what the right one does, s."""
    left, right = wrist(bodies, "l"), wrist(bodies, "r")
    times = FRAME * np.arange(len(right))
    delays = np.arange(0.0, 0.1, 0.001)
    later = ([np.interp(times - each, times, column) for column in right.T] for each in delays)
    return float(delays[np.argmin([np.abs(np.array(each).T - left).sum() for each in later])])


async def sizes(pilot: RealizerPilot, lexeme: str, count: int) -> list[float]:
    """How far the right wrist goes from its ready in each of several gestures, m; they take the same time."""
    for number in range(count):
        pilot.block(f"b{number}", GESTURE.format(lexeme, "RIGHT_HAND"))
        await pilot.advance(3)
    way, told = wrist(pilot.bodies(), "r"), pilot.feedback
    spans = [[told.time(f"b{n}:g:{point}") for point in ("ready", "stroke", "relax")] for n in range(count)]
    assert np.ptp(np.diff(spans), axis=0).max() < 1e-6
    ready = [way[round(span[0] / FRAME)] for span in spans]
    assert np.ptp(ready, axis=0).max() < 0.005, "where the stroke begins"
    parts = [way[round(first / FRAME) : round(last / FRAME)] for first, _, last in spans]
    return [float(np.linalg.norm(part - part[0], axis=1).max()) for part in parts]


@pytest.mark.parametrize("lexeme", ["BEAT", "CHOP"])
async def test_repeated_gestures_differ_in_size_by_a_few_percent_and_not_in_their_sync_points(
    still: RealizerPilot, lexeme: str
) -> None:
    found = await sizes(still, lexeme, 4)
    assert 0.01 < np.ptp(found) / np.mean(found) < 0.1
    assert len({round(size, 5) for size in found}) == 4


async def test_repeated_nods_differ_in_size_by_a_few_percent(still: RealizerPilot) -> None:
    still.block("b", '<head id="h" lexeme="NOD" repetition="4" amount="0.6"/>')
    await still.advance(5)
    nods = np.array([2.0 * body.transform("skullbase").rotation[1] for body in still.bodies()])
    peaks = [nods[i] for i in range(1, len(nods) - 1) if nods[i - 1] < nods[i] >= nods[i + 1] and nods[i] > 0.03]
    assert len(peaks) == 4
    assert 0.01 < np.ptp(peaks) / np.mean(peaks) < 0.15


async def test_the_same_seed_gives_the_same_variations() -> None:
    runs = []
    for seed in (1, 1, 2):
        async with open_pilot(SceneOptions(voice="text", seed=seed)) as pilot:
            pilot.watch()
            runs.append(await sizes(pilot, "BEAT", 2))
    assert runs[0] == runs[1]
    assert runs[0] != runs[2]


@pytest.mark.parametrize("lexeme", ["BEAT", "OFFER", "CONTAINER", "CHOP"])
async def test_of_two_hands_the_left_one_trails_by_30_to_60_ms(still: RealizerPilot, lexeme: str) -> None:
    still.block("b", GESTURE.format(lexeme, "BOTH_HANDS"))
    await still.advance(3)
    first, last = (round(still.feedback.time(f"b:g:{point}") / FRAME) for point in ("start", "relax"))
    assert 0.028 <= delay(still.bodies()[first:last]) <= 0.062
    assert still.feedback.warnings == []


async def test_hands_that_touch_move_together(open_still: OpenStill, tmp_path: Path) -> None:
    (tmp_path / "clap.xml").write_text(CLAP)
    (tmp_path / "gesturebinding.xml").write_text(CLAPS)
    async with open_still(tmp_path) as still:
        still.block("b", GESTURE.format("CLAP", "BOTH_HANDS"))
        await still.advance(3)
        assert still.feedback.warnings == []
        assert np.abs(wrist(still.bodies(), "l") - wrist(still.bodies(), "r")).max() < 0.001
