"""From spoken sentences to an `Utterance`."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import accumulate, pairwise
from types import MappingProxyType

import numpy as np
import numpy.typing as npt

from reactive_realizer.engine.tts import Phoneme, Utterance
from reactive_realizer.engines.speech.espeak_utterance import PronouncedWord, timed_words
from reactive_realizer.engines.speech.kokoro.pronunciation import Sentence

_RATE = 24_000
_FRAME = 600
_LAG = 0.075
"""How much later a sound begins by the durations of the network than it is heard, s: by forced alignment of 42 words
0.085 (standard deviation 0.025), of which 0.008 are the bias of the aligner."""
_BEFORE, _AFTER = 0.03, 0.2
"""Sound that is kept before the first and after the last phoneme, s."""
_FADE = 0.01
_PAUSE = 0.1
"""The shortest time between two sounds that counts as a pause, s; the space between words takes 0.025 to 0.075."""
_PLOSIVES = frozenset("pbtdkg\u0261")
_CLOSURE = 0.04
"""Silence before the release of a plosive, s."""
_STRESS = "\u02c8\u02cc"


@dataclass(frozen=True, slots=True)
class SpokenSentence:
    """The answer of the network for a sentence.

    Attributes:
        audio: mono int16 PCM, 24 kHz.
        durations: frames of 25 ms of each token, with those of the silence at both ends.
    """

    audio: bytes
    durations: Sequence[int]


@dataclass(frozen=True, slots=True)
class _Piece:
    """The audio of a sentence without most of the silence around it.

    Attributes:
        sounds: start and end of the sounds of the sentence, s from its first sample.
        samples: mono.
    """

    sounds: Sequence[tuple[float, float]]
    samples: npt.NDArray[np.int16]


def as_utterance(
    text: str,
    words: Sequence[PronouncedWord],
    marks: tuple[tuple[str, int], ...],
    spoken: Sequence[tuple[Sentence, SpokenSentence]],
) -> Utterance:
    """The utterance of a text from its sentences in their order."""
    pieces = [_piece(*each, last=number == len(spoken) - 1) for number, each in enumerate(spoken)]
    begins = [*accumulate((len(piece.samples) / _RATE for piece in pieces), initial=0.0)]
    onsets: list[tuple[float, str]] = []
    begun: list[tuple[float, int]] = []
    for (sentence, _), piece, begin in zip(spoken, pieces, begins, strict=False):
        following = [*(start for start, _ in piece.sounds[1:]), float("inf")]
        for sound, (start, end), next_ in zip(sentence.sounds, piece.sounds, following, strict=True):
            onsets.append((begin + _onset(sound.symbol, start, end), sound.symbol))
            begun.append((begin + start, words[sound.word].first))
            onsets += [(begin + end, "")] if next_ - end >= _PAUSE else []
    silent, duration = onsets[-1][0] if onsets else 0.0, begins[-1]
    audio = b"".join(piece.samples.tobytes() for piece in pieces)
    phonemes = [Phoneme(symbol, at, end - at) for (at, symbol), (end, _) in pairwise([*onsets, (duration, "")])]
    spans = timed_words(text, begun, silent)
    unmarked = Utterance(text, duration, spans, MappingProxyType({}), tuple(phonemes), audio, _RATE)
    times = {name: unmarked.time_of_character(index) for name, index in marks}
    return replace(unmarked, marks=MappingProxyType(times))


def _piece(sentence: Sentence, spoken: SpokenSentence, *, last: bool) -> _Piece:
    """A sentence as it sounds within an utterance: with the pause of its stop, except for the last one."""
    borders = [frames * _FRAME / _RATE - _LAG for frames in accumulate(spoken.durations, initial=0)]
    sounds = sentence.sounds
    samples = np.frombuffer(spoken.audio, "<i2")
    end = borders[sounds[-1].last + 1]
    first = max(0, round((borders[sounds[0].first + 1] - _BEFORE) * _RATE))
    cut = round((end + _AFTER if last else max(borders[-2], end)) * _RATE)
    times = [(borders[sound.first + 1], borders[sound.last + 1]) for sound in sounds]
    heard = [(max(0.0, start - first / _RATE), end - first / _RATE) for start, end in times]
    return _Piece(heard, _faded(samples[first:cut]))


def _onset(symbol: str, start: float, end: float) -> float:
    """The onset of a sound, which is the release of a plosive, s."""
    return min(start + _CLOSURE, end) if symbol.strip(_STRESS) in _PLOSIVES else start


def _faded(samples: npt.NDArray[np.int16]) -> npt.NDArray[np.int16]:
    """Samples without clicks at their ends."""
    ramp = np.minimum(1.0, np.arange(len(samples)) / (_FADE * _RATE))
    return (samples * ramp * ramp[::-1]).astype("<i2")
