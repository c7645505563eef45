"""Utterances, and the interface of text-to-speech systems (thesis 8.10, TTSBinding)."""

import re
from collections.abc import AsyncIterator, Mapping
from dataclasses import dataclass
from itertools import pairwise
from math import inf
from typing import Final, Protocol, runtime_checkable

from reactive_realizer.bml.markup import Markup, MarkupKind
from reactive_realizer.clock.units import RESOLUTION
from reactive_realizer.planunit.parameter import Range

SENTENCE_ENDS: Final = ".!?\u2026"
DASHES: Final = "\u2013\u2014"
CLAUSE_ENDS: Final = ",;:" + DASHES
"""The marks that end a clause within a sentence."""
STOPS: Final = SENTENCE_ENDS + CLAUSE_ENDS
_BETWEEN_SPACES: Final = re.compile(rf"[^\s{DASHES}]+")
"""The text between white space and dashes."""
_PUNCTUATION: Final = ".,;:!?\u2026\"'()[]{}\u00ab\u00bb\u201c\u201d\u201e\u2018\u2019\u00a1\u00bf"
"""Characters around a word that are not part of it: stops, quotation marks, brackets."""
_BORDERS: Final = frozenset(STOPS + "\n")
"""Characters between two words that end a clause."""
STRETCH: Final = (0.8, 1.3)
"""How much shorter and longer speech may become and still sound natural, as factors."""
RATE_RANGE: Final = Range(0.5, 2.0)
PITCH_RANGE: Final = Range(0.5, 2.0)
"""How fast and how high speech with sound can be made while it plays, as factors."""


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

    While it is being made, it is complete up to a time, and estimated from there on: all words and marks have times.

    Attributes:
        text: what is spoken.
        duration: s.
        words: in the order of the text.
        marks: time of each requested mark, s from the start of the utterance.
        phonemes: in the order of time; empty if the voice provides none.
        audio: of what is made, from the start: mono PCM, int16 little-endian; empty if the voice makes no sound.
        sample_rate: of the audio, Hz.
        made: how much of it is made, s from the start of the utterance. Times before that are final; those of
            streamed speech are corrected until they sound.
        left_out: the markup that the voice cannot follow.
        unread: the scripts in the text whose letters the voice does not read, but spells or skips.
        stretch: how much shorter and longer its parts may become, as factors; None if the voice does not say: then a
            sound can be stretched as far as it sounds natural, and an utterance without sound cannot.
    """

    text: str
    duration: float
    words: tuple[Word, ...]
    marks: Mapping[str, float]
    phonemes: tuple[Phoneme, ...] = ()
    audio: bytes = b""
    sample_rate: int = 22_050
    made: float = inf
    left_out: tuple[Markup, ...] = ()
    unread: tuple[str, ...] = ()
    stretch: tuple[float, float] | None = None

    @property
    def complete(self) -> bool:
        """Whether all of it is made."""
        return self.made >= self.duration - RESOLUTION

    def words_begun(self, time: float) -> tuple[Word, ...]:
        """The words that have begun before a time, s from the start of the utterance."""
        return tuple(word for word in self.words if word.start < time - RESOLUTION)

    def next_word(self, time: float) -> float:
        """The start of the first word at or after a time, s; the duration if there is none."""
        return next((word.start for word in self.words if word.start >= time - RESOLUTION), self.duration)

    def next_clause(self, time: float) -> float:
        """The start of the first word at or after a time that follows punctuation, s; the duration if there is none."""
        for before, word in pairwise(self.words):
            between = self.text[before.last : word.first]
            if word.start >= time - RESOLUTION and not _BORDERS.isdisjoint(between):
                return word.start
        return self.duration

    def time_of_character(self, index: int) -> float:
        """The start of the word at or after a character, s; the duration if no word follows."""
        return next((word.start for word in self.words if index < word.last), self.duration)


async def completed(spoken: Utterance | AsyncIterator[Utterance]) -> Utterance:
    """The complete utterance from an answer of `TTSBinding.synthesize`.

    Raises:
        RealizerError: the synthesis failed.
        ValueError: the iterator gives nothing.
    """
    if isinstance(spoken, Utterance):
        return spoken
    parts = [part async for part in spoken]
    if not parts:
        raise ValueError("the voice says nothing")
    return parts[-1]


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


@dataclass(frozen=True, slots=True)
class VoiceCapabilities:
    """What a text-to-speech system can do.

    Attributes:
        sound: whether its utterances have audio.
        languages: language tags in lower case, such as ``en-us``, sorted; none if it is not bound to any.
        markup: the kinds that it follows, at least some values of each; none if it follows no markup.
        stretch: how much shorter and longer the parts of its utterances may become, as in these (`Utterance.stretch`).
    """

    sound: bool
    languages: tuple[str, ...] = ()
    markup: frozenset[MarkupKind] = frozenset()
    stretch: tuple[float, float] | None = None

    @property
    def stretch_range(self) -> Range | None:
        """How much shorter and longer its speeches become where constraints ask for it; None if they do not."""
        stretch = self.stretch or (STRETCH if self.sound else None)
        return None if stretch is None else Range(*stretch)

    @property
    def rate_range(self) -> Range | None:
        """The values of the parameter ``rate``; None if its speeches have none."""
        return RATE_RANGE if self.sound else None

    @property
    def pitch_range(self) -> Range | None:
        """The values of the parameter ``pitch``; None if its speeches have none."""
        return PITCH_RANGE if self.sound else None


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

    async def capabilities(self) -> VoiceCapabilities:
        """What it can do, for clients that choose what to ask of it.

        Raises:
            RealizerError: as `start`.
        """
        ...

    def synthesize(
        self, text: str, marks: tuple[tuple[str, int], ...], voice: str | None
    ) -> Utterance | AsyncIterator[Utterance]:
        """Speaks a text.

        With a fast system, a speech can start in the tick in which it is planned. A slow one works outside of the
        thread of the event loop, and returns an iterator, usually an async generator: it gives the utterance as it is
        known so far, each time that more of it is made, and at last the complete one. What was made does not change. An
        iterator of which an item is canceled is not continued.

        Args:
            text: plain text, no markup.
            marks: (name, index into the text) of each mark.
            voice: one of its names; None for its default.

        Raises:
            RealizerError: the voice is unknown or the synthesis failed; the next call is not affected.
        """
        ...


@runtime_checkable
class MarkupTTSBinding(TTSBinding, Protocol):
    """A text-to-speech system that follows markup, such as that of SSML."""

    def synthesize_markup(
        self, text: str, marks: tuple[tuple[str, int], ...], voice: str | None, markup: tuple[Markup, ...]
    ) -> Utterance | AsyncIterator[Utterance]:
        """Speaks a text with markup; see `TTSBinding.synthesize`.

        Args:
            text: plain text.
            marks: (name, index into the text) of each mark.
            voice: one of its names; None for its default.
            markup: of the text, outer parts first. What the voice cannot follow is in ``left_out`` of the utterance.

        Raises:
            RealizerError: as `TTSBinding.synthesize`.
        """
        ...
