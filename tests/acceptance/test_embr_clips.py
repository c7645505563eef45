"""Clips of EMBRScript: a later one takes over from an earlier one of the same joints, by their fades."""

from itertools import pairwise
from math import acos
from pathlib import Path

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

CLIP = (
    '<SkeletonInterpolator rotationEncoding="axisangles" parts="r_elbow" encoding="R">'
    "0 1 0 0 -{0} 1 1 0 0 -{0}</SkeletonInterpolator>"
)
LOW, HIGH = 0.5, 1.5
"""How far the clips bend the elbow, rad."""
FRAME = 0.02


def sequence(clip: str, end: int, header: str) -> str:
    motion = f"BEGIN ANIMATION\nTIME_POINT:{end}\nANIMATION_CLIP:{clip}\nBODY_GROUP:all\nEND"
    return f"BEGIN K_POSE_SEQUENCE\n{header}\n{motion}\nEND\n"


async def bends(folder: Path, script: str, seconds: float) -> tuple[RealizerPilot, list[float]]:
    """How far the elbow is bent in each frame, rad."""
    for name, angle in (("low", LOW), ("high", HIGH)):
        (folder / f"{name}.xml").write_text(CLIP.format(angle))
    async with open_pilot(SceneOptions(voice="text", assets=(folder,))) as pilot:
        pilot.watch()
        pilot.perform(script)
        await pilot.advance(seconds)
        return pilot, [2.0 * acos(min(1.0, abs(body.rotation("r_elbow")[0]))) for body in pilot.bodies()]


async def test_overlapping_sequences_crossfade(tmp_path: Path) -> None:
    script = sequence("low", 2000, "START:0\nFADE_OUT:500") + sequence("high", 4000, "START:1500\nFADE_IN:500")
    pilot, bent = await bends(tmp_path, script, 3.5)
    assert pilot.feedback.warnings == []
    assert bent[round(1.4 / FRAME)] == pytest.approx(LOW, abs=0.03)
    assert bent[round(2.2 / FRAME)] == pytest.approx(HIGH, abs=0.03)
    between = bent[round(1.5 / FRAME) : round(2.0 / FRAME)]
    assert max(abs(after - before) for before, after in pairwise(between)) < 0.1


async def test_an_earlier_clip_is_seen_again_when_a_later_one_has_ended(tmp_path: Path) -> None:
    script = sequence("low", 4000, "START:0") + sequence("high", 2000, "START:1000\nFADE_IN:200\nFADE_OUT:200")
    pilot, bent = await bends(tmp_path, script, 3.5)
    assert pilot.feedback.warnings == []
    assert bent[round(1.6 / FRAME)] == pytest.approx(HIGH, abs=0.03)
    assert bent[round(3.0 / FRAME)] == pytest.approx(LOW, abs=0.03)
