"""A figure whose frames are kept; nobody views it, so its eyes look ahead without a gaze."""

from collections.abc import AsyncIterator

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot


@pytest.fixture
async def pilot() -> AsyncIterator[RealizerPilot]:
    async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
        pilot.move("camera", None)
        pilot.watch()
        await pilot.advance(0.1)
        yield pilot
