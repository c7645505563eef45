"""The utterance made of what the network answers; its answers are made by hand, in frames of 25 ms."""

import numpy as np
import pytest

from reactive_realizer.engine.tts import Utterance, word_spans
from reactive_realizer.engines.speech.espeak_utterance import PronouncedWord
from reactive_realizer.engines.speech.kokoro.pronunciation import default_alphabet, sentences
from reactive_realizer.engines.speech.kokoro.utterance import SpokenSentence, as_utterance

RATE = 24_000


def utterance(
    text: str, *sounds: str, durations: tuple[list[int], ...], marks: dict[str, int] | None = None
) -> Utterance:
    """Of words with sounds, spoken with frames for each token; the audio is a constant."""
    words = [
        PronouncedWord(first, last, tuple(own.split()), pause=True)
        for (first, last), own in zip(word_spans(text), sounds, strict=True)
    ]
    written = sentences(text, words, "a", default_alphabet())
    spoken = [
        (sentence, SpokenSentence(np.full(600 * sum(frames), 1000, "<i2").tobytes(), frames))
        for sentence, frames in zip(written, durations, strict=True)
    ]
    return as_utterance(text, words, tuple((marks or {}).items()), spoken)


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
    assert short.phonemes[0].start == pytest.approx(0.03 + 0.025)


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


def test_the_sound_has_no_clicks_at_its_ends() -> None:
    samples = np.frombuffer(utterance("C", "s", durations=([10, 4, 12],)).audio, "<i2")
    assert samples[0] == samples[-1] == 0
    assert samples[len(samples) // 2] == 1000


def test_a_text_without_sounds_has_no_audio() -> None:
    spoken = utterance("...", durations=(), marks={"m": 1})
    assert (spoken.words, spoken.duration, spoken.audio, spoken.marks["m"]) == ((), 0.0, b"", 0.0)
