"""The utterance made of what the network answers; its answers are made by hand, in frames of 25 ms."""

from collections.abc import Sequence
from itertools import repeat

import numpy as np
import pytest

from reactive_realizer.engine.tts import Utterance, word_spans
from reactive_realizer.engines.speech.espeak_utterance import PronouncedWord
from reactive_realizer.engines.speech.kokoro.voice import FORMAT, alphabet
from reactive_realizer.engines.speech.neural.pronunciation import sentences
from reactive_realizer.engines.speech.neural.timed_sentence import TimedSentence
from reactive_realizer.engines.speech.neural.utterance import SentenceSound, as_utterance

RATE, FRAME = FORMAT.rate, FORMAT.length


def pronounced(text: str, *sounds: str) -> list[PronouncedWord]:
    return [
        PronouncedWord(first, last, tuple(own.split()), pause=True)
        for (first, last), own in zip(word_spans(text), sounds, strict=True)
    ]


def timed(text: str, words: Sequence[PronouncedWord], *durations: Sequence[float]) -> list[TimedSentence]:
    """The sentences of a text, with frames for each token."""
    written = list(sentences(text, words, alphabet("a")))
    return [
        TimedSentence(sentence, frames, last=sentence is written[-1], format=FORMAT)
        for sentence, frames in zip(written, durations, strict=True)
    ]


def sound(sentence: TimedSentence, samples: np.ndarray, length: float = 99.0) -> list[bytes]:
    """What is kept of the samples of a sentence, in pieces of about a length, s."""
    spoken, pieces = SentenceSound(RATE), sentence.pieces(repeat(length))
    frames = [samples[piece.frames[0] * FRAME : piece.frames[1] * FRAME].tobytes() for piece in pieces]
    return [spoken.add(piece, own, last=piece is pieces[-1]) for piece, own in zip(pieces, frames, strict=True)]


def utterance(
    text: str, *sounds: str, durations: tuple[list[int], ...], marks: dict[str, int] | None = None
) -> Utterance:
    """Of words with sounds, spoken with frames for each token; the audio is a constant."""
    words = pronounced(text, *sounds)
    spoken = timed(text, words, *durations)
    constants = [np.full(FRAME * sum(frames), 1000, "<i2") for frames in durations]
    audio = [b"".join(sound(*each)) for each in zip(spoken, constants, strict=True)]
    return as_utterance(text, words, tuple((marks or {}).items()), spoken, b"".join(audio), RATE)


def test_sounds_and_words_have_the_times_of_their_tokens_which_are_heard_earlier() -> None:
    # Silence, m, i, space, s, stop, silence. Of the silence before the first sound, 0.03 s are kept.
    spoken = utterance("me C.", "m i", "s", durations=([10, 4, 6, 2, 8, 20, 10],), marks={"second": 3})
    assert [word.start for word in spoken.words] == pytest.approx([0.03, 0.33])
    assert [phoneme.symbol for phoneme in spoken.phonemes] == ["m", "i", "s", ""]
    assert [phoneme.start for phoneme in spoken.phonemes] == pytest.approx([0.03, 0.13, 0.33, 0.53])
    assert spoken.marks["second"] == spoken.words[1].start
    assert spoken.duration == pytest.approx(0.73)  # 0.2 s are kept after the last sound
    assert len(spoken.audio) == 2 * round(spoken.duration * RATE)


def test_the_onset_of_a_plosive_is_its_release() -> None:
    spoken = utterance("bee", "b i", durations=([10, 4, 6, 10],))
    assert spoken.phonemes[0].start == pytest.approx(0.03 + 0.04)
    short = utterance("bee", "b i", durations=([10, 1, 6, 10],))
    assert short.phonemes[0].start == pytest.approx(0.03 + 0.0125)
    assert short.phonemes[0].duration > 0.0, "otherwise the lips would not close"


def test_a_comma_is_a_pause_between_sounds_and_a_space_is_none() -> None:
    # Silence, m, comma, space, s, space, s, silence.
    spoken = utterance("m, C C", "m", "s", "s", durations=([10, 4, 10, 2, 4, 2, 4, 10],))
    assert [phoneme.symbol for phoneme in spoken.phonemes] == ["m", "", "s", "s", ""]


def test_sentences_follow_each_other_after_the_pause_of_their_stop() -> None:
    # Silence, sound, stop, silence; the sounds begin 0.3 s and 0.2 s apart from their silence.
    spoken = utterance("C. C.", "s", "s", durations=([10, 4, 12, 5], [20, 4, 12, 5]))
    first, second = spoken.words
    assert first.start == pytest.approx(0.03)
    assert second.start == pytest.approx(0.03 + 16 * 0.025 + 0.03)
    assert spoken.duration == pytest.approx(second.start + 0.1 + 0.2)


def test_a_sentence_that_ends_before_its_lag_has_no_sound_and_takes_no_time() -> None:
    spoken = utterance("C. C.", "s", "s", durations=([1, 1, 0, 1], [10, 4, 12, 5]))
    assert [word.start for word in spoken.words] == pytest.approx([0.0, 0.03])
    assert len(spoken.audio) == 2 * round(spoken.duration * RATE)


def test_the_sound_has_no_clicks_at_its_ends() -> None:
    samples = np.frombuffer(utterance("C", "s", durations=([10, 4, 12],)).audio, "<i2")
    assert samples[0] == samples[-1] == 0
    assert samples[len(samples) // 2] == 1000


WORDS = ["m i s i", "p i s i", "m i m i", "s i s i", "n i n i", "t i n i"]


def long_sentence() -> TimedSentence:
    text = "a b c, d e f"
    words = pronounced(text, *WORDS)
    (sentence,) = sentences(text, words, alphabet("a"))
    durations = [10.0, *([6.0] * len(sentence.tokens)), 10.0]
    comma = alphabet("a").tokens[","]
    durations[1 + sentence.tokens.index(comma)] = 20.0
    return TimedSentence(sentence, durations, last=True, format=FORMAT)


def test_pieces_join_to_the_sound_of_the_sentence() -> None:
    sentence = long_sentence()
    samples = np.random.default_rng(1).integers(-9000, 9000, round(sum(sentence.durations)) * FRAME).astype("<i2")
    (whole,), pieces = sound(sentence, samples), sound(sentence, samples, 0.9)
    assert len(pieces) > 3
    assert all(len(piece) / 2 / RATE >= 0.4 for piece in pieces)
    joined, expected = (np.frombuffer(each, "<i2").astype(int) for each in (b"".join(pieces), whole))
    assert np.abs(joined - expected).max() <= 1
    assert len(joined) / RATE == pytest.approx(sentence.duration)


def test_a_sentence_is_cut_after_a_pause_or_else_where_a_word_begins() -> None:
    sentence = long_sentence()
    starts = [
        start
        for before, own, (start, _) in zip(
            [None, *sentence.sentence.phonemes], sentence.sentence.phonemes, sentence.times, strict=False
        )
        if before is None or before.word != own.word
    ]
    first, _ = (len(each) / 2 / RATE for each in sound(sentence, np.zeros(10**6, "<i2"), 2.5))
    assert first == pytest.approx(starts[3] - 0.03), "after the comma"
    ends = np.cumsum([len(each) / 2 / RATE for each in sound(sentence, np.zeros(10**6, "<i2"), 0.9)])[:-1]
    assert all(min(abs(end - start) for start in starts) <= 0.0301 for end in ends)


def test_a_word_of_many_seconds_is_cut_too() -> None:
    words = pronounced("a", "s " * 100)
    (sentence,) = timed("a", words, [10, *[8] * 100, 10])
    lengths = [len(each) / 2 / RATE for each in sound(sentence, np.zeros(10**6, "<i2"), 2.5)]
    assert sum(lengths) == pytest.approx(sentence.duration)
    assert max(lengths) < 4.5


def test_a_text_without_sounds_has_no_audio() -> None:
    spoken = utterance("...", durations=(), marks={"m": 1})
    assert (spoken.words, spoken.duration, spoken.audio, spoken.marks["m"]) == ((), 0.0, b"", 0.0)
