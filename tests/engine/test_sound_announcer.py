"""The announcements of the sounds of planned units."""

import io
import wave

import pytest

from reactive_realizer.bml.behaviors import Wait
from reactive_realizer.bml.names import BML, Location
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.audio import AudioGain, AudioMove, AudioStart, AudioStop, Caption, Sound
from reactive_realizer.engine.sound_announcer import SoundAnnouncer
from reactive_realizer.engine.sound_unit import SoundPart, SoundUnit
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.pegboard.time_peg import AnticipatorPeg, OffsetPeg
from reactive_realizer.planunit.sync_point import SyncPoint
from reactive_realizer.planunit.timing import PhaseKind, timing_at
from reactive_realizer.reactive.graph import Graph

SECOND = Sound.from_pcm(b"\0\0" * 22_050, 22_050)


class Captioned(SoundUnit):
    """A speech of two words, of which the first one sounds."""

    caption = Caption("One two", ((0.0, 0, 3), (3.0, 4, 7)))


class Scene:
    """One sound from 2 s to 3 s, of a unit that may be longer."""

    def __init__(self, kind: type[SoundUnit] = SoundUnit, duration: float = 1.0) -> None:
        self.graph = Graph()
        self.start = AnticipatorPeg(self.graph, "start", GlobalTime(2.0))
        behavior = Wait(id="s", namespace=BML, name="wait", location=Location(1, 1), order=0)
        timing = timing_at({"start": 0.0, "end": duration}, PhaseKind.RIGID)
        self.unit = kind(BlockKey("alice", "b"), behavior, timing, [SoundPart(0.0, SECOND)], self.graph)
        offsets = zip(self.unit.timing.points, self.unit.timing.offsets, strict=True)
        self.unit.points = [
            SyncPoint(sync, OffsetPeg(self.graph, sync, self.start, offset)) for sync, offset in offsets
        ]
        self.unit.release()
        self.audio = SoundAnnouncer("alice", "alice-audio")

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
    assert (start.clip.id, start.start, start.gain) == ("alice-audio-1", 2.0, 1.5)
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
    assert scene.changes(2.1) == (AudioGain("alice-audio-1", 1.2, GlobalTime(2.1)),)
    scene.volume(70.0)
    assert scene.changes(2.1) == ()
    assert scene.changes(2.11) == (AudioGain("alice-audio-1", 1.4, GlobalTime(2.11)),)
    assert scene.changes(2.12) == ()


def test_a_moved_start_is_announced(scene: Scene) -> None:
    scene.changes(0.0)
    with scene.graph.transaction("move"):
        scene.start.set(GlobalTime(2.5))
    assert scene.changes(0.01) == (AudioMove("alice-audio-1", GlobalTime(2.5), GlobalTime(0.01)),)


def test_a_sound_is_announced_before_its_start_is_known(scene: Scene) -> None:
    with scene.graph.transaction("unknown"):
        scene.start.set(None)
    (start,) = scene.changes(0.0)
    assert isinstance(start, AudioStart)
    assert start.start is None
    with scene.graph.transaction("known"):
        scene.start.set(GlobalTime(2.5))
    assert scene.changes(0.01) == (AudioMove("alice-audio-1", GlobalTime(2.5), GlobalTime(0.01)),)


def test_a_sound_whose_start_never_became_known_is_stopped_with_its_unit(scene: Scene) -> None:
    with scene.graph.transaction("unknown"):
        scene.start.set(None)
    scene.changes(0.0)
    scene.unit.drop(GlobalTime(1.0))
    assert scene.changes(1.0) == (AudioStop("alice-audio-1", GlobalTime(1.0), 0.02),)


def test_an_interrupted_sound_is_stopped_and_a_whole_one_is_not(scene: Scene) -> None:
    scene.changes(0.0)
    scene.play(2.0)
    with scene.graph.transaction("interrupt"):
        scene.unit.interrupt(GlobalTime(2.4))
    assert scene.changes(2.4) == (AudioStop("alice-audio-1", GlobalTime(2.4), 0.02),)
    whole = Scene()
    whole.changes(0.0)
    whole.play(3.0)
    assert whole.changes(3.0) == ()


def test_the_caption_of_a_speech_that_is_cut_in_a_pause_between_its_sounds_is_stopped() -> None:
    for kind, stops in ((Captioned, (AudioStop("alice-audio-1", GlobalTime(4.5), 0.02),)), (SoundUnit, ())):
        scene = Scene(kind, 5.0)
        scene.changes(0.0)
        scene.play(2.0)
        assert scene.changes(4.0) == ()
        with scene.graph.transaction("interrupt"):
            scene.unit.interrupt(GlobalTime(4.5))
        assert scene.changes(4.5) == stops


def test_a_wav_file_has_the_samples_of_the_sound() -> None:
    pcm = bytes(range(200))
    stereo = Sound.from_pcm(pcm, 1000, channels=2)
    assert stereo.duration == 0.05
    with wave.open(io.BytesIO(stereo.wav)) as file:
        assert (file.getnchannels(), file.getsampwidth(), file.getframerate()) == (2, 2, 1000)
        assert file.readframes(1000) == pcm
