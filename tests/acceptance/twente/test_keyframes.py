"""Keys and captures, of files or of BML itself (thesis C.1.2)."""

from pathlib import Path
from threading import current_thread

import numpy as np
import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.engines.animation.keyframe import clip_cache
from reactive_realizer.engines.animation.keyframe.capture import Capture
from reactive_realizer.engines.animation.keyframe.capture_reader import read_capture
from reactive_realizer.testing.pilot import open_pilot

from .motions import BOW, WAVE, after_start, angles, told


@pytest.mark.parametrize("inside", ["", WAVE, WAVE.replace("<SkeletonInterpolator", '<SkeletonInterpolator xmlns=""')])
async def test_keys_of_a_file_or_of_bml_itself_are_played(pilot, inside) -> None:
    name = "" if inside else 'name="wave"'
    pilot.block("b", f'<bmlt:keyframe id="k" {name} start="0">{inside}</bmlt:keyframe>')
    await pilot.advance(3)
    assert not pilot.feedback.warnings
    assert after_start(pilot, "k:up", "k:end") == [1.0, 2.0]
    shown = angles(pilot, "r_shoulder")
    assert [shown[time] for time in (0.5, 1.0, 1.5)] == pytest.approx([-0.4, -0.8, -0.5], abs=0.01)


async def test_keys_are_played_in_the_time_that_bml_gives_them(pilot) -> None:
    pilot.block("b", '<bmlt:keyframe id="k" name="wave" start="0" end="4"/>')
    await pilot.advance(5)
    assert angles(pilot, "r_shoulder")[2.0] == pytest.approx(-0.8, abs=0.01)


async def test_a_capture_is_played_by_its_name(pilot) -> None:
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
async def test_a_capture_is_read_once_and_aside_of_the_ticks_also_if_it_is_wrong(
    pilot, tmp_path, monkeypatch, frames, warnings
) -> None:
    threads = []

    def read(path: Path) -> Capture:
        threads.append(current_thread())
        return read_capture(path)

    monkeypatch.setattr(clip_cache, "read_capture", read)
    (tmp_path / "captures" / "bow.bvh").write_text(BOW.replace("Frames: 3", f"Frames: {frames}"))
    pilot.block("b", '<bmlt:keyframe id="k" name="bow" start="0"/><wait id="w" start="0" end="1"/>')
    await pilot.advance(2)
    assert pilot.feedback.warnings == warnings
    assert "b:w:end" in pilot.feedback.progress
    assert len(threads) == 1
    assert current_thread() not in threads


async def test_a_keyframe_animation_is_mirrored_first_and_then_confined_to_joints(pilot) -> None:
    """Thesis C.1.2."""
    mirror = '<bmlt:parameter name="mirror" value="true"/><bmlt:parameter name="joints" value="l_shoulder"/>'
    pilot.block("b", f'<bmlt:keyframe id="k" name="wave" start="0">{mirror}</bmlt:keyframe>')
    await pilot.advance(1.2)
    assert not pilot.feedback.warnings
    assert angles(pilot, "l_shoulder")[1.0] == pytest.approx(-0.8, abs=0.01)
    assert angles(pilot, "r_shoulder")[1.0] > -0.2


async def test_a_gentle_interrupt_lets_it_go_on_to_the_next_point_where_it_may_be_left(pilot) -> None:
    pilot.block("b", '<bmlt:keyframe id="k" name="wave" start="0"/>')
    pilot.block("c", '<bmla:interrupt id="i" target="b" start="0.5" speech="WORD"/>')
    await pilot.advance(3)
    assert after_start(pilot, "k:up", "k:end") == [1.0, 1.0]


async def test_another_interrupt_breaks_it_off(pilot) -> None:
    pilot.block("b", '<bmlt:keyframe id="k" name="wave" start="0"/>')
    pilot.block("c", '<bmla:interrupt id="i" target="b" start="0.5"/>')
    await pilot.advance(3)
    assert pilot.feedback.time("b:k:end") == 0.5
    assert "b:k:up" not in pilot.feedback.progress


async def test_a_successor_may_take_over_at_such_a_point(pilot) -> None:
    pilot.block(
        "b", '<bmlt:keyframe id="k" name="wave" start="0"/><bmlt:procanimation id="p" name="swing" start="k:up"/>'
    )
    await pilot.advance(4)
    assert not pilot.feedback.warnings
    assert after_start(pilot, "k:end", "p:end") == [1.0, 3.0]
    turns = np.array(list(angles(pilot, "r_shoulder").values()))
    assert np.abs(np.diff(turns)).max() < 0.12


async def test_where_it_may_not_be_left_the_arm_is_taken(pilot) -> None:
    pilot.block(
        "b", '<bmlt:keyframe id="k" name="wave" start="0"/><bmlt:procanimation id="p" name="swing" start="1.2"/>'
    )
    await pilot.advance(4)
    assert pilot.feedback.warnings == [("b:p", "IMPOSSIBLE_TO_SCHEDULE")]


async def test_what_a_clip_turns_and_the_figure_has_not_is_told_of_each_behavior_and_logged_once(
    tmp_path, caplog
) -> None:
    rows = "0 1 0 0 0 1 0 0 0 1 1 0 0 0 1 0 0 0"
    wagging = f'<SkeletonInterpolator parts="skullbase tail" encoding="R">{rows}</SkeletonInterpolator>'
    (tmp_path / "wagging.xml").write_text(wagging)
    async with open_pilot(SceneOptions(voice="text", assets=(tmp_path,))) as pilot:
        for number in range(2):
            pilot.block(f"b{number}", '<bmlt:keyframe id="k" name="wagging"/>')
            await pilot.advance(1.5)
        assert pilot.feedback.warnings == [("b0:k", "EXECUTION_FAILURE"), ("b1:k", "EXECUTION_FAILURE")]
        assert told(pilot).endswith("tail are left out: what plays <keyframe> does not turn them, or the figure cannot")
        assert {"b0:k:end", "b1:k:end"} <= set(pilot.feedback.progress)
    assert caplog.text.count("wagging.xml leaves out what it has not, or the figure has not: tail") == 1


async def test_what_a_procedural_animation_turns_and_the_figure_has_not_is_told_where_a_planner_names_the_file(
    tmp_path,
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
        assert "r_ear, tail are left out" in told(pilot)
        assert {"b:p:end", "b:g:end"} <= set(pilot.feedback.progress)
