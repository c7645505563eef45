"""The times of a stretched utterance."""

from types import MappingProxyType

import pytest

from reactive_realizer.engine.tts import Phoneme, Utterance, Word
from reactive_realizer.engines.speech.stretched_utterance import StretchedUtterance


def test_words_marks_and_sounds_move_together() -> None:
    words = (Word("ah", 0.0, 0, 2), Word("oh", 1.0, 3, 5))
    sounds = (Phoneme("a", 0.0, 1.0), Phoneme("o", 1.0, 0.8))
    utterance = Utterance("ah oh", 2.0, words, MappingProxyType({"m": 1.0}), sounds, bytes(4000), 1000)
    stretched = StretchedUtterance(utterance)
    stretched.follow([(2.5, 2.0)])
    timed = stretched.timed
    assert timed.duration == pytest.approx(2.5)
    assert [word.start for word in timed.words] == pytest.approx([0.0, 1.25])
    assert timed.marks["m"] == pytest.approx(1.25)
    assert [each.start for each in timed.phonemes] == pytest.approx([0.0, 1.25])
    assert [each.duration for each in timed.phonemes] == pytest.approx([1.25, 1.0])
