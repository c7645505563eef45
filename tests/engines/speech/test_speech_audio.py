"""The announcements of the audio of planned speeches."""

import io
import wave

import pytest

from reactive_realizer.bml.behaviors import Speech
from reactive_realizer.bml.names import BML, Location
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.audio import AudioGain, AudioMove, AudioStart, AudioStop
from reactive_realizer.engine.tts import Utterance, Word
from reactive_realizer.engines.speech.speech_audio import SpeechAudio, wav_bytes
from reactive_realizer.engines.speech.speech_unit import SpeechUnit
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.pegboard.time_peg import AnticipatorPeg, OffsetPeg
from reactive_realizer.planunit.plan_unit import SyncPoint
from reactive_realizer.reactive.graph import Graph

UTTERANCE = Utterance("a b", 1.0, (Word("a", 0.0, 0, 1), Word("b", 0.5, 2, 3)), {}, audio=b"\0\0" * 22_050)


class Scene:
    """One speech from 2 s to 3 s."""

    def __init__(self) -> None:
        self.graph = Graph()
        self.start = AnticipatorPeg(self.graph, "start", GlobalTime(2.0))
        speech = Speech(id="s", namespace=BML, name="speech", location=Location(1, 1), order=0, text="a b")
        self.unit = SpeechUnit(BlockKey("alice", "b"), speech, UTTERANCE, self.graph)
        offsets = zip(self.unit.timing.points, self.unit.timing.offsets, strict=True)
        self.unit.points = [
            SyncPoint(sync, OffsetPeg(self.graph, sync, self.start, offset)) for sync, offset in offsets
        ]
        self.unit.release()
        self.audio = SpeechAudio("alice")

    def changes(self, now: float) -> tuple[AudioStart | AudioGain | AudioMove | AudioStop, ...]:
        return self.audio.changes([self.unit], GlobalTime(now))

    def play(self, now: float) -> None:
        self.unit.begin()
        self.unit.fire(self.unit.due_points(GlobalTime(now)), GlobalTime(now))

    def volume(self, value: float) -> None:
        self.unit.parameters["volume"].set(value)


@pytest.fixture
def scene() -> Scene:
    return Scene()


def test_a_sound_is_announced_once_with_its_gain(scene: Scene) -> None:
    scene.volume(75.0)
    (start,) = scene.changes(0.0)
    assert isinstance(start, AudioStart)
    assert (start.clip.id, start.start, start.gain) == ("alice-1", 2.0, 1.5)
    assert scene.changes(0.0) == scene.changes(0.01) == ()


@pytest.mark.parametrize(("volume", "gain"), [(0.0, 0.0), (50.0, 1.0), (100.0, 2.0)])
def test_a_volume_of_50_is_a_gain_of_1(scene: Scene, volume: float, gain: float) -> None:
    scene.volume(volume)
    (start,) = scene.changes(0.0)
    assert isinstance(start, AudioStart)
    assert start.gain == gain


def test_a_change_of_gain_is_announced_at_most_once_a_tick(scene: Scene) -> None:
    scene.changes(0.0)
    scene.volume(60.0)
    assert scene.changes(2.1) == (AudioGain("alice-1", 1.2, GlobalTime(2.1)),)
    scene.volume(70.0)
    assert scene.changes(2.1) == ()
    assert scene.changes(2.11) == (AudioGain("alice-1", 1.4, GlobalTime(2.11)),)
    assert scene.changes(2.12) == ()


def test_a_moved_start_is_announced(scene: Scene) -> None:
    scene.changes(0.0)
    with scene.graph.transaction("move"):
        scene.start.set(GlobalTime(2.5))
    assert scene.changes(0.01) == (AudioMove("alice-1", GlobalTime(2.5)),)


def test_a_sound_is_announced_before_its_start_is_known(scene: Scene) -> None:
    with scene.graph.transaction("unknown"):
        scene.start.set(None)
    (start,) = scene.changes(0.0)
    assert isinstance(start, AudioStart)
    assert start.start is None
    with scene.graph.transaction("known"):
        scene.start.set(GlobalTime(2.5))
    assert scene.changes(0.01) == (AudioMove("alice-1", GlobalTime(2.5)),)


def test_a_sound_whose_start_never_became_known_is_stopped_with_its_speech(scene: Scene) -> None:
    with scene.graph.transaction("unknown"):
        scene.start.set(None)
    scene.changes(0.0)
    scene.unit.drop(GlobalTime(1.0))
    assert scene.changes(1.0) == (AudioStop("alice-1", GlobalTime(1.0), 0.03),)


def test_the_sound_of_an_interrupted_speech_is_stopped_and_that_of_a_whole_one_is_not(scene: Scene) -> None:
    scene.changes(0.0)
    scene.play(2.0)
    with scene.graph.transaction("interrupt"):
        scene.unit.interrupt(GlobalTime(2.4))
    assert scene.changes(2.4) == (AudioStop("alice-1", GlobalTime(2.4), 0.03),)
    whole = Scene()
    whole.changes(0.0)
    whole.play(3.0)
    assert whole.changes(3.0) == ()


@pytest.mark.parametrize(("now", "end"), [(2.0, 2.0), (2.001, 2.5), (2.5, 2.5), (2.6, 3.0), (3.0, 3.0)])
def test_a_gentle_end_is_the_start_of_the_next_word_or_the_end_of_the_speech(
    scene: Scene, now: float, end: float
) -> None:
    scene.play(2.0)
    assert scene.unit.gentle_end(GlobalTime(now)) == end


def test_a_speech_that_has_not_begun_may_end_at_once(scene: Scene) -> None:
    assert scene.unit.gentle_end(GlobalTime(1.0)) == 1.0


def test_a_wav_file_has_the_samples_of_the_utterance() -> None:
    audio = bytes(range(200))
    with wave.open(io.BytesIO(wav_bytes(Utterance("a", 0.1, (), {}, (), audio, 1000)))) as sound:
        assert (sound.getnchannels(), sound.getsampwidth(), sound.getframerate()) == (1, 2, 1000)
        assert sound.readframes(1000) == audio
