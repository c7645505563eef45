"""The voice that makes no sound: a text with plausible times (thesis 8.10, TextEngine)."""

from dataclasses import replace
from itertools import pairwise
from types import MappingProxyType

from reactive_realizer.engine.tts import Utterance, Word
from reactive_realizer.engines.speech.words import word_spans

_CHARACTER = 0.06
"""s; English words average five letters and a space: about 170 a minute, near the 175 that espeak-ng speaks."""
_CLAUSE = 0.2
"""s of silence after a comma and its like."""
_SENTENCE = 0.4
"""s of silence after the end of a sentence."""


class TextVoice:
    """A `TTSBinding` that speaks by showing: every character takes the same time, punctuation takes a pause.

    The times depend on the text alone, so they are the same on every machine. They come without waiting.
    """

    async def start(self) -> None:
        """Nothing has to be made ready."""

    async def close(self) -> None:
        """Nothing was taken."""

    async def voices(self) -> tuple[str, ...]:
        """There is one voice, whatever the name that is asked for."""
        return ()

    def synthesize(self, text: str, marks: tuple[tuple[str, int], ...], voice: str | None = None) -> Utterance:
        """The utterance of a plain text, without phonemes and sound.

        Args:
            text: plain text, no markup; runs of white space count as one space.
            marks: (name, index into the text) of the places whose times are wanted; each gets the start of the word at
                or after it, or the end of the utterance.
            voice: not read.
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
    """Silence for what stands between two words, s."""
    if any(mark in between for mark in ".!?…"):
        return _SENTENCE
    return _CLAUSE if any(mark in between for mark in ",;:\u2013\u2014") else 0.0
