"""A realizer with motions of its own in files."""

from collections.abc import AsyncIterator
from pathlib import Path

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .motions import FILES


@pytest.fixture
async def pilot(tmp_path: Path) -> AsyncIterator[RealizerPilot]:
    for name, text in FILES.items():
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text)
    async with open_pilot(SceneOptions(voice="text", assets=(tmp_path,), verify=True)) as pilot:
        pilot.watch()
        yield pilot
