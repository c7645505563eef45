"""From timed sentences and the sound that is made of them to an `Utterance`."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import accumulate, pairwise
from types import MappingProxyType

import numpy as np
import numpy.typing as npt

from reactive_realizer.engine.phonetics import onset
from reactive_realizer.engine.tts import Phoneme, Utterance
from reactive_realizer.engines.speech.espeak_utterance import PronouncedWord, timed_words
from reactive_realizer.engines.speech.neural.timed_sentence import PAUSE, Piece, TimedSentence

Samples = npt.NDArray[np.int16]
"""Mono."""

_FADE = 0.01
"""Time over which the ends of sentences are faded, and two pieces of a sentence are cross-faded, s."""


def as_utterance(
    text: str,
    words: Sequence[PronouncedWord],
    marks: tuple[tuple[str, int], ...],
    sentences: Sequence[TimedSentence],
    audio: bytes,
    rate: int,
) -> Utterance:
    """The utterance of a text.

    Args:
        text: plain text.
        words: all of its words.
        marks: as for `TTSBinding.synthesize`.
        sentences: all of its sentences in their order.
        audio: what is made of them.
        rate: its sample rate, Hz.
    """
    begins = [*accumulate((each.duration + each.sentence.silence for each in sentences), initial=0.0)]
    onsets: list[tuple[float, str]] = []
    begun: list[tuple[float, int]] = []
    for timed, begin in zip(sentences, begins, strict=False):
        following = [*(start for start, _ in timed.times[1:]), float("inf")]
        for phoneme, (start, end), next_ in zip(timed.sentence.phonemes, timed.times, following, strict=True):
            onsets.append((begin + onset(phoneme.symbol, start, end), phoneme.symbol))
            begun.append((begin + start, words[phoneme.word].first))
            onsets += [(begin + end, "")] if next_ - end >= PAUSE else []
    silent, duration = onsets[-1][0] if onsets else 0.0, begins[-1]
    phonemes = [Phoneme(symbol, at, end - at) for (at, symbol), (end, _) in pairwise([*onsets, (duration, "")])]
    spans = timed_words(text, begun, silent)
    made = len(audio) / 2 / rate
    unmarked = Utterance(text, duration, spans, MappingProxyType({}), tuple(phonemes), audio, rate, made)
    times = {name: unmarked.time_of_character(index) for name, index in marks}
    return replace(unmarked, marks=MappingProxyType(times))


class SentenceSound:
    """The sound of a sentence, piece by piece, without clicks between pieces and at its ends.

    Args:
        rate: its sample rate, Hz.
    """

    def __init__(self, rate: int) -> None:
        self._fade = round(_FADE * rate)
        self._tail: Samples | None = None

    def add(self, piece: Piece, spoken: bytes, *, last: bool) -> bytes:
        """The sound of a piece.

        Args:
            piece: of the sentence.
            spoken: the sound of its frames.
            last: whether no other piece follows.
        """
        samples = np.frombuffer(spoken, "<i2")
        own = samples[piece.first : piece.last].astype(np.float64)
        fade = min(self._fade, len(own))
        ramp = np.arange(fade) / self._fade
        own[:fade] *= ramp
        if self._tail is not None:
            before = self._tail[:fade]
            own[: len(before)] += before * (1.0 - ramp[: len(before)])
        self._tail = samples[piece.last : piece.last + self._fade]
        if last and fade:
            own[-fade:] *= ramp[::-1]
        return own.astype("<i2").tobytes()
