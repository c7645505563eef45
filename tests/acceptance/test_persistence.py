"""Behaviors that persist until they are ended (thesis 6.3; gaze and posture of drafts)."""

from collections.abc import AsyncIterator

import numpy as np
import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.clock.clock import ManualClock
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.realizer.session import run_until_done
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

LOOK = '<bml id="a"><gaze id="look" type="AT" target="bluebox"/>{}</bml>'
TURN = '<gaze id="turn" target="greensphere" influence="HEAD"/>'


@pytest.fixture
async def pilot() -> AsyncIterator[RealizerPilot]:
    async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
        pilot.watch()
        yield pilot


def points(pilot: RealizerPilot, behavior: str) -> list[str]:
    """The sync points that a behavior has reached."""
    return [id_.rpartition(":")[2] for id_ in pilot.feedback.progress if id_.startswith(f"{behavior}:")]


def yaw(pilot: RealizerPilot) -> np.ndarray:
    """How far the head is turned to the figure's left in each frame, rad."""
    skeleton = pilot.realizer.characters["alice"].humanoid.avatar.skeleton
    joints = [skeleton.joints.index(joint) for joint in skeleton.chain("skullbase")]
    turns = np.array([frame.rotations for frame in pilot.frames["alice"]])[:, joints]
    total: np.ndarray = 2 * np.arctan2(turns[:, :, 2], turns[:, :, 0]).sum(axis=1)
    return total


async def test_a_gaze_of_a_draft_without_an_end_continues_until_it_is_interrupted(pilot: RealizerPilot) -> None:
    pilot.perform(LOOK.format(""))
    await pilot.advance(60)
    assert points(pilot, "a:look") == ["start", "ready"]
    pilot.block("stop", '<bmla:interrupt xmlns:bmla="http://www.asap-project.org/bmla" id="i" target="a"/>')
    await pilot.advance(1)
    assert pilot.feedback.time("a:look:relax") == pilot.feedback.time("a:look:end") == 60
    assert pilot.feedback.time("a:end") == 60
    assert pilot.feedback.status("a") == "INTERRUPTED"
    assert not pilot.feedback.warnings


async def test_the_end_of_a_persistent_behavior_is_not_predicted(
    pilot: RealizerPilot,
) -> None:
    pilot.perform(LOOK.format(""))
    await pilot.advance(1)
    last = pilot.feedback.predictions("a")[-1]
    (gaze,) = last.element.iter("{*}gaze")
    assert "ready" in gaze.attrib
    assert "end" not in gaze.attrib
    assert pilot.feedback.predicted("a:end") == pilot.feedback.time("a:look:ready")


async def test_a_behavior_tied_to_the_end_of_a_persistent_one_waits_for_it(pilot: RealizerPilot) -> None:
    pilot.perform(LOOK.format(""))
    pilot.block("b", '<head id="nod" lexeme="NOD" start="a:look:end + 0.5"/>')
    await pilot.advance(5)
    assert points(pilot, "b:nod") == []
    pilot.block("stop", '<bmla:interrupt xmlns:bmla="http://www.asap-project.org/bmla" id="i" target="a"/>')
    await pilot.advance(2)
    assert pilot.feedback.time("b:nod:start") == 5.5
    assert not pilot.feedback.warnings


async def test_an_appended_block_does_not_wait_for_persistent_behaviors_which_is_reported_once(
    pilot: RealizerPilot,
) -> None:
    pilot.perform(LOOK.format('<head id="nod" lexeme="NOD" start="2"/>'))
    await pilot.advance(0.5)
    pilot.block("b", '<head id="nod" lexeme="NOD"/>', composition="APPEND")
    await pilot.advance(9)
    assert pilot.feedback.time("b:start") == pilot.feedback.time("a:nod:end")
    assert pilot.feedback.warnings == [("b", "IMPOSSIBLE_TO_SCHEDULE")]


async def test_a_persistent_gaze_is_visible_again_after_a_later_one(pilot: RealizerPilot) -> None:
    pilot.perform(LOOK.format(""))
    await pilot.advance(3)
    pilot.block("b", TURN)
    await pilot.advance(6)
    head = yaw(pilot)
    there, ready, relax = 140, pilot.feedback.time("b:turn:ready"), pilot.feedback.time("b:turn:relax")
    aside = head[round((ready + relax) / 2 * 50)]
    assert abs(aside - head[there]) > 0.2
    assert head[-1] == pytest.approx(head[there], abs=0.05)
    assert not pilot.feedback.warnings
    assert points(pilot, "a:look") == ["start", "ready"]


async def test_replacing_everything_ends_a_persistent_gaze_and_the_head_returns_to_rest(pilot: RealizerPilot) -> None:
    await pilot.advance(0.1)
    pilot.perform(LOOK.format(""))
    await pilot.advance(3)
    pilot.block("new", composition="REPLACE")
    await pilot.advance(3)
    assert pilot.feedback.status("a") == "INTERRUPTED"
    head = yaw(pilot)
    assert head[-1] == pytest.approx(head[0], abs=0.05)


async def test_one_of_two_simultaneous_persistent_gazes_is_dropped(pilot: RealizerPilot) -> None:
    pilot.perform(LOOK.format('<gaze id="other" type="AT" target="greensphere"/>'))
    await pilot.advance(3)
    assert len(pilot.feedback.warnings) == 1
    assert points(pilot, "a:look") == ["start", "ready"]
    assert points(pilot, "a:other") == []


async def test_a_session_ends_without_a_warning_when_only_persistent_behaviors_are_left(pilot: RealizerPilot) -> None:
    pilot.perform(LOOK.format(""))
    await run_until_done(pilot.realizer, ManualClock(), GlobalTime(600.0))
    assert pilot.feedback.warnings == []


async def test_a_session_that_ends_names_what_waits_for_the_end_of_a_persistent_behavior(pilot: RealizerPilot) -> None:
    pilot.perform(LOOK.format('<head id="nod" type="NOD" start="look:end"/>'))
    await run_until_done(pilot.realizer, ManualClock(), GlobalTime(600.0))
    (warning,) = pilot.feedback.of("warningFeedback")
    assert warning.id == "a"
    assert "a:look:end" in warning.text
