"""What acceptance tests share: BML goes in, feedback comes out."""

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.pilot import open_pilot


@pytest.fixture
async def pilot():
    """Every plan is verified while it is played: what it breaks is a warning that the test did not expect."""
    async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
        yield pilot
