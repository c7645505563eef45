"""What is told of a sound: all that changed, before it is heard, and no more."""

import pytest

from reactive_realizer.bml.behaviors import Speech
from reactive_realizer.bml.names import BML, Location
from reactive_realizer.embodiment.audio import AudioGain, AudioMove, AudioStart, AudioStop
from reactive_realizer.engine.tts import Utterance, Word
from reactive_realizer.engines.speech.announcer import Announcer
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
        self.start = AnticipatorPeg(self.graph, "start", 2.0)
        speech = Speech(id="s", namespace=BML, name="speech", location=Location(1, 1), order=0, text="a b")
        self.unit = SpeechUnit(BlockKey("alice", "b"), speech, UTTERANCE, self.graph)
        offsets = zip(self.unit.timing.points, self.unit.timing.offsets, strict=True)
        self.unit.points = [
            SyncPoint(sync, OffsetPeg(self.graph, sync, self.start, offset)) for sync, offset in offsets
        ]
        self.unit.release()
        self.announcer = Announcer("alice")

    def told(self, now):
        return self.announcer.changes([self.unit], now)

    def play(self, now):
        self.unit.begin()
        self.unit.fire(now)

    def volume(self, value):
        self.unit.parameters["volume"].set(value)


@pytest.fixture
def scene() -> Scene:
    return Scene()


def test_a_sound_is_announced_once_with_the_gain_that_it_has(scene) -> None:
    scene.volume(75.0)
    (start,) = scene.told(0.0)
    assert isinstance(start, AudioStart)
    assert (start.clip.id, start.start, start.gain) == ("alice-1", 2.0, 1.5)
    assert scene.told(0.0) == scene.told(0.01) == ()


@pytest.mark.parametrize(("volume", "gain"), [(0.0, 0.0), (50.0, 1.0), (100.0, 2.0)])
def test_a_volume_of_50_is_as_recorded(scene, volume, gain) -> None:
    scene.volume(volume)
    assert scene.told(0.0)[0].gain == gain


def test_a_gain_is_told_when_it_changes_and_at_most_once_a_tick(scene) -> None:
    scene.told(0.0)
    scene.volume(60.0)
    assert scene.told(2.1) == (AudioGain("alice-1", 1.2, 2.1),)
    scene.volume(70.0)
    assert scene.told(2.1) == ()
    assert scene.told(2.11) == (AudioGain("alice-1", 1.4, 2.11),)
    assert scene.told(2.12) == ()


def test_a_start_that_moves_is_told(scene) -> None:
    scene.told(0.0)
    with scene.graph.transaction("move"):
        scene.start.set(2.5)
    assert scene.told(0.01) == (AudioMove("alice-1", 2.5),)


def test_a_speech_that_is_cut_falls_silent_then_and_one_that_ends_has_nothing_to_say(scene) -> None:
    scene.told(0.0)
    scene.play(2.0)
    scene.unit.interrupt(2.4)
    assert scene.told(2.4) == (AudioStop("alice-1", 2.4, 0.03),)
    whole = Scene()
    whole.told(0.0)
    whole.play(3.0)
    assert whole.told(3.0) == ()


@pytest.mark.parametrize(("asked", "end"), [(2.0, 2.0), (2.001, 2.5), (2.5, 2.5), (2.6, 3.0), (3.0, 3.0)])
def test_it_ends_gently_where_the_next_word_would_begin_or_with_its_last(scene, asked, end) -> None:
    scene.play(2.0)
    assert scene.unit.gentle_end(asked) == end


def test_one_that_has_not_begun_may_end_at_once(scene) -> None:
    assert scene.unit.gentle_end(1.0) == 1.0
