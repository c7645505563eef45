"""From the events of espeak-ng to the times of words, marks and phonemes: with replies made by hand."""

import pytest

from reactive_realizer.engines.speech.espeak_reply import as_utterance
from reactive_realizer.engines.speech.messages import Message
from reactive_realizer.engines.speech.ssml import marked_up

RATE = 1000


def utterance(text, words=(), marks=(), reported=(), phonemes=(), duration=2000):
    """Words are reported at (time in ms, character of the text), phonemes as (time in ms, symbol)."""
    markup = marked_up(text, tuple(place for _, place in marks))
    positions = [(time, markup.origins.index(character) + 1) for time, character in words]
    header = {"sample_rate": RATE, "words": positions, "marks": reported, "phonemes": phonemes}
    return as_utterance(Message(header, bytes(2 * duration)), text, marks, markup)


def starts(spoken):
    return [(word.text, word.start) for word in spoken.words]


def test_the_duration_is_that_of_the_audio():
    assert utterance("a", duration=1234).duration == 1.234


def test_words_have_the_times_that_were_reported():
    assert starts(utterance("red box", [(100, 0), (400, 4)])) == [("red", 0.1), ("box", 0.4)]


def test_of_a_number_that_sounds_like_several_words_the_first_counts():
    assert starts(utterance("in 1984 again", [(0, 0), (200, 3), (500, 4), (700, 4), (900, 8)])) == [
        ("in", 0.0),
        ("1984", 0.2),
        ("again", 0.9),
    ]


def test_a_word_reported_at_the_quotation_mark_before_it_is_that_word():
    assert starts(utterance('so "good" it', [(0, 0), (300, 3), (600, 10)])) == [("so", 0.0), ("good", 0.3), ("it", 0.6)]


def test_a_word_that_was_not_reported_gets_a_time_between_its_neighbors_by_the_number_of_characters():
    assert starts(utterance("of a b", [(0, 0), (500, 5)])) == [("of", 0.0), ("a", pytest.approx(0.3)), ("b", 0.5)]


def test_a_last_word_that_was_not_reported_begins_before_the_sound_ends():
    spoken = utterance("think of", [(0, 0)], phonemes=[(0, "θ"), (600, "ə"), (800, ""), (1900, "")])
    assert 0.0 < spoken.words[1].start < 0.8


def test_words_never_go_back_in_time():
    assert starts(utterance("a b c", [(0, 0), (500, 2), (400, 4)])) == [("a", 0.0), ("b", 0.5), ("c", 0.5)]


def test_marks_have_the_times_that_were_reported_under_their_own_names():
    spoken = utterance("red box", [(0, 0), (400, 4)], [("x'\"<", 4), ("end", 7)], [("m1", 900), ("m0", 400)])
    assert dict(spoken.marks) == {"x'\"<": 0.4, "end": 0.9}


def test_a_mark_that_was_not_reported_has_the_time_of_the_word_after_it_or_of_the_end():
    spoken = utterance("red box", [(0, 0), (400, 4)], [("a", 4), ("b", 7)])
    assert dict(spoken.marks) == {"a": 0.4, "b": 2.0}


def test_marks_keep_the_order_of_the_text():
    spoken = utterance("a b c", [(0, 0), (200, 2), (400, 4)], [("late", 4), ("early", 2)], [("m1", 500)])
    assert list(spoken.marks.items()) == [("early", 0.5), ("late", 0.5)]


def test_a_phoneme_lasts_until_the_next_and_the_last_until_the_end():
    spoken = utterance("a", phonemes=[(100, "ə"), (250, "n"), (400, "")], duration=1000)
    assert [(p.symbol, p.start, round(p.duration, 9)) for p in spoken.phonemes] == [
        ("ə", 0.1, 0.15),
        ("n", 0.25, 0.15),
        ("", 0.4, 0.6),
    ]
