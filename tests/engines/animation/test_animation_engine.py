"""Motions between pegs, as frames show them."""

import math
from collections.abc import AsyncIterator
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import Quat
from reactive_realizer.engines.animation.motion_unit import Moment, MotionPose
from reactive_realizer.engines.animation.motions.procedural import ProceduralMotionUnit
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

BINDING = """
<gesturebinding>
  <MotionUnitSpec type="gesture">
    <constraints><constraint name="lexeme" value="BREAKS"/></constraints>
    <MotionUnit type="ProcAnimation" file="breaks.xml"/>
  </MotionUnitSpec>
  <MotionUnitSpec type="gesture">
    <constraints><constraint name="lexeme" value="LIFT"/></constraints>
    <MotionUnit type="ProcAnimation" file="lift.xml"/>
  </MotionUnitSpec>
</gesturebinding>
"""
BREAKS = '<ProcAnimation prefDuration="1"><Rotation target="l_elbow" rotation="0 - sqrt(0.5 - t);0;0"/></ProcAnimation>'
LIFT = '<ProcAnimation prefDuration="2"><Rotation target="r_elbow" rotation="0 - sin(t*pi);0;0"/></ProcAnimation>'


@pytest.fixture
async def pilot(tmp_path: Path) -> AsyncIterator[RealizerPilot]:
    for name, text in {"gesturebinding.xml": BINDING, "breaks.xml": BREAKS, "lift.xml": LIFT}.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    async with open_pilot(SceneOptions(voice="text", assets=(tmp_path,))) as pilot:
        pilot.watch()
        yield pilot


def rotations(pilot: RealizerPilot, joint: str) -> NDArray[np.float64]:
    """A joint's rotation in each frame, (F, 4)."""
    joints = pilot.realizer.characters["alice"].humanoid.avatar.skeleton.joints
    index = joints.index(joint)
    return np.array([frame.rotations[index] for frame in pilot.frames["alice"]])


def turns(path: NDArray[np.float64]) -> NDArray[np.float64]:
    """By how much a joint turned from each frame to the next, rad, (F - 1,)."""
    cosines: NDArray[np.float64] = np.abs(np.sum(path[1:] * path[:-1], axis=1))
    return 2 * np.arccos(np.clip(cosines, 0, 1))


async def test_a_motion_without_a_pose_stops_with_a_warning_and_others_continue(pilot: RealizerPilot) -> None:
    pilot.block("b", '<gesture id="bad" lexeme="BREAKS"/><gesture id="good" lexeme="LIFT"/>')
    await pilot.advance(4)
    assert pilot.feedback.warnings == [("b:bad", "EXECUTION_FAILURE")]
    assert pilot.feedback.time("b:bad:end") < 0.6
    assert pilot.feedback.time("b:good:end") == 2.0
    assert turns(rotations(pilot, "r_elbow")[40:60]).max() > 0.001


@pytest.mark.parametrize("wrong", [(math.nan, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0), (2.0, 0.0, 0.0, 0.0)])
async def test_a_motion_with_an_invalid_rotation_stops_with_a_warning_before_it_is_shown(
    pilot: RealizerPilot, monkeypatch: pytest.MonkeyPatch, wrong: Quat
) -> None:
    pose = ProceduralMotionUnit.pose

    def goes_wrong(self: ProceduralMotionUnit, moment: Moment) -> MotionPose:
        posed = pose(self, moment)
        return MotionPose({"r_elbow": wrong}) if moment.phase > 0.4 and "r_elbow" in posed.rotations else posed

    monkeypatch.setattr(ProceduralMotionUnit, "pose", goes_wrong)
    pilot.block("b", '<gesture id="bad" lexeme="LIFT"/><head id="good" lexeme="NOD" end="3"/>')
    await pilot.advance(4)
    (warning,) = pilot.feedback.of("warningFeedback")
    assert (warning.id, warning.element.get("type")) == ("b:bad", "EXECUTION_FAILURE")
    assert "its motion sets r_elbow to" in warning.text
    assert pilot.feedback.time("b:good:end") == 3.0
    seen = np.array([frame.rotations for frame in pilot.frames["alice"]])
    assert np.abs(np.linalg.norm(seen, axis=2) - 1.0).max() < 1e-6
    assert turns(rotations(pilot, "r_elbow")).max() < 0.1, "back to rest without a jump"


async def test_a_cut_motion_returns_to_rest_without_a_jump(pilot: RealizerPilot) -> None:
    await pilot.advance(0.1)
    pilot.block("b", '<gesture id="g" lexeme="LIFT"/>')
    await pilot.advance(1)
    pilot.block("stop", composition="REPLACE")
    await pilot.advance(2)
    path = rotations(pilot, "r_elbow")
    assert turns(path).max() < 0.3
    assert turns(path[[0, -1]]) < 0.01


async def test_an_idle_figure_breathes_and_blinks(pilot: RealizerPilot) -> None:
    await pilot.advance(10)
    assert turns(rotations(pilot, "vt6")).max() > 0
    morphs = pilot.realizer.characters["alice"].humanoid.avatar.morphs
    lids = np.array([frame.weights for frame in pilot.frames["alice"]])[:, morphs.index("eyeBlinkLeft")]
    assert lids.max() > 0.8
    assert np.median(lids) == 0


@pytest.mark.parametrize(("hit", "moved", "to"), [(1.3, 1.0, 1.0), (5.0, 4.6, 4.62)], ids=["to now", "much nearer"])
async def test_a_stroke_that_is_moved_late_does_not_make_the_hand_jerk(hit: float, moved: float, to: float) -> None:
    async with open_pilot(SceneOptions(voice="text")) as pilot:
        pilot.watch()
        pilot.predict("test", "hit", hit)
        pilot.block("b", '<gesture id="g" lexeme="BEAT" mode="RIGHT_HAND" stroke="anticipators:test:hit"/>')
        await pilot.advance(moved)
        pilot.predict("test", "hit", to)
        await pilot.advance(1)
        skeleton = pilot.realizer.characters["alice"].humanoid.avatar.skeleton
        poses = [
            dict(zip(skeleton.joints, map(tuple, frame.rotations), strict=True)) for frame in pilot.frames["alice"]
        ]
        path = np.array([Body(skeleton, pose).transform("r_wrist").position for pose in poses])
        steps = np.linalg.norm(np.diff(path, axis=0), axis=1)
        assert steps.max() > 0.03, "it hurries"
        assert np.diff(steps).max() < 0.0151


CHUNK = '<gesture id="g" lexeme="OFFER" mode="RIGHT_HAND"/><speech id="s"><text>An offer.</text></speech>'


async def test_a_gesture_is_planned_from_the_current_hand_with_or_without_frames() -> None:
    told = []
    for looks in (True, False):
        async with open_pilot(SceneOptions(voice="text")) as pilot:
            if looks:
                pilot.watch()
            pilot.block("first", CHUNK)
            pilot.block("second", CHUNK, **{"bmla:chunkAfter": "first"})
            await pilot.advance(8)
            told.append(pilot.feedback)
    preparations = [told[0].time(f"{id_}:g:ready") - told[0].time(f"{id_}:g:start") for id_ in ("first", "second")]
    assert preparations[1] < preparations[0] - 0.05
    assert told[0].raw == told[1].raw
    assert told[0].warnings == []


async def test_a_new_gesture_takes_over_a_retracting_hand_without_a_jump_and_the_other_hand_goes_to_rest() -> None:
    both = '<gesture id="g" lexeme="OFFER" mode="BOTH_HANDS"/>'
    async with open_pilot(SceneOptions(voice="text")) as pilot:
        pilot.watch()
        await pilot.advance(0.1)
        pilot.block("first", both)
        pilot.block("second", '<gesture id="g" lexeme="BEAT" mode="RIGHT_HAND"/>', **{"bmla:chunkAfter": "first"})
        await pilot.advance(8)
        assert pilot.feedback.time("first:g:end") == pilot.feedback.time("first:g:relax")
        assert pilot.feedback.status("first") == "DONE"
        assert pilot.feedback.warnings == []
        for joint in ("l_elbow", "r_elbow", "l_shoulder", "r_shoulder"):
            path = rotations(pilot, joint)
            assert turns(path).max() < 0.3
            assert turns(path[[0, -1]]) < 0.03  # elbows are never still
