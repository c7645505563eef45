"""The realizer whose face is recorded, and the weights of its morph targets."""

from collections.abc import AsyncIterator

import numpy as np
import pytest
from numpy.typing import NDArray

from reactive_realizer.testing.pilot import RealizerPilot, open_pilot


@pytest.fixture
async def pilot() -> AsyncIterator[RealizerPilot]:
    async with open_pilot() as pilot:
        pilot.watch()
        yield pilot


def weight(pilot: RealizerPilot, morph: str) -> NDArray[np.float64]:
    """The weight of a morph target in each frame, (F,)."""
    morphs = pilot.realizer.characters["alice"].humanoid.avatar.morphs
    return np.array([frame.weights for frame in pilot.frames["alice"]])[:, morphs.index(morph)]
