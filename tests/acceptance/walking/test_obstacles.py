"""Walking around what stands in the way."""

import math
from collections.abc import AsyncIterator
from pathlib import Path

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.motion_laws import foot_slide
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .tracks import deepest, place

SCENE = """
[character.alice]

[character.bob]
avatar = "avatars/male.glb"
position = [3.0, 0.0, 0.0]

[target.table]
position = [0.1, 0.7, 2.0]
radius = 0.5

[target.door]
position = [0.0, 1.0, 4.0]

[target.window]
position = [6.0, 1.5, 0.0]
"""
COLUMN = """
[target.column{}]
position = [{:.3f}, 0.0, {:.3f}]
radius = 0.8
"""
ANGLES = [k * math.pi / 3.0 for k in range(6)]
RING = [COLUMN.format(k, 2.0 * math.cos(angle), 8.0 + 2.0 * math.sin(angle)) for k, angle in enumerate(ANGLES)]
BODY = 0.3
"""Half of the space that a body needs, m."""


@pytest.fixture
async def pilot(tmp_path: Path) -> AsyncIterator[RealizerPilot]:
    human = tmp_path / "human.toml"
    human.write_text(SCENE + "".join(RING))
    async with open_pilot(SceneOptions(human, voice="text", verify=True)) as pilot:
        pilot.watch()
        yield pilot


def go(target: str, rest: str = "") -> str:
    return f'<locomotion id="w" target="{target}" {rest}/>'


def nearest(pilot: RealizerPilot, x: float, z: float) -> float:
    return min(math.dist(place(body), (x, z)) for body in pilot.bodies("alice"))


@pytest.mark.parametrize(("rest", "seconds"), [("", 6), ('manner="RUN"', 4), ('manner="STRAFE" end="14"', 15)])
async def test_a_figure_walks_around_an_object_with_a_radius(pilot: RealizerPilot, rest: str, seconds: float) -> None:
    pilot.block("b", go("door", rest))
    await pilot.advance(seconds)
    bodies = pilot.bodies("alice")
    assert nearest(pilot, 0.1, 2.0) > 0.5 + BODY - 0.05
    assert math.dist(place(bodies[-1]), (0.0, 4.0)) == pytest.approx(0.5, abs=0.04)
    assert foot_slide(bodies) < 0.01
    assert deepest(bodies) > -0.01
    assert pilot.feedback.reached("b:w:end")
    assert pilot.feedback.warnings == []


async def test_a_figure_walks_around_another_one(pilot: RealizerPilot) -> None:
    pilot.block("b", go("window"))
    await pilot.advance(8)
    assert nearest(pilot, 3.0, 0.0) > 2 * BODY - 0.05
    assert math.dist(place(pilot.bodies("alice")[-1]), (6.0, 0.0)) == pytest.approx(0.5, abs=0.04)


async def test_a_figure_stops_before_an_object_where_it_begins(pilot: RealizerPilot) -> None:
    pilot.block("b", go("table"))
    await pilot.advance(4)
    assert math.dist(place(pilot.bodies("alice")[-1]), (0.1, 2.0)) == pytest.approx(1.0, abs=0.04)


async def test_a_figure_goes_around_what_comes_into_its_way(pilot: RealizerPilot) -> None:
    pilot.realizer.world.move("table", (9.0, 0.7, 9.0))
    pilot.block("b", go("door"))
    await pilot.advance(0.8)
    pilot.realizer.world.move("table", (0.1, 0.7, 2.2))
    await pilot.advance(6)
    assert nearest(pilot, 0.1, 2.2) > 0.5 + BODY - 0.1
    assert math.dist(place(pilot.bodies("alice")[-1]), (0.0, 4.0)) == pytest.approx(0.5, abs=0.04)
    assert foot_slide(pilot.bodies("alice")) < 0.01


async def test_a_place_that_obstacles_enclose_is_refused(pilot: RealizerPilot) -> None:
    pilot.block("b", go("0 8") + '<head id="h" lexeme="NOD"/>')
    await pilot.advance(3)
    (warning,) = pilot.feedback.of("warningFeedback")
    assert "nobody can walk to '0 8': obstacles are on all ways" in warning.text
    assert pilot.feedback.reached("b:h:end")
