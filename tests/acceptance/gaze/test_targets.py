"""Targets of gazes (BML 1.0: target, offsetAngle, offsetDirection; BMLT: dynamic), in frames."""

import math
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.vector import distance, subtract, unit
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .seen import EYES, FAR, GLANCE, PLATEAU, at, between, miss, place, put, sight, speeds

OFFSETS = [
    ("RIGHT", -1, 0),
    ("LEFT", 1, 0),
    ("UP", 0, 1),
    ("DOWN", 0, -1),
    ("UPRIGHT", -1, 1),
    ("UPLEFT", 1, 1),
    ("DOWNRIGHT", -1, -1),
    ("DOWNLEFT", 1, -1),
]


@pytest.mark.parametrize(("side", "left", "up"), OFFSETS)
async def test_an_offset_is_an_angle_to_a_side(pilot: RealizerPilot, side: str, left: int, up: int) -> None:
    put(pilot, "t", 10, 5, FAR)
    offset = f'offsetAngle="12" offsetDirection="{side}"'
    pilot.block("b", f'<gaze id="g" target="t" {offset} start="0" end="4"/>')
    await pilot.advance(2)
    looks = sight(pilot.bodies()[-1])
    toward = unit(subtract(place(pilot, 10, 5, FAR), place(pilot, 0, 0, 0.0)))
    assert between(looks, toward) == pytest.approx(12, abs=0.1)
    before, after = ((math.degrees(math.atan2(x, z)), math.degrees(math.asin(y))) for x, y, z in (toward, looks))
    assert [round((b - a) / 12) for a, b in zip(before, after, strict=True)] == [left, up]


async def test_only_a_dynamic_gaze_follows_a_moving_target(pilot: RealizerPilot) -> None:
    for follow in ("true", "false"):
        pilot.move("t", place(pilot, 0, 0))
        pilot.block(f"b-{follow}", f'<gaze id="g" target="t" bmlt:dynamic="{follow}" start="0" end="4"/>')
        await pilot.advance(1)
        first = len(pilot.bodies())
        there = place(pilot, 0, 0)
        for degrees in range(1, 21):
            there = place(pilot, degrees, 0)
            pilot.move("t", there)
            await pilot.advance(0.04)
        missed = [miss(pilot.bodies()[-1], there), miss(pilot.bodies()[-1], place(pilot, 0, 0))]
        assert (missed[0] < 0.5) == (follow == "true")
        assert (missed[1] < 0.5) == (follow == "false")
        assert max(speeds(pilot.bodies()[first:])) < 2
        await pilot.advance(4)


async def test_dynamic_must_be_true_or_false(pilot: RealizerPilot) -> None:
    pilot.move("t", place(pilot, 0, 0))
    pilot.block("b", '<gaze id="g" target="t" bmlt:dynamic="TRUE"/><gaze id="h" target="t" bmlt:dynamic="maybe"/>')
    await pilot.advance(0.1)
    assert pilot.feedback.warnings == [("b:h", "CANNOT_CREATE_BEHAVIOR")]
    assert "dynamic='maybe' must be true or false" in pilot.feedback.of("warningFeedback")[0].text


@pytest.mark.parametrize(("shift", "joint"), [("gazeShift", EYES[0]), ("headDirectionShift", "skullbase")])
async def test_a_dynamic_shift_keeps_following_after_its_end(pilot: RealizerPilot, shift: str, joint: str) -> None:
    put(pilot, "t", 20, 0, FAR)
    pilot.block("b", f'<{shift} id="s" target="t" bmlt:dynamic="true" start="0"/>')
    await pilot.advance(2)
    there = put(pilot, "t", -20, 0, FAR)
    await pilot.advance(2)
    toward = unit(subtract(there, place(pilot, 0, 0, 0.0)))
    assert between(sight(pilot.bodies()[-1], joint), toward) < 3


async def test_a_target_that_jumps_is_caught_by_a_saccade_and_a_turn_of_the_head(pilot: RealizerPilot) -> None:
    put(pilot, "t", -25, 0)
    pilot.block("b", '<gaze id="g" target="t" bmlt:dynamic="true" start="0" end="6"/>')
    await pilot.advance(2)
    there = put(pilot, "t", 35, 10)
    await pilot.advance(1)
    shown = pilot.bodies()
    assert miss(shown[-1], there) < 0.5
    assert max(speeds(shown)) < PLATEAU + 0.2
    # A jump of 60 degrees takes the head as long as a gaze takes at first.
    assert 1.5 < max(speeds(shown, "skullbase")) < 5


async def test_a_gaze_stays_where_a_removed_target_was(pilot: RealizerPilot) -> None:
    there = put(pilot, "t", 25, 0)
    pilot.block("b", '<gaze id="g" target="t" bmlt:dynamic="true" start="0" end="4"/>')
    await pilot.advance(1)
    pilot.move("t", None)
    await pilot.advance(1)
    assert miss(pilot.bodies()[-1], there) < 0.5


async def test_a_static_gaze_looks_where_its_target_is_when_it_begins(pilot: RealizerPilot) -> None:
    put(pilot, "t", -25, 0)
    pilot.block("b", '<gaze id="g" target="t" start="1" end="4"/>')
    await pilot.advance(0.5)
    there = put(pilot, "t", 25, 0)
    await pilot.advance(2)
    assert miss(pilot.bodies()[-1], there) < 0.5


async def test_figures_look_at_each_other_and_at_each_others_joints(tests_data: Path) -> None:
    two = SceneOptions(human=tests_data / "humans" / "two.toml", voice="text")
    async with open_pilot(two) as pilot:
        pilot.watch()
        alice, bob = pilot.realizer.characters
        gaze = '<gaze id="g" target="{}" bmlt:dynamic="true" influence="WAIST" start="0" end="4"/>'
        pilot.block("a", gaze.format(f"{bob}:r_shoulder"), characterId=alice)
        pilot.block("b", gaze.format(f"{alice}:skullbase"), characterId=bob)
        await pilot.advance(2)
        hers, his = pilot.bodies(alice)[-1], pilot.bodies(bob)[-1]
    assert miss(hers, his.transform("r_shoulder").position) < 0.5
    assert miss(his, hers.transform("skullbase").position) < 0.5


async def test_a_gaze_before_the_first_frame_looks_at_a_hand_at_rest(tests_data: Path) -> None:
    two = SceneOptions(human=tests_data / "humans" / "two.toml", voice="text")
    async with open_pilot(two) as pilot:
        pilot.watch()
        alice, bob = pilot.realizer.characters
        pilot.block("a", f'<gaze id="g" target="{bob}:r_wrist" start="0" end="4"/>', characterId=alice)
        await pilot.advance(2)
        assert miss(pilot.bodies(alice)[-1], pilot.bodies(bob)[0].transform("r_wrist").position) < 1


@pytest.mark.parametrize("target", ["alice", "alice:l_eyeball_joint"])
@pytest.mark.parametrize("element", ["gaze", "gazeShift", "headDirectionShift"])
async def test_a_gaze_at_ones_own_eyes_looks_straight_ahead_with_one_warning(
    pilot: RealizerPilot, element: str, target: str
) -> None:
    pilot.block("b", f'<{element} id="g" target="{target}" start="0"/>')
    await pilot.advance(3)
    assert pilot.feedback.warnings == [("b:g", "EXECUTION_FAILURE")]
    ahead = [between(sight(body, eye), sight(body, "skullbase")) for body in pilot.bodies() for eye in EYES]
    assert max(ahead) < GLANCE


async def test_a_figure_may_look_at_its_own_hand_as_far_as_it_can(pilot: RealizerPilot) -> None:
    pilot.block("b", '<gaze id="g" target="alice:l_wrist" bmlt:dynamic="true" start="0" end="4"/>')
    await pilot.advance(2)
    body = pilot.bodies()[-1]
    # A hand that hangs is below and behind the eyes.
    assert miss(body, body.transform("l_wrist").position) < 10


async def misses(pilot: RealizerPilot, speed: float) -> list[float]:
    """Degrees by which eyes miss a target, frame by frame, that turns to and fro at a speed at most, rad/s."""
    put(pilot, "t", 0, 0)
    pilot.block("b", '<gaze id="g" target="t" bmlt:dynamic="true" start="0"  ready="0.3" end="6"/>')
    await pilot.advance(0.6)
    missed = []
    for tick in range(200):
        there = put(pilot, "t", math.degrees(0.5 * math.sin(0.02 * speed * tick)), 0)
        frames = len(pilot.frames["alice"])
        await pilot.tick()
        if len(pilot.frames["alice"]) > frames:
            missed.append(miss(pilot.bodies()[-1], there))
    return missed


async def test_eyes_follow_a_slow_target_without_a_lag(pilot: RealizerPilot) -> None:
    assert max(await misses(pilot, 1.7)) < 0.01


async def test_eyes_catch_up_with_a_fast_target_by_saccades(pilot: RealizerPilot) -> None:
    """C. H. Meyer, A. G. Lasker and D. A. Robinson (1985): eyes pursue at 100 degrees a second at most."""
    missed = await misses(pilot, 5.0)
    behind = [number for number, degrees in enumerate(missed) if degrees > 0.5]
    assert 1.0 < max(missed) < 6.0
    assert max(after - before for before, after in pairwise(n for n in range(100) if n not in behind)) <= 3
    assert max(speeds(pilot.bodies())) < PLATEAU


async def test_eyes_look_at_the_hand_of_another_figure_in_the_same_frame(tests_data: Path) -> None:
    two = SceneOptions(human=tests_data / "humans" / "two.toml", voice="text")
    async with open_pilot(two) as pilot:
        pilot.watch()
        names = list(pilot.realizer.characters)
        for looker, other in ((0, 1), (1, 0)):
            gaze = f'<gazeShift id="g" target="{names[other]}:r_wrist" bmlt:dynamic="true" start="0"/>'
            gesture = '<gesture id="o" lexeme="OFFER" mode="RIGHT_HAND" start="1"/>'
            pilot.block(f"b{looker}", gaze + gesture, characterId=names[looker])
        await pilot.advance(2.5)
        shown = [pilot.bodies(name)[50:] for name in names]
    for lookers, others in (shown, shown[::-1]):
        wrists = [body.transform("r_wrist").position for body in others]
        assert max(distance(a, b) for a, b in pairwise(wrists)) > 0.015
        assert max(miss(body, wrist) for body, wrist in zip(lookers, wrists, strict=True)) < 0.01


async def test_eyes_look_at_their_own_hand_in_the_same_frame(pilot: RealizerPilot) -> None:
    put(pilot, "t", 30, -5)
    gaze = '<gazeShift id="g" target="alice:l_wrist" bmlt:dynamic="true" influence="WAIST" start="0"/>'
    pilot.block("b", f'{gaze}<pointing id="p" target="t" mode="LEFT_HAND" start="1" ready="2.5" relax="3"/>')
    await pilot.advance(3)
    near = pilot.bodies()[100:]
    wrists = [body.transform("l_wrist").position for body in near]
    assert max(distance(a, b) for a, b in pairwise(wrists)) > 0.01
    assert max(miss(body, wrist) for body, wrist in zip(near, wrists, strict=True)) < 0.01


@pytest.mark.parametrize("element", ["gaze", "gazeShift", "headDirectionShift"])
async def test_a_gaze_at_an_unknown_target_is_dropped(pilot: RealizerPilot, element: str) -> None:
    pilot.block("b", f'<{element} id="g" target="nobody" start="0"/>')
    await pilot.advance(1)
    assert pilot.feedback.warnings == [("b:g", "NO_SUCH_TARGET")]


@pytest.mark.parametrize(("yaw", "pitch", "far"), [(180, 0, 2), (0, 0, 0), (0, 0, 0.02), (0, 90, 1), (0, -90, 1)])
@pytest.mark.parametrize("element", ['gaze influence="WAIST"', "headDirectionShift"])
async def test_frames_are_valid_for_any_target(
    pilot: RealizerPilot, element: str, yaw: int, pitch: int, far: float
) -> None:
    put(pilot, "t", yaw, pitch, far)
    pilot.block("b", f'<{element} id="g" target="t" start="0"/>')
    await pilot.advance(4)
    for frame in pilot.frames["alice"]:
        assert np.linalg.norm(frame.rotations, axis=1) == pytest.approx(1.0)
    assert pilot.feedback.reached("b:g:end")


async def test_a_target_may_be_a_point(pilot: RealizerPilot) -> None:
    pilot.block("b", '<gaze id="g" target="0.4 1.5 2" influence="EYES" start="0.2" end="2"/>')
    await pilot.advance(1.5)
    assert miss(pilot.bodies()[at(pilot, 1.2)], (0.4, 1.5, 2.0)) < 0.5
    assert pilot.feedback.warnings == []
