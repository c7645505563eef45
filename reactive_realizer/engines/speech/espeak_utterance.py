"""Converts the report of espeak-ng to an `Utterance`."""

from bisect import bisect_right
from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import accumulate, pairwise
from types import MappingProxyType

import numpy as np

from reactive_realizer.engine.tts import Phoneme, Utterance, Word, word_spans
from reactive_realizer.engines.speech.espeak_ssml import SsmlDocument
from reactive_realizer.engines.speech.worker_messages import WorkerMessage

_BYTES_PER_SAMPLE = 2


@dataclass(frozen=True, slots=True)
class PronouncedWord:
    """A word of a text, with its sounds.

    Attributes:
        first: index of its first character in the text, without the punctuation around it.
        last: index after its last character.
        sounds: IPA symbols, stress marks included; none for a word that is not spoken.
        pause: whether a pause follows, as at the end of a sentence, but not at the stop of an abbreviation.
    """

    first: int
    last: int
    sounds: tuple[str, ...]
    pause: bool


def as_utterance(
    reply: WorkerMessage, text: str, marks: tuple[tuple[str, int], ...], document: SsmlDocument
) -> Utterance:
    """The utterance in a reply of the worker; marks are numbered as in the document."""
    rate: int = reply.header["sample_rate"]
    duration = len(reply.body) / _BYTES_PER_SAMPLE / rate
    phonemes = _phonemes([(sample / rate, symbol) for sample, symbol in reply.header["phonemes"]], duration)
    silent = max((phoneme.start + phoneme.duration for phoneme in phonemes if phoneme.symbol), default=duration)
    reported_words = [(sample / rate, document.origin(position)) for sample, position, _ in reply.header["words"]]
    words = timed_words(text, reported_words, silent)
    unmarked = Utterance(
        text, duration, words, MappingProxyType({}), phonemes, reply.body, rate, left_out=document.left_out
    )
    reported_marks = {name: sample / rate for name, sample in reply.header["marks"]}
    return replace(unmarked, marks=MappingProxyType(_marks(marks, reported_marks, unmarked)))


def pronounced_words(reply: WorkerMessage, text: str, document: SsmlDocument) -> tuple[PronouncedWord, ...]:
    """The words of a text with the sounds in a reply of the worker, which has more words for a number or an address."""
    spans = word_spans(text)
    ends = [last for _, last in spans]
    symbols: list[list[str]] = [[] for _ in spans]
    reported = [symbol for _, symbol in reply.header["phonemes"]]
    words = [(document.origin(position), first) for _, position, first in reply.header["words"]]
    for (character, first), (_, last) in pairwise([*words, (len(text), len(reported))]):
        if (word := bisect_right(ends, character)) < len(spans):
            symbols[word] += reported[first:last]
    return tuple(
        PronouncedWord(first, last, tuple(filter(None, own)), pause=own[-1:] == [""])
        for (first, last), own in zip(spans, symbols, strict=True)
    )


def _phonemes(onsets: list[tuple[float, str]], duration: float) -> tuple[Phoneme, ...]:
    return tuple(
        Phoneme(symbol, start, end - start) for (start, symbol), (end, _) in pairwise([*onsets, (duration, "")])
    )


def _marks(marks: tuple[tuple[str, int], ...], reported: Mapping[str, float], spoken: Utterance) -> dict[str, float]:
    """The times of the marks, s, in the order of the text; espeak-ng misses some that follow an abbreviation."""
    ordered = sorted(enumerate(marks), key=lambda mark: mark[1][1])
    times = [reported.get(f"m{n}", spoken.time_of_character(index)) for n, (_, index) in ordered]
    return {name: time for (_, (name, _)), time in zip(ordered, accumulate(times, max), strict=True)}


def timed_words(text: str, reported: list[tuple[float, int]], silent: float) -> tuple[Word, ...]:
    """The words of a text with their times.

    Spoken words are reported. For a number or an address there are several, of which the first counts. Words without a
    report, such as short ones that are joined, get a time between their neighbors, by the number of characters.

    Args:
        text: the spoken text.
        reported: time, s, and index of a character of each spoken word.
        silent: end of the last word, s.
    """
    spans = word_spans(text)
    ends = [last for _, last in spans]
    known: dict[int, float] = {}
    for time, character in reported:
        word = bisect_right(ends, character)
        if word < len(spans):
            known.setdefault(spans[word][0], time)
    known[len(text)] = silent
    places = sorted(known)
    starts = np.interp([first for first, _ in spans], places, [known[place] for place in places])
    return tuple(
        Word(text[first:last], start, first, last)
        for (first, last), start in zip(spans, np.maximum.accumulate(starts).tolist(), strict=True)
    )
