"""Combination of the motions of one character: which motion is visible, added, or visible again (thesis 8.7.5)."""

from collections.abc import AsyncIterator
from pathlib import Path

import numpy as np
import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

ENTRY = """
<MotionUnitSpec type="gesture">
  <constraints><constraint name="lexeme" value="{0}"/></constraints>
  <parameterdefaults><parameterdefault name="replacementgroup" value="{1}"/></parameterdefaults>
  <MotionUnit type="ProcAnimation" file="{0}.xml"/>
</MotionUnitSpec>
"""
BENT = """
<ProcAnimation prefDuration="{1}">
  <Rotation target="{0}_elbow" rotation="0 - {2};0;0"/><Rotation target="{0}_wrist" rotation="0;0;0"/>
</ProcAnimation>
"""


@pytest.fixture
async def pilot(tmp_path: Path) -> AsyncIterator[RealizerPilot]:
    """A pilot with three gestures: two that bend the right elbow, more and less, and one for the left elbow."""
    for name, motion in {"MUCH": ("r", 4, 1.2), "LITTLE": ("r", 2, 0.6), "OTHER": ("l", 2, 0.9)}.items():
        (tmp_path / f"{name}.xml").write_text(BENT.format(*motion), encoding="utf-8")
    entries = "".join(ENTRY.format(name, "elbows") for name in ("MUCH", "LITTLE", "OTHER"))
    (tmp_path / "gesturebinding.xml").write_text(f"<gesturebinding>{entries}</gesturebinding>", encoding="utf-8")
    async with open_pilot(SceneOptions(voice="text", assets=(tmp_path,), verify=True)) as pilot:
        pilot.watch()
        await pilot.advance(0.1)
        yield pilot


def turned(pilot: RealizerPilot, joint: str) -> np.ndarray:
    """How far a joint is turned from the default pose in each frame, rad."""
    joints = pilot.realizer.characters["alice"].humanoid.avatar.skeleton.joints
    w = np.array([frame.rotations for frame in pilot.frames["alice"]])[:, joints.index(joint), 0]
    angles: np.ndarray = 2.0 * np.arccos(np.clip(np.abs(w), 0.0, 1.0))
    return angles


def at(path: np.ndarray, time: float) -> float:
    return float(path[round(time * 50)])


async def test_the_latest_motion_of_a_group_is_visible_and_then_the_earlier_one_again(pilot: RealizerPilot) -> None:
    pilot.block("a", '<gesture id="long" lexeme="MUCH"/>')
    pilot.block("b", '<gesture id="short" lexeme="LITTLE" start="1"/>')
    await pilot.advance(6)
    elbow, begin = turned(pilot, "r_elbow"), pilot.feedback.time("a:long:start")
    assert [at(elbow, begin + time) for time in (0.8, 2.0, 3.8)] == pytest.approx([1.2, 0.6, 1.2], abs=0.02)
    assert pilot.feedback.warnings == []
    assert pilot.feedback.time("b:short:end") == begin + 3.0
    assert pilot.feedback.time("a:long:end") == begin + 4.0


async def test_joints_that_a_later_motion_does_not_use_follow_the_earlier_one(pilot: RealizerPilot) -> None:
    pilot.block("a", '<gesture id="right" lexeme="MUCH"/><gesture id="left" lexeme="OTHER" start="1"/>')
    await pilot.advance(6)
    begin = pilot.feedback.time("a:right:start")
    assert at(turned(pilot, "r_elbow"), begin + 2.0) == pytest.approx(1.2, abs=0.02)
    assert at(turned(pilot, "l_elbow"), begin + 2.0) == pytest.approx(0.9, abs=0.02)


async def test_of_two_simultaneous_motions_the_shorter_one_is_visible_first(pilot: RealizerPilot) -> None:
    pilot.block("a", '<gesture id="long" lexeme="MUCH"/><gesture id="short" lexeme="LITTLE"/>')
    await pilot.advance(6)
    elbow, begin = turned(pilot, "r_elbow"), pilot.feedback.time("a:long:start")
    assert [at(elbow, begin + time) for time in (1.5, 3.5)] == pytest.approx([0.6, 1.2], abs=0.02)
    assert pilot.feedback.warnings == []


async def test_one_of_two_motions_with_equal_times_and_group_is_dropped_with_a_warning(pilot: RealizerPilot) -> None:
    both = '<gesture id="p" lexeme="MUCH" start="0" end="3"/><gesture id="q" lexeme="LITTLE" start="0" end="3"/>'
    pilot.block("a", both)
    await pilot.advance(6)
    assert pilot.feedback.warnings == [("a:q", "IMPOSSIBLE_TO_SCHEDULE")]
    assert at(turned(pilot, "r_elbow"), 1.5) == pytest.approx(1.2, abs=0.02)


async def test_a_motion_that_becomes_visible_again_fades_in(pilot: RealizerPilot) -> None:
    pilot.block("a", '<gesture id="long" lexeme="MUCH"/><gesture id="short" lexeme="LITTLE" start="1"/>')
    await pilot.advance(3.9)
    elbow = turned(pilot, "r_elbow")[round(pilot.feedback.time("a:short:end") * 50) :]
    assert elbow[0] == pytest.approx(0.6, abs=0.02)
    assert elbow[-1] == pytest.approx(1.2, abs=0.02)
    # Eased over 0.6 s, not as fast as an elbow may turn.
    assert np.diff(elbow).max() < 0.05


async def test_an_interrupted_motion_fades_out_over_the_motion_below(pilot: RealizerPilot) -> None:
    pilot.block("a", '<gesture id="long" lexeme="MUCH"/>')
    pilot.block("b", '<gesture id="short" lexeme="LITTLE" start="0.7"/>')
    await pilot.advance(2)
    pilot.block("stop", '<bmla:interrupt id="i" target="b"/>')
    await pilot.advance(1.5)
    elbow = turned(pilot, "r_elbow")[105:]
    assert elbow[0] == pytest.approx(0.6, abs=0.02)
    assert elbow[-1] == pytest.approx(1.2, abs=0.02)
    assert np.diff(elbow).max() < 0.05


async def test_a_behavior_may_set_its_replacement_group(pilot: RealizerPilot) -> None:
    spans = (2.1, 2.4), (2.6, 4.9), (5.7, 6.9)
    group = '<bmlt:parameter name="replacementgroup" value="hands"/>'
    pilot.block(
        "a",
        f"""
        <gesture id="offer" lexeme="OFFER" mode="RIGHT_HAND" start="0" strokeEnd="2" relax="7">{group}</gesture>
        <gesture id="beat" lexeme="BEAT" mode="RIGHT_HAND" start="2.5" end="5">{group}</gesture>
        """,
    )
    await pilot.advance(9)
    hand, begin = pilot.path("r_wrist"), pilot.feedback.time("a:start")
    before, during, after = (hand[round((begin + t) * 50) : round((begin + u) * 50)] for t, u in spans)
    assert np.ptp(np.concatenate((before, after)), axis=0).max() < 0.03, "the offer is held"
    assert np.ptp(during, axis=0).max() > 0.1
    assert pilot.feedback.warnings == []
    assert pilot.feedback.time("a:beat:end") == begin + 5.0


async def test_a_glance_of_the_eyes_leaves_the_head_where_it_was(pilot: RealizerPilot) -> None:
    pilot.block("a", '<gazeShift id="there" target="bluebox" influence="HEAD"/>')
    await pilot.advance(3)
    pilot.block("b", '<gaze id="glance" target="greensphere" influence="EYES"/>')
    await pilot.advance(3)
    head, eye = turned(pilot, "skullbase"), turned(pilot, "l_eyeball_joint")
    assert head[140] > 0.1
    assert np.abs(head[145:] - head[140]).max() < 0.05
    assert np.ptp(eye[145:]) > 0.2


async def test_a_nod_adds_to_the_current_head_direction(pilot: RealizerPilot) -> None:
    pilot.block("a", '<gazeShift id="aside" target="bluebox" influence="HEAD"/>')
    await pilot.advance(3)
    before = len(pilot.frames["alice"])
    pilot.block("b", '<head id="nod" lexeme="NOD" amount="1"/>')
    await pilot.advance(3)
    chain = ("vc4", "skullbase")
    joints = pilot.realizer.characters["alice"].humanoid.avatar.skeleton.joints
    turns = np.array([frame.rotations for frame in pilot.frames["alice"]])[:, [joints.index(joint) for joint in chain]]
    yaw = 2.0 * np.arctan2(turns[:, :, 2], turns[:, :, 0]).sum(axis=1)
    pitch = 2.0 * np.arctan2(turns[:, :, 1], turns[:, :, 0]).sum(axis=1)
    assert abs(yaw[before - 1]) > 0.15
    assert np.abs(yaw[before:] - yaw[before - 1]).max() < 0.06
    assert np.ptp(pitch[before:]) > 0.1


async def test_a_shift_that_uses_fewer_joints_releases_the_trunk_smoothly(pilot: RealizerPilot) -> None:
    pilot.block("a", '<gazeShift id="whole" target="bluebox" influence="WAIST"/>')
    await pilot.advance(3)
    trunk = turned(pilot, "vl5")[-1]
    pilot.block("b", '<gazeShift id="eyes" target="greensphere" influence="EYES"/>')
    await pilot.advance(4)
    path = turned(pilot, "vl5")
    assert trunk > 0.03
    assert path[-1] < 0.5 * trunk
    assert np.abs(np.diff(path)).max() < 0.1 * trunk
