"""The silent voice: gives a text plausible times (thesis 8.10, TextEngine)."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from types import MappingProxyType
from typing import Final

from reactive_realizer.bml.markup import Markup, MarkupKind
from reactive_realizer.engine.tts import CLAUSE_ENDS, SENTENCE_ENDS, Utterance, VoiceCapabilities, Word, word_spans

_CHARACTER = 0.06
"""Duration of a character, s; with five letters and a space a word, about 170 words a minute (espeak-ng: 175)."""
_CLAUSE = 0.2
"""Silence after a comma or a similar mark, s."""
_SENTENCE = 0.4
"""Silence after a sentence, s."""
_EMPHASIS: Final[Mapping[str, float]] = MappingProxyType({"strong": 1.4, "moderate": 1.2, "reduced": 0.9})
"""How many times as long emphasized words take, by its level."""
_FOLLOWED: Final = frozenset({MarkupKind.BREAK, MarkupKind.EMPHASIS})


class TextVoice:
    """A `MarkupTTSBinding` without sound: every character takes the same time, and punctuation adds a pause.

    The times depend on the text and its markup only, so they are the same on every machine. It answers at once.
    """

    async def start(self) -> None:
        """Does nothing."""

    async def close(self) -> None:
        """Does nothing."""

    async def voices(self) -> tuple[str, ...]:
        """No names: the one voice accepts every name."""
        return ()

    async def capabilities(self) -> VoiceCapabilities:
        """Silence, in any language, with breaks and emphasis."""
        return VoiceCapabilities(sound=False, markup=_FOLLOWED)

    def synthesize(self, text: str, marks: tuple[tuple[str, int], ...], voice: str | None = None) -> Utterance:
        """The utterance of a plain text, without phonemes and sound.

        Args:
            text: plain text, no markup; runs of white space count as one space.
            marks: (name, index into the text) of each mark; its time is the start of the word at or after it, or the
                end of the utterance.
            voice: ignored.
        """
        return self.synthesize_markup(text, marks, voice, ())

    def synthesize_markup(
        self, text: str, marks: tuple[tuple[str, int], ...], voice: str | None, markup: tuple[Markup, ...]
    ) -> Utterance:
        """The utterance of a text with breaks before its words and words that are emphasized, which take longer."""
        words = _timed(text, markup)
        duration = _end(words[-1], len(text), markup) if words else 0.0
        unmarked = Utterance(text, duration, words, MappingProxyType({}))
        times = {name: unmarked.time_of_character(index) for name, index in marks}
        left_out = tuple(each for each in markup if each.kind not in _FOLLOWED)
        return replace(unmarked, marks=MappingProxyType(times), left_out=left_out)


def _timed(text: str, markup: Sequence[Markup]) -> tuple[Word, ...]:
    words = []
    start, before = 0.0, -1
    for (first, last), (following, _) in pairwise([*word_spans(text), (len(text), len(text))]):
        start += _silence(before, first, markup)
        words.append(Word(text[first:last], start, first, last))
        start += _length(first, last, markup) + _CHARACTER + _pause(text[last:following])
        before = first
    return tuple(words)


def _end(last: Word, length: int, markup: Sequence[Markup]) -> float:
    """Time at which the last word and the breaks after it end, s, in a text with some number of characters."""
    return last.start + _length(last.first, last.last, markup) + _silence(last.first, length, markup)


def _length(first: int, last: int, markup: Sequence[Markup]) -> float:
    """Duration of the word between two characters, s; of emphasis inside of emphasis, the inner one counts."""
    levels = [each.text for each in markup if each.kind is MarkupKind.EMPHASIS and each.first <= first < each.last]
    return _CHARACTER * (last - first) * (_EMPHASIS.get(levels[-1], 1.0) if levels else 1.0)


def _silence(before: int, first: int, markup: Sequence[Markup]) -> float:
    """Silence of the breaks between two words, by their first characters, s."""
    return sum(each.number for each in markup if each.kind is MarkupKind.BREAK and before < each.first <= first)


def _pause(between: str) -> float:
    """Silence for the text between two words, s."""
    if any(mark in between for mark in SENTENCE_ENDS):
        return _SENTENCE
    return _CLAUSE if any(mark in between for mark in CLAUSE_ENDS) else 0.0
