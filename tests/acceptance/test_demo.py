"""What the demo performs, also while somebody drags the tempo."""

import math

import numpy as np
import pytest

from reactive_realizer.assembly.assets import PACKAGE_ASSETS
from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.quaternion import angle
from reactive_realizer.testing.pilot import open_pilot

GREETING, CONDUCTOR = [
    (PACKAGE_ASSETS / "demo" / f"{name}.xml").read_text(encoding="utf-8") for name in ("greeting", "conductor")
]
STROKES = [f"conducting:{beat}:stroke" for beat in ("first", "second", "third", "fourth", "last")]


@pytest.mark.speech
@pytest.mark.parametrize("tempo", [60, 48, 100])
async def test_the_greeting_plays_without_a_warning_and_its_strokes_fall_on_the_beat(tempo: int) -> None:
    async with open_pilot(SceneOptions()) as pilot:
        pilot.event("metronome", "start")
        pilot.perform(GREETING)
        await pilot.advance(15.1)
        pilot.event("metronome", "tempo", tempo)
        await pilot.advance(10.4)
        assert pilot.feedback.warnings == []
        assert [pilot.feedback.status(block) for block in ("greeting", "pegs", "conducting")] == ["DONE"] * 3
        times = [pilot.feedback.time(stroke) for stroke in STROKES]
        assert np.diff(times) == pytest.approx(60 / tempo)
        assert 19 < pilot.feedback.time("conducting:end") < 24


@pytest.mark.speech
async def test_the_conductor_beats_with_the_metronome_cues_and_stands() -> None:
    tempo = 100
    async with open_pilot(SceneOptions()) as pilot:
        pilot.watch()
        pilot.event("metronome", "start")
        pilot.perform(CONDUCTOR)
        await pilot.advance(10.1)
        pilot.event("metronome", "tempo", tempo)
        await pilot.advance(20.0)
        assert pilot.feedback.warnings == []
        assert pilot.feedback.of("fall") == []
        assert pilot.feedback.status("conducting") == "DONE"
        beats = [pilot.feedback.time(f"conducting:bar{bar}:beat{beat}") for bar in (3, 4, 5) for beat in (1, 2, 3, 4)]
        assert np.diff(beats) == pytest.approx(60 / tempo)
        bends = [math.degrees(angle(body.rotation("l_elbow"))) for body in pilot.bodies()]
        loose, cue, ended = [bends[round(50 * time)] for time in (7.5, 9.0, 30.0)]
        assert cue > 60.0
        assert max(loose, ended) < 25.0


@pytest.mark.speech
async def test_the_conductor_is_put_back_when_the_demo_is_repeated_after_a_fall() -> None:
    async with open_pilot(SceneOptions()) as pilot:
        pilot.watch()
        pilot.event("metronome", "start")
        pilot.perform(CONDUCTOR)
        await pilot.advance(2.0)
        pilot.push("vt10", (0.0, 0.0, 200.0), 0.5)
        await pilot.advance(2.0)
        assert len(pilot.feedback.of("fall")) == 1
        assert pilot.bodies()[-1].transform("skullbase").position[1] < 0.7
        pilot.block("stop", composition="REPLACE")
        await pilot.advance(1.5)
        pilot.perform(CONDUCTOR)
        await pilot.advance(3.5)
        assert pilot.bodies()[-1].transform("skullbase").position[1] > 1.38
        assert len(pilot.feedback.of("fall")) == 1
