"""Gazes at targets that joints do not reach: the feet turn the figure."""

import math
from collections.abc import AsyncIterator
from pathlib import Path

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.vector import Vec3, subtract, unit
from reactive_realizer.testing.motion_laws import foot_slide
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot
from tests.acceptance.gaze.seen import between, miss

from .tracks import deepest, heading

SCENE = """
[character.alice]

[target.behind]
position = [-0.5, 1.5, -2.0]

[target.left]
position = [2.0, 1.5, 0.1]

[target.front]
position = [0.2, 1.5, 2.0]
"""
BEHIND = math.degrees(math.atan2(-0.5, -2.0))
"""Direction of the target behind, degrees to the left of +z."""


@pytest.fixture
async def pilot(tmp_path: Path) -> AsyncIterator[RealizerPilot]:
    human = tmp_path / "human.toml"
    human.write_text(SCENE)
    async with open_pilot(SceneOptions(human, voice="text", verify=True)) as pilot:
        pilot.watch()
        yield pilot


def look(element: str = "gaze", target: str = "behind", rest: str = "") -> str:
    return f'<{element} id="g" target="{target}" {rest}/>'


def headings(pilot: RealizerPilot) -> list[float]:
    return [heading(body) for body in pilot.bodies("alice")]


async def test_the_feet_turn_a_figure_to_what_is_behind_it_and_back(pilot: RealizerPilot) -> None:
    pilot.block("b", look(rest='influence="HEAD"'))
    await pilot.advance(6)
    bodies = pilot.bodies("alice")
    ready, relax, end = (round(pilot.feedback.time(f"b:g:{point}") * 50) for point in ("ready", "relax", "end"))
    assert max(miss(body, (-0.5, 1.5, -2.0)) for body in bodies[ready + 2 : relax]) < 1.0
    assert heading(bodies[ready + 2]) == pytest.approx(BEHIND + 30.0, abs=2.0)
    assert heading(bodies[end + 2]) == pytest.approx(0.0, abs=2.0)
    assert foot_slide(bodies) < 0.01
    assert deepest(bodies) > -0.01
    assert pilot.feedback.warnings == []


@pytest.mark.parametrize("element", ["gazeShift", "headDirectionShift"])
async def test_a_figure_stays_turned_after_a_shift(pilot: RealizerPilot, element: str) -> None:
    pilot.block("b", look(element))
    await pilot.advance(5)
    assert headings(pilot)[-1] == pytest.approx(BEHIND + 30.0, abs=2.0)
    assert pilot.feedback.warnings == []


async def test_the_feet_stay_where_the_joints_reach(pilot: RealizerPilot) -> None:
    pilot.block("b", look(target="left", rest='influence="HEAD"'))
    await pilot.advance(3)
    assert max(map(abs, headings(pilot))) < 3.0


async def test_the_feet_follow_a_target_that_moves_behind_the_figure(pilot: RealizerPilot) -> None:
    pilot.block("b", look(target="front", rest='bmlt:dynamic="true" start="0" end="6"'))
    await pilot.advance(1.5)
    pilot.realizer.world.move("front", (-2.0, 1.5, -1.6))
    await pilot.advance(2.5)
    assert headings(pilot)[-1] == pytest.approx(math.degrees(math.atan2(-2.0, -1.6)) + 30.0, abs=2.0)
    assert foot_slide(pilot.bodies("alice")) < 0.01


async def test_an_interrupted_gaze_turns_back(pilot: RealizerPilot) -> None:
    pilot.block("b", look(rest='start="0" end="8"'))
    await pilot.advance(3)
    pilot.block("c", composition="REPLACE")
    await pilot.advance(3)
    assert headings(pilot)[-1] == pytest.approx(0.0, abs=2.0)


async def test_a_turn_of_the_feet_takes_its_time(pilot: RealizerPilot) -> None:
    pilot.block("b", look(rest='ready="0.2"'))
    await pilot.advance(4)
    (warning,) = pilot.feedback.of("warningFeedback")
    assert "ready" in warning.text
    assert pilot.feedback.time("b:g:ready") >= 0.8


async def test_a_figure_that_sits_says_that_it_does_not_reach_a_target(pilot: RealizerPilot) -> None:
    pilot.block("a", '<postureShift id="p"><stance type="SITTING"/></postureShift>')
    pilot.block("b", look(rest='influence="HEAD"'), composition="APPEND")
    await pilot.advance(6)
    (warning,) = pilot.feedback.of("warningFeedback")
    assert "degrees short of its target" in warning.text
    assert max(map(abs, headings(pilot))) < 5.0


# --- pointing


@pytest.mark.parametrize("rest", ["", 'mode="BOTH_HANDS"', 'mode="LEFT_HAND"'])
async def test_the_feet_turn_a_figure_that_points_behind_it_and_back(pilot: RealizerPilot, rest: str) -> None:
    target = (-0.5, 1.5, -2.0)
    pilot.block("b", f'<pointing id="p" target="behind" {rest}/>')
    await pilot.advance(7)
    bodies = pilot.bodies("alice")
    ready, relax, end = (round(pilot.feedback.time(f"b:p:{point}") * 50) for point in ("ready", "relax", "end"))
    side = "l" if rest else "r"
    assert max(off_line(body, side, target) for body in bodies[ready + 1 : relax]) < 2.0
    assert heading(bodies[ready + 2]) == pytest.approx(BEHIND + 30.0, abs=2.0)
    assert heading(bodies[end + 2]) == pytest.approx(0.0, abs=2.0)
    assert foot_slide(bodies) < 0.01
    assert pilot.feedback.warnings == []


async def test_a_gaze_and_a_pointing_at_one_target_turn_the_figure_once(pilot: RealizerPilot) -> None:
    pilot.block("b", look(rest='start="0" end="4"') + '<pointing id="p" target="behind" start="0" relax="3"/>')
    await pilot.advance(2.5)
    shown = headings(pilot)[100:]
    assert max(shown) - min(shown) < 2.0
    assert pilot.feedback.warnings == []


async def test_a_figure_that_sits_does_not_point_behind_it(pilot: RealizerPilot) -> None:
    pilot.block("a", '<postureShift id="p"><stance type="SITTING"/></postureShift>')
    pilot.block("b", '<pointing id="p" target="behind"/>', composition="APPEND")
    await pilot.advance(4)
    assert pilot.feedback.warnings == [("b:p", "CANNOT_CREATE_BEHAVIOR")]
    assert "it is behind the arm" in pilot.feedback.of("warningFeedback")[0].text


def off_line(body: Body, side: str, target: Vec3) -> float:
    """The angle between the line of an index finger and the direction of a target, degrees."""
    base, tip = (body.transform(f"{side}_index{i}").position for i in (1, 3))
    return between(unit(subtract(tip, base)), unit(subtract(target, base)))


async def test_a_figure_does_not_turn_to_its_own_hand(pilot: RealizerPilot) -> None:
    pilot.block("b", look(target="alice:l_wrist"))
    await pilot.advance(2)
    assert max(map(abs, headings(pilot))) < 3.0
