"""Elements of BMLT that play animations as authored (thesis app. C)."""

from pathlib import Path

import numpy as np
import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .motions import angles, told


async def test_a_procedural_animation_is_found_by_its_name_and_takes_parameters(pilot: RealizerPilot) -> None:
    pilot.block(
        "b",
        '<bmlt:procanimation id="p" name="swing" start="0"><bmlt:parameter name="a" value="0.2"/></bmlt:procanimation>',
    )
    await pilot.advance(3)
    assert not pilot.feedback.warnings
    assert pilot.feedback.time("b:p:end") == 2.0
    assert angles(pilot, "r_shoulder")[0.5] == pytest.approx(-0.8, abs=0.01)


async def test_a_procedural_animation_is_found_by_its_file_too(pilot: RealizerPilot) -> None:
    pilot.block("b", '<bmlt:procanimation id="p" fileName="Humanoids/moves/swing.xml" start="0"/>')
    await pilot.advance(3)
    assert not pilot.feedback.warnings
    assert angles(pilot, "r_shoulder")[0.5] == pytest.approx(-1.1, abs=0.01)


async def test_the_key_positions_of_an_animation_are_sync_points_that_others_name(pilot: RealizerPilot) -> None:
    """Thesis, example 47: beats of a conducting pattern on ticks."""
    pilot.block(
        "b",
        """
        <bmlt:procanimation id="conduct" name="swing"/>
        <head id="nod" lexeme="NOD" start="conduct:beat2"/>
        <constraint><synchronize><sync ref="conduct:start"/><sync ref="1"/></synchronize></constraint>
        <constraint><synchronize><sync ref="conduct:beat1"/><sync ref="2"/></synchronize></constraint>
        <constraint><synchronize><sync ref="conduct:beat2"/><sync ref="2.4"/></synchronize></constraint>
        """,
    )
    await pilot.advance(5)
    assert not pilot.feedback.warnings
    told = [
        pilot.feedback.time(f"b:{point}") for point in ("conduct:start", "conduct:beat1", "conduct:beat2", "nod:start")
    ]
    assert told == [1.0, 2.0, 2.4, 2.4]
    assert angles(pilot, "r_shoulder")[2.0] == pytest.approx(-1.1, abs=0.02)
    assert angles(pilot, "r_shoulder")[2.4] == pytest.approx(-0.1, abs=0.07)  # the hand keeps off the thigh


async def test_an_unknown_sync_point_is_reported_with_the_known_ones(
    pilot: RealizerPilot,
) -> None:
    pilot.block("b", '<bmlt:procanimation id="p" name="swing"/><head id="nod" lexeme="NOD" start="p:beat3"/>')
    await pilot.advance(3)
    assert pilot.feedback.warnings == [("b:nod", "IMPOSSIBLE_TO_SCHEDULE")]
    assert "'p' has no sync point 'beat3'" in told(pilot)
    assert "beat1" in told(pilot)


async def test_a_point_of_its_own_may_be_tied_by_an_attribute_of_its_name(pilot: RealizerPilot) -> None:
    pilot.block("b", '<bmlt:procanimation id="a" name="conduct-3-beat" start="0.3" beat2="2.1"/>')
    await pilot.advance(6)
    assert pilot.feedback.time("b:a:start") == 0.3
    assert pilot.feedback.time("b:a:beat2") == 2.1
    assert pilot.feedback.warnings == []


async def test_an_attribute_that_names_no_sync_point_drops_the_behavior_with_the_known_ones(
    pilot: RealizerPilot,
) -> None:
    pilot.block("b", '<bmlt:procanimation id="a" name="conduct-3-beat" beat9="2.5"/>')
    await pilot.advance(1)
    (warning,) = pilot.feedback.of("warningFeedback")
    assert "beat9" in warning.text
    assert "beat1, beat2, beat3" in warning.text


async def test_an_animation_played_as_a_gesture_has_a_preparation_and_a_retraction(pilot: RealizerPilot) -> None:
    pilot.block("b", '<bmlt:procanimationgesture id="p" name="swing" start="0"/>')
    await pilot.advance(6)
    assert not pilot.feedback.warnings
    times = [pilot.feedback.time(f"b:p:{sync}") for sync in ("start", "ready", "relax", "end")]
    assert times == sorted(times)
    assert times[1] > 0.2
    assert times[3] > times[2] + 0.2


async def test_a_block_may_have_keys_animations_and_noise_together(pilot: RealizerPilot, tests_data: Path) -> None:
    pilot.perform((tests_data / "bml" / "twente.xml").read_bytes())
    await pilot.advance(4)
    assert not pilot.feedback.warnings
    assert angles(pilot, "l_wrist", 2)[2.0] == pytest.approx(0.6, abs=0.02)
    assert np.ptp(list(angles(pilot, "skullbase").values())) > 0.05
    assert np.ptp(list(angles(pilot, "vl5").values())) > 0.015


async def test_asaprealizers_examples_play(shared_cases: Path) -> None:
    for path, joint in {
        "bmlt-internalkeyframe.xml": "skullbase",
        "bmlt-perlin_noise_random_movement.xml": "vl5",
        "bmlt-procanimation.xml": "skullbase",
    }.items():
        async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
            pilot.watch()
            pilot.perform((shared_cases / "asap" / "bml" / path).read_bytes())
            await pilot.advance(4)
            assert not pilot.feedback.warnings
            assert max(np.ptp(list(angles(pilot, joint, axis).values())) for axis in (1, 2, 3)) > 0.015
