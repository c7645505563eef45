"""What the demo performs, also while somebody drags the tempo."""

import numpy as np
import pytest

from reactive_realizer.assembly.assets import PACKAGE_ASSETS
from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.pilot import open_pilot

PERFORMANCE = (PACKAGE_ASSETS / "demo" / "performance.xml").read_text(encoding="utf-8")
STROKES = [f"conducting:{beat}:stroke" for beat in ("first", "second", "third", "fourth", "last")]


@pytest.mark.speech
@pytest.mark.parametrize("tempo", [60, 48, 100])
async def test_the_performance_plays_without_a_warning_and_its_strokes_fall_on_the_beat(tempo: int) -> None:
    async with open_pilot(SceneOptions()) as pilot:
        pilot.event("metronome", "start")
        pilot.perform(PERFORMANCE)
        await pilot.advance(13.1)
        pilot.event("metronome", "tempo", tempo)
        await pilot.advance(10.4)
        assert pilot.feedback.warnings == []
        assert [pilot.feedback.status(block) for block in ("greeting", "pegs", "conducting")] == ["DONE"] * 3
        times = [pilot.feedback.time(stroke) for stroke in STROKES]
        assert np.diff(times) == pytest.approx(60 / tempo)
        assert 17 < pilot.feedback.time("conducting:end") < 22
