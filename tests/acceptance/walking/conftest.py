"""A figure that is watched, in a scene of its own."""

from collections.abc import AsyncIterator
from pathlib import Path

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

SCENE = """
[character.alice]
avatar = "avatars/{}.glb"

[character.bob]
avatar = "avatars/male.glb"
position = [4.0, 0.0, 0.0]

[target.door]
position = [0.0, 1.0, 4.0]

[target.hill]
position = [5.0, 3.0, 20.0]
"""


@pytest.fixture
async def pilot(tmp_path: Path) -> AsyncIterator[RealizerPilot]:
    async with open_pilot(SceneOptions(scene(tmp_path, "female"), voice="text", verify=True)) as pilot:
        pilot.watch()
        yield pilot


@pytest.fixture(params=["female", "male"])
async def either(request: pytest.FixtureRequest, tmp_path: Path) -> AsyncIterator[RealizerPilot]:
    """A pilot of the one avatar, and of the other."""
    async with open_pilot(SceneOptions(scene(tmp_path, request.param), voice="text", verify=True)) as pilot:
        pilot.watch()
        yield pilot


def scene(folder: Path, avatar: str) -> Path:
    human = folder / "human.toml"
    human.write_text(SCENE.format(avatar))
    return human
