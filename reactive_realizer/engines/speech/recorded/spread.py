"""Estimated times of a recorded speech: its words spread over what is heard, by their numbers of characters."""

from collections.abc import Sequence
from itertools import accumulate, pairwise

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.engine.tts import Phoneme
from reactive_realizer.engines.speech.recorded.phones import CMU, spelled
from reactive_realizer.engines.speech.recorded.speech_times import SpeechTimes, phoneme

_AUDIBLE = 0.03
"""Share of the greatest amplitude that is heard as speech."""


def spread(words: Sequence[str], samples: NDArray[np.int16], rate: int) -> SpeechTimes:
    """The times of words as if every character took the same time, and one passed between words.

    Args:
        words: of the text.
        samples: mono, (N,).
        rate: of the samples, Hz.
    """
    level = np.abs(samples.astype(np.int32))
    heard = np.flatnonzero(level > _AUDIBLE * level.max())
    first, last = (heard[0] / rate, (heard[-1] + 1) / rate) if len(heard) else (0.0, len(samples) / rate)
    character = (last - first) / max(sum(len(word) + 1 for word in words) - 1, 1)
    begins = [first + character * done for done in accumulate((len(word) + 1 for word in words), initial=0)]
    spans = [(word, begin, until - character) for word, (begin, until) in zip(words, pairwise(begins), strict=True)]
    sounds = [sound for word, begin, end in spans for sound in _sounds(word, begin, end)]
    silence = [Phoneme("", last, len(samples) / rate - last)]
    return SpeechTimes(tuple(begin for _, begin, _ in spans), (*sounds, *silence))


def _sounds(word: str, begin: float, end: float) -> list[Phoneme]:
    names = spelled(word)
    length = (end - begin) / max(len(names), 1)
    return [phoneme(CMU[name], begin + k * length, begin + (k + 1) * length) for k, name in enumerate(names)]
