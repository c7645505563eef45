"""Utterances are divided into phrases, and some of their words are prominent."""

from dataclasses import replace

import pytest

from reactive_realizer.embodiment.audio import Sound
from reactive_realizer.engine.sound_unit import SoundPart
from reactive_realizer.engine.tts import Phoneme, Utterance, Word, word_spans
from reactive_realizer.liveliness.prosody import MOST_WORDS, Phrase, phrases_of, with_prominence

from .conftest import RATE, voice

FUNCTION_WORDS = frozenset({"the", "is", "and", "of", "it"})


def utterance(text: str, sound: bytes = b"", stressed: int | None = None) -> Utterance:
    """A text with half a second for each word, of which one has a stressed vowel."""
    spans = word_spans(text)
    words = tuple(Word(text[first:last], number / 2, first, last) for number, (first, last) in enumerate(spans))
    symbols = ["\u02c8a" if number == stressed else "a" for number in range(len(words))]
    phonemes = tuple(Phoneme(symbol, number / 2 + 0.1, 0.3) for number, symbol in enumerate(symbols))
    return Utterance(text, len(words) / 2, words, {}, () if stressed is None else phonemes, sound, RATE)


def sounds(said: Utterance, pause: float = 0.0) -> list[SoundPart]:
    """The sound of an utterance in two parts, the second of which is waited for."""
    half = len(said.audio) // 4 * 2
    first, second = (Sound.from_pcm(part, RATE) for part in (said.audio[:half], said.audio[half:]))
    return [SoundPart(0.0, first), SoundPart(first.duration + pause, second)] if said.audio else []


def texts(phrases: list[Phrase]) -> list[str]:
    return [" ".join(word.text for word in phrase.words) for phrase in phrases]


def test_punctuation_divides_phrases() -> None:
    phrases = phrases_of(utterance("Well, it is late. Is it?"), FUNCTION_WORDS)
    assert texts(phrases) == ["well", "it is late", "is it"]
    assert [(phrase.closing, phrase.sentence) for phrase in phrases] == [(",", "."), (".", "."), ("?", "?")]


def test_a_long_phrase_is_divided_before_a_function_word() -> None:
    phrases = phrases_of(utterance("one two three four five six and seven eight nine ten"), FUNCTION_WORDS)
    assert texts(phrases) == ["one two three four five six", "and seven eight nine ten"]


def test_no_phrase_is_too_long() -> None:
    phrases = phrases_of(utterance("word " * 100), FUNCTION_WORDS)
    assert max(len(phrase.words) for phrase in phrases) <= MOST_WORDS
    assert sum(len(phrase.words) for phrase in phrases) == 100


@pytest.mark.parametrize(
    ("text", "items"), [("red, green, and blue", [True] * 3), ("it is late, and it is dark", [False] * 2)]
)
def test_a_list_has_several_short_items_and_a_conjunction(text: str, items: list[bool]) -> None:
    assert [phrase.item for phrase in phrases_of(utterance(text), FUNCTION_WORDS)] == items


def test_a_phrase_ends_when_its_last_word_has_sounded() -> None:
    (phrase,) = phrases_of(utterance("one two", stressed=0), FUNCTION_WORDS)
    assert [phrase.end, phrase.pause] == pytest.approx([0.9, 0.1])


def test_a_word_with_stress_is_prominent_and_its_accent_is_on_the_vowel() -> None:
    (phrase,) = phrases_of(said := utterance("old new old", stressed=1), FUNCTION_WORDS)
    before, stressed, after = with_prominence(phrase, said, sounds(said)).words
    assert stressed.prominence > max(before.prominence, after.prominence)
    assert stressed.accent == pytest.approx(0.75)


def test_a_word_with_a_high_pitch_is_prominent() -> None:
    said = utterance("old new old", voice(150.0) + voice(200.0) + voice(150.0))
    (phrase,) = phrases_of(said, FUNCTION_WORDS)
    low, high, _ = with_prominence(phrase, said, sounds(said)).words
    assert high.prominence - low.prominence == pytest.approx(0.4, abs=0.01)


def test_the_pitch_is_that_of_the_sound_as_it_is_heard() -> None:
    said = utterance("old new old new", voice(150.0) + voice(150.0) + voice(150.0) + voice(200.0))
    starts = (0.0, 0.5, 2.0, 2.5)  # the last two are waited for
    words = tuple(replace(word, start=start) for word, start in zip(said.words, starts, strict=True))
    later = replace(said, words=words, duration=3.0)
    (phrase,) = phrases_of(later, FUNCTION_WORDS)
    *others, last = (word.prominence for word in with_prominence(phrase, later, sounds(said, pause=1.0)).words)
    assert last > max(others) + 0.3


def test_the_pitch_of_a_phrase_that_lasts_for_long_is_not_estimated() -> None:
    said = utterance("old new of", voice(150.0) + voice(200.0) + voice(150.0, seconds=20.0))
    (phrase,) = phrases_of(replace(said, duration=21.0), FUNCTION_WORDS)
    low, high, _ = with_prominence(phrase, said, sounds(said)).words
    assert low.prominence == high.prominence


def test_without_sound_and_phonemes_content_words_are_prominent() -> None:
    said = utterance("the top of it")
    (phrase,) = phrases_of(said, FUNCTION_WORDS)
    assert [word.prominence for word in with_prominence(phrase, said, sounds(said)).words] == pytest.approx(
        [0.0, 1.0, 0.0, 0.0]
    )
