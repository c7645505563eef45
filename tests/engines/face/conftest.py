"""The realizer of a still character whose face is recorded, and the weights of its morph targets."""

from collections.abc import AsyncIterator
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

STILL = "[character.alice]\nidle = false\n"


@pytest.fixture
async def pilot(tmp_path: Path) -> AsyncIterator[RealizerPilot]:
    human = tmp_path / "still.toml"
    human.write_text(STILL, encoding="utf-8")
    async with open_pilot(SceneOptions(human)) as pilot:
        pilot.watch()
        yield pilot


def weight(pilot: RealizerPilot, morph: str) -> NDArray[np.float64]:
    """The weight of a morph target in each frame, (F,)."""
    morphs = pilot.realizer.characters["alice"].humanoid.avatar.morphs
    return np.array([frame.weights for frame in pilot.frames["alice"]])[:, morphs.index(morph)]
