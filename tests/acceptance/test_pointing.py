"""Pointing, from BML to frames: the finger's line meets the target (thesis 4.2.2)."""

import math
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from itertools import pairwise
from pathlib import Path
from random import Random

import numpy as np
import pytest

from reactive_realizer.assembly.assets import PACKAGE_ASSETS
from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.vector import dot, subtract, unit
from reactive_realizer.testing.pilot import RealizerPilot, block, open_pilot

ALICE = """
[character.alice]
avatar = "avatars/female.glb"
voice = "text"

[target.thing]
position = [-0.4, 1.2, 1.3]
"""
BOB = """
[character.bob]
avatar = "avatars/male.glb"
voice = "text"
position = [1.0, 0.0, 2.5]
heading = 200.0
"""
HOLD = '<pointing id="p" target="thing" mode="{}" start="0" ready="1" relax="{}"/>'
MODES = {"LEFT_HAND": "l", "RIGHT_HAND": "r"}


@asynccontextmanager
async def watched(folder: Path, humans: str) -> AsyncIterator[RealizerPilot]:
    human = folder / "human.toml"
    human.write_text(humans)
    async with open_pilot(SceneOptions(human=human, voice="text", verify=True)) as pilot:
        pilot.watch()
        yield pilot


@pytest.fixture
async def pilot(tmp_path: Path) -> AsyncIterator[RealizerPilot]:
    async with watched(tmp_path, ALICE) as pilot:
        yield pilot


@pytest.fixture
async def pair(tmp_path: Path) -> AsyncIterator[RealizerPilot]:
    async with watched(tmp_path, ALICE + BOB) as pilot:
        yield pilot


def miss(body: Body, side: str, target: tuple[float, float, float]) -> float:
    """The angle, degrees, between the line of the index finger and the way from its base to a target."""
    base, tip = (body.transform(f"{side}_index{i}").position for i in (1, 3))
    cosine = dot(unit(subtract(tip, base)), unit(subtract(target, base)))
    return math.degrees(math.acos(min(1.0, cosine)))


def misses(
    pilot: RealizerPilot, character: str, side: str, target: tuple[float, float, float], since: float, until: float
) -> list[float]:
    frames = zip(pilot.frames[character], pilot.bodies(character), strict=True)
    shown = [body for frame, body in frames if since <= frame.time <= until]
    assert len(shown) > 10
    return [miss(body, side, target) for body in shown]


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("character", ["alice", "bob"])
async def test_the_finger_is_on_its_target_from_ready_to_relax(pair: RealizerPilot, character: str, mode: str) -> None:
    random, met = Random(7), 0
    for i in range(8):
        x, y, z = (random.uniform(*span) for span in ((-1.5, 1.5), (0.3, 2.2), (0.5, 2.5)))
        # Bob faces about where Alice comes from.
        target = (x, y, z) if character == "alice" else (1.0 - x, y, 2.5 - z)
        pair.move("thing", target)
        begun = pair.now
        pair.perform(block(f"b{i}", HOLD.format(mode, 1.5), characterId=character))
        await pair.advance(3.5)
        if not any(id_ == f"b{i}:p" for id_, _ in pair.feedback.warnings):
            met += 1
            assert max(misses(pair, character, MODES[mode], target, begun + 1.05, begun + 1.5)) < 2.0
    assert met >= 5


async def test_a_target_that_moves_during_the_hold_is_followed(pilot: RealizerPilot) -> None:
    pilot.block("b", HOLD.format("RIGHT_HAND", 5))
    await pilot.advance(1.2)
    for i in range(300):
        target = (0.7 * math.sin(0.02 * i) - 0.4, 1.2 + 0.3 * math.sin(0.03 * i), 1.3)
        pilot.move("thing", target)
        await pilot.tick()
        if pilot.frames["alice"][-1].time >= pilot.now - 0.0101 and i > 2:
            assert miss(pilot.bodies("alice")[-1], "r", target) < 2.0
    assert pilot.feedback.warnings == []


@pytest.mark.parametrize(("who", "other"), [("alice", "bob"), ("bob", "alice")])
async def test_the_finger_follows_the_waving_hand_of_another_figure(pair: RealizerPilot, who: str, other: str) -> None:
    pointing = f'<pointing id="p" target="{other}:r_wrist" mode="LEFT_HAND" start="0" ready="1" relax="4"/>'
    pair.perform(block("b", pointing, characterId=who))
    pair.perform(block("w", '<gesture id="w" lexeme="GREET" mode="RIGHT_HAND" start="0.5"/>', characterId=other))
    await pair.advance(4.2)
    wrists = [body.transform("r_wrist").position for body in pair.bodies(other)][51:200]
    assert max(math.dist(a, b) for a, b in pairwise(wrists)) > 0.02, "more than 1 m/s"
    missed = [miss(body, "l", wrist) for body, wrist in zip(pair.bodies(who)[51:200], wrists, strict=True)]
    assert max(missed) < 1.0
    assert pair.feedback.warnings == []


async def test_gaze_and_breathing_do_not_move_the_finger_off_its_target(
    pair: RealizerPilot,
) -> None:
    pair.block("b", HOLD.format("LEFT_HAND", 6) + '<gaze id="g" target="bob" influence="WAIST" start="1.5" end="5"/>')
    await pair.advance(7)
    assert max(misses(pair, "alice", "l", (-0.4, 1.2, 1.3), 1.05, 6.0)) < 2.0


@pytest.mark.parametrize(
    "moved",
    [
        '<gaze id="g" target="bob" influence="WAIST" start="1.2" end="3"/>',
        '<gaze id="g" target="behind" influence="WAIST" start="1.2" end="3"/>',
        '<gaze id="g" target="behind" influence="WAIST" start="1.2" ready="1.4" end="3"/>',
        '<posture id="q" start="1.2"><stance type="SITTING"/></posture>',
        '<head id="h" lexeme="TILT_FORWARD" start="1.2"/>',
    ],
)
async def test_a_finger_that_points_across_the_body_stays_on_its_target_while_the_trunk_turns_or_leans(
    pair: RealizerPilot, moved: str
) -> None:
    across = (0.9, 1.2, 0.9)
    pair.move("thing", across)
    pair.move("behind", (-2.0, 1.2, 0.2))
    pair.block("b", HOLD.format("RIGHT_HAND", 4) + moved)
    await pair.advance(4)
    assert max(misses(pair, "alice", "r", across, 1.0, 4.0)) < 2.0
    assert pair.feedback.warnings == []


async def test_a_target_that_leaves_the_reach_is_reported_once_and_the_arm_stays_near(
    pilot: RealizerPilot,
) -> None:
    pilot.block("b", HOLD.format("RIGHT_HAND", 4))
    await pilot.advance(2)
    for i in range(100):
        pilot.move("thing", (0.4 * math.sin(0.03 * i), 1.2, 1.3 - 0.03 * i))
        await pilot.advance(0.01)
    await pilot.advance(4)
    told = pilot.feedback
    assert told.warnings == [("b:p", "EXECUTION_FAILURE")]
    assert "'thing'" in told.of("warningFeedback")[0].text
    assert told.time("b:p:relax") == 4.0
    assert told.reached("b:p:end")
    steps = np.linalg.norm(np.diff(pilot.path("r_wrist", "alice"), axis=0), axis=1)
    assert steps.max() < 0.05


async def test_a_target_that_vanishes_is_pointed_at_where_it_was(pilot: RealizerPilot) -> None:
    pilot.block("b", HOLD.format("RIGHT_HAND", 4))
    await pilot.advance(2)
    pilot.move("thing", None)
    await pilot.advance(3)
    assert max(misses(pilot, "alice", "r", (-0.4, 1.2, 1.3), 1.05, 4.0)) < 2.0
    assert pilot.feedback.warnings == []


@pytest.mark.parametrize(("x", "side"), [(-0.8, "r"), (0.8, "l")])
async def test_without_a_mode_the_hand_on_the_side_of_the_target_points(
    pilot: RealizerPilot, x: float, side: str
) -> None:
    pilot.move("thing", (x, 1.2, 1.3))
    pilot.block("b", '<pointing id="p" target="thing" start="0" ready="1" relax="2"/>')
    await pilot.advance(3)
    assert max(misses(pilot, "alice", side, (x, 1.2, 1.3), 1.05, 2.0)) < 2.0


async def test_if_that_hand_is_busy_the_other_one_points(pilot: RealizerPilot) -> None:
    pilot.block("busy", '<gesture id="g" lexeme="BEAT" mode="RIGHT_HAND" start="0" end="4"/>')
    pilot.block("b", '<pointing id="p" target="thing" start="0.5" ready="1.5" relax="2.5"/>')
    await pilot.advance(4)
    assert max(misses(pilot, "alice", "l", (-0.4, 1.2, 1.3), 1.55, 2.5)) < 2.0
    assert pilot.feedback.warnings == []


async def test_both_hands_point_at_once(pilot: RealizerPilot) -> None:
    pilot.block("b", HOLD.format("BOTH_HANDS", 2))
    await pilot.advance(3)
    for side in "lr":
        assert max(misses(pilot, "alice", side, (-0.4, 1.2, 1.3), 1.05, 2.0)) < 2.0


async def test_the_hand_speeds_up_once_and_slows_down_once_on_its_way(pilot: RealizerPilot) -> None:
    pilot.block("b", '<pointing id="p" target="thing" mode="RIGHT_HAND"/>')
    await pilot.advance(3)
    ready = pilot.feedback.time("b:p:ready")
    times = [frame.time for frame in pilot.frames["alice"]]
    speed = np.linalg.norm(np.diff(pilot.path("r_wrist", "alice"), axis=0), axis=1)[
        : int(np.searchsorted(times, ready))
    ]
    peak = int(speed.argmax())
    rounding = 2e-4
    assert (np.diff(speed[: peak + 1]) > -rounding).all()
    assert (np.diff(speed[peak:]) < rounding).all()
    assert times[peak] < 0.5 * ready + 0.02


@pytest.mark.parametrize("end", [1.6, 8])
async def test_the_hold_shrinks_and_grows_with_the_available_time(pilot: RealizerPilot, end: float) -> None:
    pilot.block("b", '<pointing id="p" target="thing"/>')
    await pilot.advance(4)
    pilot.block("c", f'<pointing id="p" target="thing" start="0" end="{end}"/>')
    await pilot.advance(9)
    told = pilot.feedback
    free, tied = (told.time(f"{block}:p:ready") - told.time(f"{block}:p:start") for block in "bc")
    assert tied == pytest.approx(free, abs=0.03)
    assert told.time("c:p:end") - told.time("c:p:relax") == pytest.approx(free, abs=0.03)


async def test_an_unknown_target_is_reported(pilot: RealizerPilot) -> None:
    pilot.block("b", '<pointing id="p" target="nowhere"/>')
    await pilot.advance(0.1)
    assert pilot.feedback.warnings == [("b:p", "NO_SUCH_TARGET")]


async def test_a_target_that_no_hand_can_point_at_is_reported_when_planned(pilot: RealizerPilot) -> None:
    pilot.move("thing", (-0.15, 1.27, 0.1))
    pilot.block("b", '<pointing id="p" target="thing" mode="RIGHT_HAND"/><head id="h" lexeme="NOD"/>')
    await pilot.advance(3)
    told = pilot.feedback
    assert told.warnings == [("b:p", "CANNOT_CREATE_BEHAVIOR")]
    sentence = told.of("warningFeedback")[0].text
    assert "right hand" in sentence
    assert "near" in sentence
    assert told.reached("b:h:end")


async def test_the_other_hand_points_at_a_target_out_of_reach_of_the_nearer_one(pilot: RealizerPilot) -> None:
    place = (0.12, 1.3, 0.1)
    pilot.move("thing", place)
    pilot.block("b", '<pointing id="p" target="thing" start="0" ready="1" relax="2"/>')
    await pilot.advance(3)
    assert pilot.feedback.warnings == []
    assert max(misses(pilot, "alice", "r", place, 1.05, 2.0)) < 2.0


async def test_missing_index_fingers_are_reported(tmp_path: Path) -> None:
    avatar = (PACKAGE_ASSETS / "avatars" / "female.glb").read_bytes()
    (tmp_path / "avatars").mkdir()
    lacking = avatar.replace(b"HandIndex", b"HandOther").replace(b"IndexProximal", b"OtherProximal")
    (tmp_path / "avatars" / "female.glb").write_bytes(lacking)
    async with open_pilot(SceneOptions(voice="text", assets=(tmp_path,))) as pilot:
        pilot.block("b", '<pointing id="p" target="bluebox"/><gesture id="g" lexeme="BEAT"/>')
        await pilot.advance(3)
        assert pilot.feedback.warnings == [("b:p", "CANNOT_CREATE_BEHAVIOR")]
        assert "r_index1" in pilot.feedback.of("warningFeedback")[0].text
        assert pilot.feedback.reached("b:g:end")


async def test_the_shape_of_the_speed_profile_is_adjustable_within_a_range(pilot: RealizerPilot) -> None:
    pointing = (
        '<pointing id="p" target="thing" mode="RIGHT_HAND"><bmlt:parameter name="asymmetry" value="{}"/></pointing>'
    )
    peaks = []
    for i, asymmetry in enumerate((-0.5, 0.5)):
        start = len(pilot.frames.get("alice", ()))
        pilot.block(f"b{i}", pointing.format(asymmetry))
        await pilot.advance(4)
        path = pilot.path("r_wrist", "alice")[start : start + 35]
        peaks.append(int(np.linalg.norm(np.diff(path, axis=0), axis=1).argmax()))
    assert peaks[0] < peaks[1] - 5
    pilot.block("c", pointing.format(2))
    await pilot.advance(0.1)
    assert pilot.feedback.warnings == [("c:p", "CANNOT_CREATE_BEHAVIOR")]
    assert "asymmetry" in pilot.feedback.of("warningFeedback")[0].text
