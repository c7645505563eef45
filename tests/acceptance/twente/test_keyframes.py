"""Keyframe animations and captures, from files or from BML (thesis C.1.2)."""

from pathlib import Path
from threading import current_thread
from typing import Any

import numpy as np
import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.engines.animation.keyframe import clip_files
from reactive_realizer.engines.animation.keyframe.bvh_reader import read_capture
from reactive_realizer.engines.animation.keyframe.capture import Capture
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .motions import BOW, WAVE, after_start, angles, told


@pytest.mark.parametrize("inside", ["", WAVE, WAVE.replace("<SkeletonInterpolator", '<SkeletonInterpolator xmlns=""')])
async def test_keys_of_a_file_or_of_bml_itself_are_played(pilot: RealizerPilot, inside: Any) -> None:
    name = "" if inside else 'name="wave"'
    pilot.block("b", f'<bmlt:keyframe id="k" {name} start="0">{inside}</bmlt:keyframe>')
    await pilot.advance(3)
    assert not pilot.feedback.warnings
    assert after_start(pilot, "k:up", "k:end") == [1.0, 2.0]
    shown = angles(pilot, "r_shoulder")
    assert [shown[time] for time in (0.5, 1.0, 1.5)] == pytest.approx([-0.4, -0.8, -0.5], abs=0.01)


async def test_keys_are_played_in_the_time_that_bml_gives_them(pilot: RealizerPilot) -> None:
    pilot.block("b", '<bmlt:keyframe id="k" name="wave" start="0" end="4"/>')
    await pilot.advance(5)
    assert angles(pilot, "r_shoulder")[2.0] == pytest.approx(-0.8, abs=0.01)


async def test_keys_are_not_played_faster_than_the_body_can_move(pilot: RealizerPilot) -> None:
    pilot.block("b", '<bmlt:keyframe id="k" name="wave" start="0" up="0.1"/>')
    await pilot.advance(3)
    assert "k:up = 0.1 is dropped: there is too little time for k from start to up: needs 0." in told(pilot)
    assert pilot.feedback.time("b:k:up") - pilot.feedback.time("b:k:start") > 0.2


async def test_a_body_that_has_just_enough_time_is_there_at_a_key(pilot: RealizerPilot) -> None:
    pilot.block("b", '<bmlt:keyframe id="k" name="wave" start="0" up="0.32"/>')
    await pilot.advance(3)
    assert not pilot.feedback.warnings
    assert angles(pilot, "r_shoulder")[0.32] == pytest.approx(-0.8, abs=0.03)


async def test_a_capture_is_not_played_faster_than_the_body_can_move(pilot: RealizerPilot) -> None:
    pilot.block("b", '<bmlt:keyframe id="k" name="bow" start="1" end="1.05"/>')
    await pilot.advance(3)
    assert "too little time for k from start to end: needs 0.29 s, has 0.05 s" in told(pilot)


async def test_a_capture_is_played_by_its_name(pilot: RealizerPilot) -> None:
    pilot.block("b", '<bmlt:keyframe id="k" name="bow" start="1"/>')
    await pilot.advance(3)
    assert not pilot.feedback.warnings
    assert after_start(pilot, "k:end") == [2.0]
    assert angles(pilot, "vl5")[1.5] == pytest.approx(np.radians(30.0), abs=0.05)
    (frames,) = pilot.frames.values()
    feet = pilot.path("l_ankle") + [frame.root for frame in frames]
    assert np.ptp(feet[70:100], axis=0).max() < 0.001
    assert feet[:, 1].min() > feet[0, 1] - 0.005


@pytest.mark.parametrize(("frames", "warnings"), [("3", []), ("9", [("b:k", "CANNOT_CREATE_BEHAVIOR")])])
async def test_a_capture_is_read_once_in_another_thread_even_if_it_is_invalid(
    pilot: RealizerPilot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, frames: str, warnings: Any
) -> None:
    threads = []

    def read(path: Path) -> Capture:
        threads.append(current_thread())
        return read_capture(path)

    monkeypatch.setattr(clip_files, "read_capture", read)
    (tmp_path / "captures" / "bow.bvh").write_text(BOW.replace("Frames: 3", f"Frames: {frames}"))
    pilot.block("b", '<bmlt:keyframe id="k" name="bow" start="0"/><wait id="w" start="0" end="1"/>')
    await pilot.advance(2)
    assert pilot.feedback.warnings == warnings
    assert "b:w:end" in pilot.feedback.progress
    assert len(threads) == 1
    assert current_thread() not in threads


async def test_a_keyframe_animation_is_mirrored_and_then_restricted_to_joints(pilot: RealizerPilot) -> None:
    """Thesis C.1.2."""
    mirror = '<bmlt:parameter name="mirror" value="true"/><bmlt:parameter name="joints" value="l_shoulder"/>'
    pilot.block("b", f'<bmlt:keyframe id="k" name="wave" start="0">{mirror}</bmlt:keyframe>')
    await pilot.advance(1.2)
    assert not pilot.feedback.warnings
    assert angles(pilot, "l_shoulder")[1.0] == pytest.approx(-0.8, abs=0.01)
    assert angles(pilot, "r_shoulder")[1.0] > -0.2


async def test_a_gentle_interrupt_ends_it_at_its_next_exit(pilot: RealizerPilot) -> None:
    pilot.block("b", '<bmlt:keyframe id="k" name="wave" start="0"/>')
    pilot.block("c", '<bmla:interrupt id="i" target="b" start="0.5" speech="WORD"/>')
    await pilot.advance(3)
    assert after_start(pilot, "k:up", "k:end") == [1.0, 1.0]


async def test_another_interrupt_ends_it_at_once(pilot: RealizerPilot) -> None:
    pilot.block("b", '<bmlt:keyframe id="k" name="wave" start="0"/>')
    pilot.block("c", '<bmla:interrupt id="i" target="b" start="0.5"/>')
    await pilot.advance(3)
    assert pilot.feedback.time("b:k:end") == 0.5
    assert "b:k:up" not in pilot.feedback.progress


async def test_a_successor_may_take_over_at_an_exit(pilot: RealizerPilot) -> None:
    pilot.block(
        "b", '<bmlt:keyframe id="k" name="wave" start="0"/><bmlt:procanimation id="p" name="swing" start="k:up"/>'
    )
    await pilot.advance(4)
    assert not pilot.feedback.warnings
    assert after_start(pilot, "k:end", "p:end") == [1.0, 3.0]
    turns = np.array(list(angles(pilot, "r_shoulder").values()))
    assert np.abs(np.diff(turns)).max() < 0.12


async def test_elsewhere_the_arm_is_busy(pilot: RealizerPilot) -> None:
    pilot.block(
        "b", '<bmlt:keyframe id="k" name="wave" start="0"/><bmlt:procanimation id="p" name="swing" start="1.2"/>'
    )
    await pilot.advance(4)
    assert pilot.feedback.warnings == [("b:p", "IMPOSSIBLE_TO_SCHEDULE")]


async def test_joints_of_a_clip_that_the_figure_lacks_are_reported_and_logged_once(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    rows = "0 1 0 0 0 1 0 0 0 1 1 0 0 0 1 0 0 0"
    wagging = f'<SkeletonInterpolator parts="skullbase tail" encoding="R">{rows}</SkeletonInterpolator>'
    (tmp_path / "wagging.xml").write_text(wagging)
    async with open_pilot(SceneOptions(voice="text", assets=(tmp_path,))) as pilot:
        for number in range(2):
            pilot.block(f"b{number}", '<bmlt:keyframe id="k" name="wagging"/>')
            await pilot.advance(1.5)
        assert pilot.feedback.warnings == [("b0:k", "EXECUTION_FAILURE"), ("b1:k", "EXECUTION_FAILURE")]
        assert told(pilot).endswith(
            "tail stay still: the motion of <keyframe> does not turn them, or the character does not have them"
        )
        assert {"b0:k:end", "b1:k:end"} <= set(pilot.feedback.progress)
    assert caplog.text.count("wagging.xml: joints that the clip or the figure lacks are left out: tail") == 1


async def test_joints_of_an_animation_that_the_figure_lacks_are_reported_if_the_behavior_names_the_file(
    tmp_path: Path,
) -> None:
    turns = "".join(f'<Rotation target="{joint}" rotation="0.2*t;0;0"/>' for joint in ("vc4", "tail", "r_ear"))
    (tmp_path / "wagging.xml").write_text(f'<ProcAnimation prefDuration="1">{turns}</ProcAnimation>')
    (tmp_path / "gesturebinding.xml").write_text(
        """<gesturebinding><MotionUnitSpec type="gesture">
        <constraints><constraint name="lexeme" value="WAG"/></constraints>
        <MotionUnit type="ProcAnimation" file="wagging.xml"/>
        </MotionUnitSpec></gesturebinding>"""
    )
    async with open_pilot(SceneOptions(voice="text", assets=(tmp_path,))) as pilot:
        pilot.block("b", '<bmlt:procanimation id="p" name="wagging"/><gesture id="g" lexeme="WAG" start="2"/>')
        await pilot.advance(4)
        assert pilot.feedback.warnings == [("b:p", "EXECUTION_FAILURE")]
        assert "r_ear, tail stay still" in told(pilot)
        assert {"b:p:end", "b:g:end"} <= set(pilot.feedback.progress)
