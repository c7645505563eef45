"""A figure that is watched."""

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.pilot import open_pilot


@pytest.fixture
async def pilot():
    async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
        pilot.watch()
        await pilot.advance(0.1)
        yield pilot
