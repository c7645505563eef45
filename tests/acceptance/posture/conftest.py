"""A figure that is watched."""

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot


@pytest.fixture
async def pilot() -> AsyncIterator[RealizerPilot]:
    async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
        pilot.watch()
        yield pilot


AVATARS = ["female", "male"]


@pytest.fixture(params=AVATARS)
async def either(request: pytest.FixtureRequest, tmp_path: Path) -> AsyncIterator[RealizerPilot]:
    """A pilot of the one avatar, and of the other."""
    async with watched(request.param, tmp_path) as pilot:
        yield pilot


@pytest.fixture
async def alternating(request: pytest.FixtureRequest, tmp_path: Path) -> AsyncIterator[RealizerPilot]:
    """A pilot whose avatar alternates along each parameter of a table of cases, like the squares of a checkerboard."""
    async with watched(AVATARS[sum(request.node.callspec.indices.values()) % 2], tmp_path) as pilot:
        yield pilot


@asynccontextmanager
async def watched(avatar: str, folder: Path) -> AsyncIterator[RealizerPilot]:
    human = folder / "human.toml"
    human.write_text(f'[character.alice]\navatar = "avatars/{avatar}.glb"')
    async with open_pilot(SceneOptions(human, voice="text", verify=True)) as pilot:
        pilot.watch()
        yield pilot
