"""A figure that is watched."""

from collections.abc import AsyncIterator

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot


@pytest.fixture
async def pilot() -> AsyncIterator[RealizerPilot]:
    async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
        pilot.watch()
        await pilot.advance(0.1)
        yield pilot
