"""A figure that is watched."""

from collections.abc import AsyncIterator
from pathlib import Path

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot


@pytest.fixture
async def pilot() -> AsyncIterator[RealizerPilot]:
    async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
        pilot.watch()
        yield pilot


@pytest.fixture(params=["female", "male"])
async def either(request: pytest.FixtureRequest, tmp_path: Path) -> AsyncIterator[RealizerPilot]:
    """A pilot of the one avatar, and of the other."""
    human = tmp_path / "human.toml"
    human.write_text(f'[character.alice]\navatar = "avatars/{request.param}.glb"')
    async with open_pilot(SceneOptions(human, voice="text", verify=True)) as pilot:
        pilot.watch()
        yield pilot
