"""Behaviors that go on until they are ended (thesis 6.3; the drafts' gaze and posture)."""

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
    """Those that a behavior has reached."""
    return [id_.rpartition(":")[2] for id_ in pilot.feedback.progress if id_.startswith(f"{behavior}:")]


def yaw(pilot: RealizerPilot) -> np.ndarray:
    """How far the head is turned to the figure's left in each frame, rad."""
    skeleton = pilot.realizer.characters["alice"].humanoid.avatar.skeleton
    joints = [skeleton.joints.index(joint) for joint in skeleton.chain("skullbase")]
    turns = np.array([frame.rotations for frame in pilot.frames["alice"]])[:, joints]
    total: np.ndarray = 2 * np.arctan2(turns[:, :, 2], turns[:, :, 0]).sum(axis=1)
    return total


async def test_a_gaze_of_a_draft_without_an_end_goes_on_until_it_is_interrupted(pilot: RealizerPilot) -> None:
    pilot.perform(LOOK.format(""))
    await pilot.advance(60)
    assert points(pilot, "a:look") == ["start", "ready"]
    pilot.block("stop", '<bmla:interrupt xmlns:bmla="http://www.asap-project.org/bmla" id="i" target="a"/>')
    await pilot.advance(1)
    assert pilot.feedback.time("a:look:relax") == pilot.feedback.time("a:look:end") == 60
    assert pilot.feedback.time("a:end") == 60
    assert pilot.feedback.status("a") == "INTERRUPTED"
    assert not pilot.feedback.warnings


async def test_its_end_is_not_predicted_and_its_block_is_predicted_to_end_with_its_last_known_point(
    pilot: RealizerPilot,
) -> None:
    pilot.perform(LOOK.format(""))
    await pilot.advance(1)
    last = pilot.feedback.predictions("a")[-1]
    (gaze,) = last.element.iter("{*}gaze")
    assert "ready" in gaze.attrib
    assert "end" not in gaze.attrib
    assert pilot.feedback.predicted("a:end") == pilot.feedback.time("a:look:ready")


async def test_what_hangs_on_its_end_waits_and_starts_when_it_is_ended(pilot: RealizerPilot) -> None:
    pilot.perform(LOOK.format(""))
    pilot.block("b", '<head id="nod" lexeme="NOD" start="a:look:end + 0.5"/>')
    await pilot.advance(5)
    assert points(pilot, "b:nod") == []
    pilot.block("stop", '<bmla:interrupt xmlns:bmla="http://www.asap-project.org/bmla" id="i" target="a"/>')
    await pilot.advance(2)
    assert pilot.feedback.time("b:nod:start") == 5.5
    assert not pilot.feedback.warnings


async def test_an_appended_block_waits_for_all_else_of_its_block_and_is_told_so_once(pilot: RealizerPilot) -> None:
    pilot.perform(LOOK.format('<head id="nod" lexeme="NOD" start="2"/>'))
    await pilot.advance(0.5)
    pilot.block("b", '<head id="nod" lexeme="NOD"/>', composition="APPEND")
    await pilot.advance(9)
    assert pilot.feedback.time("b:start") == pilot.feedback.time("a:nod:end")
    assert pilot.feedback.warnings == [("b", "IMPOSSIBLE_TO_SCHEDULE")]


async def test_a_later_gaze_takes_its_place_and_gives_it_back(pilot: RealizerPilot) -> None:
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


async def test_a_block_that_replaces_all_ends_it_and_the_head_is_at_rest_again(pilot: RealizerPilot) -> None:
    await pilot.advance(0.1)
    pilot.perform(LOOK.format(""))
    await pilot.advance(3)
    pilot.block("new", composition="REPLACE")
    await pilot.advance(3)
    assert pilot.feedback.status("a") == "INTERRUPTED"
    head = yaw(pilot)
    assert head[-1] == pytest.approx(head[0], abs=0.05)


async def test_of_two_that_start_together_and_never_end_one_is_dropped(pilot: RealizerPilot) -> None:
    pilot.perform(LOOK.format('<gaze id="other" type="AT" target="greensphere"/>'))
    await pilot.advance(3)
    assert len(pilot.feedback.warnings) == 1
    assert points(pilot, "a:look") == ["start", "ready"]
    assert points(pilot, "a:other") == []


async def test_a_session_in_which_nothing_else_is_left_is_over_and_says_what_goes_on(pilot: RealizerPilot) -> None:
    pilot.perform(LOOK.format(""))
    await run_until_done(pilot.realizer, ManualClock(), GlobalTime(600.0))
    (warning,) = pilot.feedback.of("warningFeedback")
    assert warning.id == "a"
    assert "a:look:end" in warning.text
