"""What acceptance tests share: BML goes in, feedback comes out."""

import pytest

from reactive_realizer.testing.pilot import open_pilot


@pytest.fixture
async def pilot():
    async with open_pilot() as pilot:
        yield pilot
