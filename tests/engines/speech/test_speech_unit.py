"""The end of a speech that is interrupted gently."""

import pytest

from reactive_realizer.bml.names import BML, Location
from reactive_realizer.bml.speech import Speech
from reactive_realizer.bml.vocabulary import InterruptSpeech
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.tts import Utterance, Word
from reactive_realizer.engines.speech.speech_unit import SpeechUnit
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.pegboard.time_peg import AnticipatorPeg, OffsetPeg
from reactive_realizer.planunit.sync_point import SyncPoint
from reactive_realizer.reactive.graph import Graph

UTTERANCE = Utterance("a b", 1.0, (Word("a", 0.0, 0, 1), Word("b", 0.5, 2, 3)), {})


@pytest.fixture
def unit() -> SpeechUnit:
    """One speech from 2 s to 3 s."""
    graph = Graph()
    start = AnticipatorPeg(graph, "start", GlobalTime(2.0))
    speech = Speech(id="s", namespace=BML, name="speech", location=Location(1, 1), order=0, text="a b")
    unit = SpeechUnit(BlockKey("alice", "b"), speech, UTTERANCE, graph)
    offsets = zip(unit.timing.points, unit.timing.offsets, strict=True)
    unit.points = [SyncPoint(sync, OffsetPeg(graph, sync, start, offset)) for sync, offset in offsets]
    unit.release()
    return unit


@pytest.mark.parametrize(("now", "end"), [(2.0, 2.0), (2.001, 2.5), (2.5, 2.5), (2.6, 3.0), (3.0, 3.0)])
def test_a_gentle_end_is_the_start_of_the_next_word_or_the_end_of_the_speech(
    unit: SpeechUnit, now: float, end: float
) -> None:
    unit.begin()
    unit.fire(unit.due_points(GlobalTime(2.0)), GlobalTime(2.0))
    assert unit.gentle_end(GlobalTime(now), InterruptSpeech.WORD) == end


def test_a_speech_that_has_not_begun_may_end_at_once(unit: SpeechUnit) -> None:
    assert unit.gentle_end(GlobalTime(1.0), InterruptSpeech.WORD) == 1.0
