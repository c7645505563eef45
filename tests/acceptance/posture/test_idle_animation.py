"""Idle animation, in exported frames."""

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.errors import RealizerError
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .soles import FRAME
from .standing import SIT

HUMAN = """
[character.still]
idle = false
[character.alive]
position = [1, 0, 0]
"""


async def test_the_key_idle_must_be_true_or_false(tmp_path: Path) -> None:
    file = tmp_path / "one.toml"
    file.write_text('[character.still]\nidle = "no"')
    with pytest.raises(RealizerError, match=r"character\.still\.idle"):
        async with open_pilot(SceneOptions(file, voice="text")):
            pass


async def test_idle_animation_can_be_turned_off(tmp_path: Path) -> None:
    file = tmp_path / "two.toml"
    file.write_text(HUMAN)
    async with open_pilot(SceneOptions(file, voice="text")) as pilot:
        pilot.watch()
        await pilot.advance(10)
        still, alive = pilot.frames["still"], pilot.frames["alive"]
        assert all(np.array_equal(frame.rotations, still[0].rotations) for frame in still)
        assert all(not frame.weights.any() for frame in still)
        assert not np.array_equal(alive[0].rotations, alive[250].rotations)


async def frames_of(seed: int) -> list[bytes]:
    async with open_pilot(SceneOptions(voice="text", seed=seed)) as pilot:
        pilot.watch()
        await pilot.advance(5)
        return [frame.rotations.tobytes() + frame.root.tobytes() for frame in pilot.frames["alice"]]


async def test_idle_animation_depends_on_the_seed() -> None:
    frames = await frames_of(1)
    assert frames == await frames_of(1)
    assert frames != await frames_of(2)


async def test_a_sitting_figure_does_not_shift_its_weight(pilot: RealizerPilot) -> None:
    pilot.block("a", f'<postureShift id="s">{SIT}</postureShift>')
    await pilot.advance(33)  # a standing figure shifts its weight every 10 to 30 s
    roots = {tuple(np.round(each.root, 6)) for each in pilot.bodies()[150:]}
    assert len(roots) == 1


def begins(values: list[float], still: float) -> list[float]:
    """When something begins to change, s."""
    moving = [abs(b - a) > still for a, b in pairwise(values)]
    return [FRAME * i for i, (a, b) in enumerate(pairwise(moving)) if b and not a]


async def test_an_idle_figure_breathes_blinks_and_shifts_its_weight_as_often_as_people_do(
    pilot: RealizerPilot,
) -> None:
    await pilot.advance(60)
    bodies, frames = pilot.bodies(), pilot.frames["alice"]
    shoulder = [body.rotation("l_sternoclavicular")[3] for body in bodies]
    breaths = sum(a < b >= c for a, b, c in zip(shoulder, shoulder[1:], shoulder[2:], strict=False))
    assert 12 <= breaths <= 18
    morphs = pilot.realizer.characters["alice"].humanoid.avatar.morphs
    blinks = begins([frame.weights[morphs.index("eyeBlinkLeft")] for frame in frames], 0.0)
    assert 8 <= len(blinks) <= 21
    shifts = begins([body.root[0] for body in bodies], 1e-9)
    assert all(9.9 < after - before < 30.1 for before, after in pairwise(shifts))
    assert len(shifts) > 60 / 30 - 1
