"""Eyes that no gaze directs look at the viewer, and away now and then."""

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import rotate
from reactive_realizer.embodiment.vector import FORWARD, Vec3, dot, subtract, unit
from reactive_realizer.testing.pilot import open_pilot

NEAR: Vec3 = (0.4, 1.5, 2.0)
"""About 11 degrees aside."""
ASIDE: Vec3 = (3.0, 1.5, 1.0)
AWAY = 1.0
"""Degrees."""


def off(bodies: Sequence[Body], target: Vec3) -> NDArray[np.float64]:
    """By how much the left eye misses a target in each frame, degrees, (F,)."""
    eyes = [body.transform("l_eyeball_joint") for body in bodies]
    pairs = ((rotate(eye.rotation, FORWARD), unit(subtract(target, eye.position))) for eye in eyes)
    return np.degrees([math.acos(min(1.0, dot(*pair))) for pair in pairs])


async def rest(camera: Vec3, behaviors: str = "", human: Path | None = None) -> list[Body]:
    options = SceneOptions(voice="text") if human is None else SceneOptions(human, "text")
    async with open_pilot(options) as pilot:
        pilot.move("camera", camera)
        pilot.watch()
        if behaviors:
            pilot.block("b", behaviors)
        await pilot.advance(30)
        assert pilot.feedback.warnings == []
        return pilot.bodies("alice")


async def test_eyes_rest_on_the_viewer_while_the_head_moves_and_glance_away_now_and_then() -> None:
    missed = off(await rest(NEAR), NEAR)
    assert 0.7 < np.mean(missed < AWAY) < 0.99
    assert missed.max() > 1.5
    assert np.median(missed) < 0.4


async def test_a_head_that_nods_does_not_turn_them_off_the_viewer() -> None:
    missed = off(await rest(NEAR, '<head id="n" lexeme="NOD" start="1" repetition="3"/>'), NEAR)
    assert np.mean(missed[50:150] < AWAY) > 0.6


async def test_they_do_not_look_at_a_viewer_far_aside() -> None:
    bodies = await rest(ASIDE)
    assert off(bodies, ASIDE).min() > 40.0


async def test_a_gaze_leads_them_away_and_back() -> None:
    bodies = await rest(NEAR, '<gaze id="g" target="-1 1.5 2" influence="EYES" start="2" end="4"/>')
    assert off(bodies, (-1.0, 1.5, 2.0))[110:170].max() < 0.6
    assert np.median(off(bodies, NEAR)[220:]) < 0.4


async def test_without_idle_animation_they_look_ahead(tmp_path: Path) -> None:
    human = tmp_path / "still.toml"
    human.write_text("[character.alice]\nidle = false\n")
    missed = off(await rest(NEAR, human=human), NEAR)
    assert missed.min() == pytest.approx(missed.max())
    assert missed.min() > 5.0
