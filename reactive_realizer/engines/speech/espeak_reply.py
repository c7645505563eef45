"""From what espeak-ng reports to an `Utterance`."""

from bisect import bisect_right
from collections.abc import Mapping
from dataclasses import replace
from itertools import accumulate, pairwise
from types import MappingProxyType

import numpy as np

from reactive_realizer.engine.tts import Phoneme, Utterance, Word
from reactive_realizer.engines.speech.messages import Message
from reactive_realizer.engines.speech.ssml import Markup
from reactive_realizer.engines.speech.words import word_spans

_BYTES_PER_SAMPLE = 2


def as_utterance(reply: Message, text: str, marks: tuple[tuple[str, int], ...], markup: Markup) -> Utterance:
    """The utterance that a reply of the worker tells of; its marks are numbered as in the markup."""
    rate: int = reply.header["sample_rate"]
    duration = len(reply.body) / _BYTES_PER_SAMPLE / rate
    phonemes = _phonemes([(sample / rate, symbol) for sample, symbol in reply.header["phonemes"]], duration)
    silent = max((phoneme.start + phoneme.duration for phoneme in phonemes if phoneme.symbol), default=duration)
    begun = [(sample / rate, markup.origin(position)) for sample, position in reply.header["words"]]
    words = _words(text, begun, silent)
    unmarked = Utterance(text, duration, words, MappingProxyType({}), phonemes, reply.body, rate)
    reported = {name: sample / rate for name, sample in reply.header["marks"]}
    return replace(unmarked, marks=MappingProxyType(_marks(marks, reported, unmarked)))


def _phonemes(onsets: list[tuple[float, str]], duration: float) -> tuple[Phoneme, ...]:
    return tuple(
        Phoneme(symbol, start, end - start) for (start, symbol), (end, _) in pairwise([*onsets, (duration, "")])
    )


def _marks(marks: tuple[tuple[str, int], ...], reported: Mapping[str, float], spoken: Utterance) -> dict[str, float]:
    """The times of the marks, s, in the order of the text; some that follow an abbreviation are not reported."""
    ordered = sorted(enumerate(marks), key=lambda mark: mark[1][1])
    times = [reported.get(f"m{n}", spoken.time_of_character(index)) for n, (_, index) in ordered]
    return {name: time for (_, (name, _)), time in zip(ordered, accumulate(times, max), strict=True)}


def _words(text: str, begun: list[tuple[float, int]], silent: float) -> tuple[Word, ...]:
    """The words of a text with their times.

    espeak-ng counts spoken words: it reports several for a number or an address (the first counts), and one for little
    words that it runs together (the rest get a time between their neighbors, by the number of characters).

    Args:
        text: what was spoken.
        begun: time, s, and index of the character at which espeak-ng reported a word.
        silent: when the last word has been spoken, s.
    """
    spans = word_spans(text)
    ends = [last for _, last in spans]
    known: dict[int, float] = {}
    for time, character in begun:
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
