"""Hermite transitions are smooth at both ends (thesis 4.2.4), in frames."""

from pathlib import Path

import numpy as np
import pytest

from reactive_realizer.testing.pilot import RealizerPilot

from .motions import ARM, angles

FRAME = 0.02
SWAY = """
<ProcAnimation prefDuration="2">
  <Rotation target="r_shoulder" rotation="0 - 0.6 - 0.4*sin(2*pi*t + 1);0;0"/>
  <Rotation target="r_elbow" rotation="0 - 0.8 + 0.3*cos(2*pi*t);0;0"/>
</ProcAnimation>
"""


def accelerations(turns: dict[float, float]) -> tuple[np.ndarray, np.ndarray]:
    """Times of frames and how a joint's velocity changes there, rad/s², by differences of three frames."""
    return np.array(list(turns))[1:-1], np.diff(list(turns.values()), 2) / FRAME**2


def limits(turns: dict[float, float], time: float) -> tuple[float, float]:
    """The acceleration just before and just after a time, as far as the frames before and after can say."""
    times, values = accelerations(turns)
    before = (times < time - FRAME) & (times > time - 6 * FRAME)
    after = (times > time + FRAME) & (times < time + 6 * FRAME)
    left, right = (float(np.polyval(np.polyfit(times[side], values[side], 2), time)) for side in (before, after))
    return left, right


@pytest.mark.parametrize(("start", "end"), [(1.6, 3.0), (1.613, 3.007), (1.25, 2.657)])
@pytest.mark.parametrize("joint", ["r_shoulder", "r_elbow"])
async def test_a_hermite_transition_has_the_acceleration_of_the_motions_around_it(
    pilot: RealizerPilot, tmp_path: Path, joint: str, start: float, end: float
) -> None:
    (tmp_path / "moves" / "sway.xml").write_text(SWAY)
    pilot.block(
        "b",
        f"""
        <bmlt:procanimation id="a" name="sway" start="0" end="{start}"/>
        <bmlt:transition id="t" class="HermiteTransition" start="a:end" end="{end}">{ARM}</bmlt:transition>
        <bmlt:procanimation id="c" name="sway" start="t:end" end="{end + 1.5}"/>
        """,
    )
    await pilot.advance(4.5)
    assert not pilot.feedback.warnings
    turns = angles(pilot, joint)
    times, values = accelerations(turns)
    assert min(abs(np.interp([start - 0.05, end + 0.05], times, values))) > 3.0
    for time in (start, end):
        left, right = limits(turns, time)
        assert right == pytest.approx(left, abs=0.3)
        assert values[np.abs(times - time) <= FRAME] == pytest.approx(left, abs=2.0)
