"""The silent voice: gives a text plausible times (thesis 8.10, TextEngine)."""

from dataclasses import replace
from itertools import pairwise
from types import MappingProxyType

from reactive_realizer.engine.tts import CLAUSE_ENDS, SENTENCE_ENDS, Utterance, VoiceCapabilities, Word, word_spans

_CHARACTER = 0.06
"""Duration of a character, s; with five letters and a space a word, about 170 words a minute (espeak-ng: 175)."""
_CLAUSE = 0.2
"""Silence after a comma or a similar mark, s."""
_SENTENCE = 0.4
"""Silence after a sentence, s."""


class TextVoice:
    """A `TTSBinding` without sound: every character takes the same time, and punctuation adds a pause.

    The times depend on the text only, so they are the same on every machine. `synthesize` returns at once.
    """

    async def start(self) -> None:
        """Does nothing."""

    async def close(self) -> None:
        """Does nothing."""

    async def voices(self) -> tuple[str, ...]:
        """No names: the one voice accepts every name."""
        return ()

    async def capabilities(self) -> VoiceCapabilities:
        """Silence, in any language, without markup."""
        return VoiceCapabilities(sound=False)

    def synthesize(self, text: str, marks: tuple[tuple[str, int], ...], voice: str | None = None) -> Utterance:
        """The utterance of a plain text, without phonemes and sound.

        Args:
            text: plain text, no markup; runs of white space count as one space.
            marks: (name, index into the text) of each mark; its time is the start of the word at or after it, or the
                end of the utterance.
            voice: ignored.
        """
        words = _timed(text)
        duration = words[-1].start + _CHARACTER * len(words[-1].text) if words else 0.0
        unmarked = Utterance(text, duration, words, MappingProxyType({}))
        times = {name: unmarked.time_of_character(index) for name, index in marks}
        return replace(unmarked, marks=MappingProxyType(times))


def _timed(text: str) -> tuple[Word, ...]:
    words = []
    start = 0.0
    for (first, last), (following, _) in pairwise([*word_spans(text), (len(text), len(text))]):
        words.append(Word(text[first:last], start, first, last))
        start += _CHARACTER * (last - first + 1) + _pause(text[last:following])
    return tuple(words)


def _pause(between: str) -> float:
    """Silence for the text between two words, s."""
    if any(mark in between for mark in SENTENCE_ENDS):
        return _SENTENCE
    return _CLAUSE if any(mark in between for mark in CLAUSE_ENDS) else 0.0
