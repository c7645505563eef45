"""Markup of which the network of the natural voice is told."""

import asyncio
from collections.abc import Iterator
from dataclasses import replace
from typing import Protocol

import pytest

from reactive_realizer.bml.markup import Markup, MarkupKind
from reactive_realizer.engine.tts import Utterance, completed, word_spans
from reactive_realizer.engines.speech.espeak_utterance import PronouncedWord
from reactive_realizer.engines.speech.kokoro.voice import KokoroVoice, alphabet
from reactive_realizer.engines.speech.neural.markup import MarkedRate, with_phonemes, with_stops
from reactive_realizer.engines.speech.neural.pronunciation import sentences

TEXT = "Take model A4 now"


def markup(kind: MarkupKind, part: str, text: str = "") -> Markup:
    first = TEXT.index(part)
    return Markup(kind, first, first + len(part), f"<{kind}>", text=text)


def test_a_marked_sentence_gets_a_stop_that_moves_no_character() -> None:
    assert with_stops(TEXT, [markup(MarkupKind.SENTENCE, "Take model")]) == "Take model.A4 now"
    assert with_stops(TEXT, [markup(MarkupKind.SENTENCE, "A4 now")]) == TEXT
    assert with_stops("Take it! Now", [Markup(MarkupKind.SENTENCE, 0, 8, "<s>")]) == "Take it! Now"


def test_sentences_are_cut_where_the_rate_changes_and_at_silences() -> None:
    rate = replace(markup(MarkupKind.RATE, "model A4"), number=0.8)
    inner = replace(markup(MarkupKind.RATE, "A4"), number=0.1)
    silence = Markup(MarkupKind.BREAK, TEXT.index("now"), TEXT.index("now"), "<break>", number=1.5)
    words = [PronouncedWord(first, last, ("t",), pause=False) for first, last in word_spans(TEXT)]
    cut = sentences(TEXT, words, alphabet("a"), MarkedRate([rate, inner, silence]))
    assert [([phoneme.word for phoneme in each.phonemes], each.rate, each.silence) for each in cut] == [
        ([0], 1.0, 0.0),
        ([1], 0.8, 0.0),
        ([2], 0.5, 1.5),
        ([3], 1.0, 0.0),
    ]


def test_a_pronunciation_replaces_the_sounds_of_its_words() -> None:
    words = [PronouncedWord(first, last, ("t",), pause=False) for first, last in word_spans(TEXT)]
    sounds = "\u02c8e\u026ane\u02d0 b\u0303"
    said = with_phonemes(words, [markup(MarkupKind.PHONEME, "model A4", sounds)], alphabet("a"))
    assert [word.sounds for word in said] == [("t",), ("\u02c8e\u026a", "n", "e\u02d0", "b\u0303"), (), ("t",)]


class Say(Protocol):
    """Speaks the text with markup and marks."""

    def __call__(self, *markup: Markup, marks: tuple[tuple[str, int], ...] = ()) -> Utterance: ...


@pytest.fixture(scope="module")
def say() -> Iterator[Say]:
    """Speaks by a voice that all tests share."""
    with asyncio.Runner() as runner:
        voice = KokoroVoice()

        def speak(*markup: Markup, marks: tuple[tuple[str, int], ...] = ()) -> Utterance:
            return runner.run(completed(voice.synthesize_markup(TEXT, marks, None, markup)))

        yield speak
        runner.run(voice.close())


@pytest.mark.kokoro
def test_what_is_said_instead_is_heard_and_what_the_voice_cannot_do_is_left_out(say: Say) -> None:
    spelled, other = (
        markup(MarkupKind.SUB, "A4", "A four, the black one,"),
        markup(MarkupKind.EMPHASIS, "now", "strong"),
    )
    plain = say()
    said = say(spelled, other, marks=(("m", TEXT.index("now")),))
    assert said.left_out == (other,)
    assert said.marks["m"] == said.words[3].start > plain.words[3].start + 0.5
    assert [word.text for word in said.words] == TEXT.split()


@pytest.mark.kokoro
def test_a_rate_and_a_break_are_heard(say: Say) -> None:
    slow = replace(markup(MarkupKind.RATE, "model A4"), number=0.5)
    silence = Markup(MarkupKind.BREAK, TEXT.index("now"), TEXT.index("now"), "<break>", number=1.5)
    plain, slower, later = say(), say(slow), say(silence)
    assert slower.left_out == later.left_out == ()
    begin, end = (TEXT.split().index(word) for word in ("model", "now"))
    assert _between(slower, begin, end) > 1.6 * _between(plain, begin, end)
    assert 1.5 < _between(later, end - 1, end) - _between(plain, end - 1, end) < 1.9
    assert later.duration == pytest.approx(len(later.audio) / 2 / later.sample_rate, abs=0.01)


def _between(utterance: Utterance, first: int, last: int) -> float:
    """The time from one word to another, s."""
    return utterance.words[last].start - utterance.words[first].start
