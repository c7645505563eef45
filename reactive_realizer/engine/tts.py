"""Utterances, and the interface of text-to-speech systems (thesis 8.10, TTSBinding)."""

import re
from collections.abc import Awaitable, Mapping
from dataclasses import dataclass
from typing import Final, Protocol

from reactive_realizer.clock.units import RESOLUTION

_BETWEEN_SPACES: Final = re.compile(r"[^\s\u2013\u2014]+")
"""The text between white space, en dashes and em dashes."""
_PUNCTUATION: Final = ".,;:!?\u2026\"'()[]{}\u00ab\u00bb\u201c\u201d\u201e\u2018\u2019\u00a1\u00bf"
"""Characters around a word that are not part of it: stops, quotation marks, brackets."""


@dataclass(frozen=True, slots=True)
class Word:
    """A word of a spoken text.

    Attributes:
        text: as written, without the punctuation around it.
        start: when it begins, s from the start of the utterance.
        first: index of its first character in the spoken text.
        last: index after its last character, so that ``utterance.text[first:last] == text``.
    """

    text: str
    start: float
    first: int
    last: int


@dataclass(frozen=True, slots=True)
class Phoneme:
    """A sound of an utterance.

    Attributes:
        symbol: IPA, stress marks included; empty for a pause.
        start: onset, s from the start of the utterance; of a plosive the release, after its silent closure.
        duration: s until the next phoneme.
    """

    symbol: str
    start: float
    duration: float


@dataclass(frozen=True, slots=True)
class Utterance:
    """A text as one voice speaks it; times and audio come from the same run.

    Attributes:
        text: what is spoken.
        duration: s.
        words: in the order of the text.
        marks: time of each requested mark, s from the start of the utterance.
        phonemes: in the order of time; empty if the voice provides none.
        audio: mono PCM, int16 little-endian; empty if the voice makes no sound.
        sample_rate: of the audio, Hz.
    """

    text: str
    duration: float
    words: tuple[Word, ...]
    marks: Mapping[str, float]
    phonemes: tuple[Phoneme, ...] = ()
    audio: bytes = b""
    sample_rate: int = 22_050

    def words_begun(self, time: float) -> tuple[Word, ...]:
        """The words that have begun before a time, s from the start of the utterance."""
        return tuple(word for word in self.words if word.start < time - RESOLUTION)

    def next_word(self, time: float) -> float:
        """The start of the first word at or after a time, s; the duration if there is none."""
        return next((word.start for word in self.words if word.start >= time - RESOLUTION), self.duration)

    def time_of_character(self, index: int) -> float:
        """The start of the word at or after a character, s; the duration if no word follows."""
        return next((word.start for word in self.words if index < word.last), self.duration)


def word_spans(text: str) -> tuple[tuple[int, int], ...]:
    """Character ranges (first, last), ``last`` exclusive, of the words of a text, without the punctuation around them.

    Voices that use it agree on the indices of words. Words are separated by white space or dashes: a number, an
    abbreviation or an address is one word, even if it is spoken as several.
    """
    spans = (_without_punctuation(run.start(), run.group()) for run in _BETWEEN_SPACES.finditer(text))
    return tuple((first, last) for first, last in spans if first < last)


def _without_punctuation(first: int, run: str) -> tuple[int, int]:
    first += len(run) - len(run.lstrip(_PUNCTUATION))
    return first, first + len(run.strip(_PUNCTUATION))


class TTSBinding(Protocol):
    """A text-to-speech system, which all characters of a scene share."""

    async def start(self) -> None:
        """Prepares the voices.

        Raises:
            RealizerError: the voices are not installed or do not start.
        """

    async def close(self) -> None:
        """Releases the resources of `start`."""

    async def voices(self) -> tuple[str, ...]:
        """The names that `synthesize` accepts, sorted; none if the system has only one voice.

        Raises:
            RealizerError: as `start`.
        """
        ...

    def synthesize(
        self, text: str, marks: tuple[tuple[str, int], ...], voice: str | None
    ) -> Utterance | Awaitable[Utterance]:
        """Speaks a text.

        A slow system returns an awaitable, and works outside of the thread of the event loop. With a fast one, a speech
        can start in the tick in which it is planned.

        Args:
            text: plain text, no markup.
            marks: (name, index into the text) of each mark.
            voice: one of its names; None for its default.

        Raises:
            RealizerError: the voice is unknown or the synthesis failed; the next call is not affected.
        """
        ...
