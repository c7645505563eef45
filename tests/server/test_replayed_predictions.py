"""A session with all anticipators is replayed to the byte, without running them."""

import json
from contextlib import closing
from pathlib import Path
from random import Random

import pytest

from anticipators.conducting import Conducting
from anticipators.exercise import Exercise
from anticipators.metronome import Metronome
from anticipators.speech_stop import SpeechStop
from anticipators.tap import Tap
from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.realizer.session import replay
from reactive_realizer.server.recorder import Recorder
from reactive_realizer.server.recording import read_recording
from reactive_realizer.server.recording_parts import RecordingParts
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

HUMAN = """
[character.alice]
[anticipator.metronome]
kind = "metronome"
[anticipator.spacebar]
kind = "spacebar"
[anticipator.user]
kind = "speech_stop"
[anticipator.voice]
kind = "backchannel"
[anticipator.trainee]
kind = "exercise"
names = ["down", "up"]
rise = 1.0
[anticipator.orchestra]
kind = "conducting"
[anticipator.foot]
kind = "tap"
"""
POINTS = [
    *("metronome:tick2", "metronome:tick7", "spacebar:press", "spacebar:release", "user:stop+0.2", "voice:backchannel"),
    *("trainee:down", "trainee:up", "trainee:4", "orchestra:beat3", "orchestra:beat8", "foot:beat", "foot:offbeat"),
    *("partner:hit", "spacebar:pres"),
]
EVENTS = [
    *(("metronome", "tempo", 80.0), ("metronome", "start", None), ("spacebar", "press", None)),
    *(("spacebar", "release", None), ("user", "voice", 1.0), ("user", "voice", 0.0), ("orchestra", "beat", None)),
    *(("foot", "tap", None), ("trainee", "sample", 9.8), ("trainee", "sample", 14.0)),
]


def act(pilot: RealizerPilot, random: Random, tick: int) -> None:
    """What clients do before a tick."""
    pilot.event("voice", "pitch", 200.0 if tick % 150 < 120 else 150.0)
    if tick % 40 == 0:
        pilot.event("foot", "tap")
    if random.random() < 0.1:
        pilot.event(*random.choice(EVENTS))
    if random.random() < 0.02:
        pilot.predict("partner", "hit", random.choice([None, pilot.now + 0.5, pilot.now - 1.0]))
    if random.random() < 0.05:
        point = random.choice(POINTS)
        pilot.block(f"b{tick}", f'<head id="h" lexeme="NOD" start="anticipators:{point}"/>')


@pytest.mark.parametrize("seed", range(3))
async def test_a_session_with_all_anticipators_is_replayed_to_the_byte_without_their_streams(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, seed: int
) -> None:
    human, file, random = tmp_path / "human.toml", tmp_path / "session.jsonl", Random(seed)
    human.write_text(HUMAN)
    options = SceneOptions(human, "text")
    with closing(RecordingParts(file)) as parts:
        async with open_pilot(options) as pilot:
            recorder = Recorder(parts.write, options, 0.0)
            pilot.realizer.record(recorder, recorder.forecast)
            for tick in range(800):
                act(pilot, random, tick)
                await pilot.tick()
            recorder.close()
            told = pilot.feedback.raw
            pegs = [view.as_json() for view in pilot.realizer.board.snapshot()]
    for kind in (Conducting, Exercise, Metronome, SpeechStop, Tap):
        monkeypatch.delattr(kind, "predictions")
        if "forecast" in vars(kind):
            monkeypatch.setattr(kind, "forecast", lambda *_: 1 / 0)
    async with open_pilot(options) as again:
        await replay(again.realizer, read_recording(file).ticks)
        assert again.feedback.raw == told
        assert json.dumps([view.as_json() for view in again.realizer.board.snapshot()]) == json.dumps(pegs)
    assert sum("syncPointProgress" in line for line in told) > 20
