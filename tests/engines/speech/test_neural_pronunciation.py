"""What the network of the natural voice is told."""

import pytest

from reactive_realizer.engine.tts import word_spans
from reactive_realizer.engines.speech.espeak_utterance import PronouncedWord
from reactive_realizer.engines.speech.kokoro.voice import alphabet
from reactive_realizer.engines.speech.neural.pronunciation import Sentence, sentences

CHARACTERS = {token: character for character, token in alphabet("a").tokens.items()}


def pronounced(text: str, *sounds: str, pauses: frozenset[int] = frozenset()) -> list[PronouncedWord]:
    """The words of a text with their sounds, separated by spaces, and the numbers of those before a pause."""
    spans = word_spans(text)
    return [
        PronouncedWord(first, last, tuple(own.split()), pause=number in pauses or number == len(spans) - 1)
        for number, ((first, last), own) in enumerate(zip(spans, sounds, strict=True))
    ]


def told(text: str, *sounds: str, pauses: frozenset[int] = frozenset(), accent: str = "a") -> list[str]:
    return [written(each) for each in sentences(text, pronounced(text, *sounds, pauses=pauses), alphabet(accent))]


def written(sentence: Sentence) -> str:
    return "".join(CHARACTERS[token] for token in sentence.tokens)


def test_words_are_separated_by_spaces_and_keep_their_punctuation_where_there_is_a_pause() -> None:
    assert told('Me, "you".', "m i\u02d0", "j u\u02d0", pauses=frozenset({0})) == ['mi, "ju".']
    assert told("Dr. Me", "d", "m i") == ["d mi"]


def test_sounds_are_written_in_the_manner_of_the_accent_with_the_stress_in_front() -> None:
    assert told("go", "\u0261 \u02c8o\u028a") == ["\u0261\u02c8O"]
    assert told("go", "\u0261 \u02c8\u0259\u028a", accent="b") == ["\u0261\u02c8Q"]
    assert told("jar", "d\u0292 \u0251\u02d0") == ["\u02a4\u0251"]
    assert told("jar", "d\u0292 \u0251\u02d0", accent="b") == ["\u02a4\u0251\u02d0"]


def test_a_sound_that_cannot_be_written_is_left_out() -> None:
    assert told("a b", "\u0153\u0303 \u01c0", "b") == ["\u0153\u0303 b"]
    assert told("a", "\u01c0") == []


def test_each_sentence_is_spoken_for_itself_and_an_abbreviation_does_not_end_one() -> None:
    assert told("A. B? C", "a", "b", "s", pauses=frozenset({0, 1})) == ["a.", "b?", "s"]
    assert told("A. B? C", "a", "b", "s", pauses=frozenset({1})) == ["a b?", "s"]


@pytest.mark.parametrize("text", ["one " * 400, "one, " * 400])
def test_a_text_without_stops_is_cut_so_that_it_fits(text: str) -> None:
    words = pronounced(text, *["w \u02c8\u028c n"] * 400, pauses=frozenset(range(400)))
    made = list(sentences(text, words, alphabet("a")))
    assert len(made) > 3
    assert all(0 < len(each.tokens) <= 510 for each in made)
    assert [phoneme.word for each in made for phoneme in each.phonemes] == [
        word for word in range(400) for _ in range(3)
    ]


def test_a_single_endless_word_goes_on_in_the_next_sentence_where_it_no_longer_fits() -> None:
    made = list(sentences("a", pronounced("a", "s " * 2000), alphabet("a")))
    assert [len(each.tokens) for each in made] == [510, 510, 510, 470]
    assert [(each.phonemes[0].first, each.phonemes[-1].last) for each in made] == [
        (0, len(each.tokens)) for each in made
    ]
