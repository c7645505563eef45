"""A figure that is watched: alone in most tests, because each further one costs as much time again."""

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

SCENE = """
[character.alice]
avatar = "avatars/{}.glb"

[target.door]
position = [0.0, 1.0, 4.0]

[target.hill]
position = [5.0, 3.0, 20.0]
"""
BOB = """
[character.bob]
avatar = "avatars/male.glb"
position = [4.0, 0.0, 0.0]
"""


@pytest.fixture
async def pilot(tmp_path: Path) -> AsyncIterator[RealizerPilot]:
    async with watched(tmp_path, SCENE.format("female")) as pilot:
        yield pilot


@pytest.fixture
async def pair(tmp_path: Path) -> AsyncIterator[RealizerPilot]:
    """A pilot of two figures."""
    async with watched(tmp_path, SCENE.format("female") + BOB) as pilot:
        yield pilot


@pytest.fixture(params=["female", "male"])
async def either(request: pytest.FixtureRequest, tmp_path: Path) -> AsyncIterator[RealizerPilot]:
    """A pilot of the one avatar, and of the other."""
    async with watched(tmp_path, SCENE.format(request.param)) as pilot:
        yield pilot


@asynccontextmanager
async def watched(folder: Path, scene: str) -> AsyncIterator[RealizerPilot]:
    human = folder / "human.toml"
    human.write_text(scene)
    async with open_pilot(SceneOptions(human, voice="text", verify=True)) as pilot:
        pilot.watch()
        yield pilot
