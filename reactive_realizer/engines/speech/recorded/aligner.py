"""Forced alignment: when the words and sounds of a text are heard in a recording (pocketsphinx, an extra).

Its times of words deviate by 18 to 30 ms (standard deviation) from those of synthesized voices, 95 of 100 by less than
60 ms.
"""

import asyncio
import json
import sys
from collections.abc import Iterable, Sequence
from importlib.util import find_spec

import numpy as np
import soxr
from numpy.typing import NDArray

from reactive_realizer.engine.tts import Phoneme
from reactive_realizer.engines.speech.recorded.phones import CMU, spelled
from reactive_realizer.engines.speech.recorded.speech_times import SpeechTimes, phoneme
from reactive_realizer.errors import CreationFault, RealizerError

_PROGRAM = "reactive_realizer.engines.speech.recorded.align_program"
_RATE = 16_000
_FRAME = 0.01
LAG = 0.008
"""By how much the aligner is early, s: the median of ten sentences of a voice with known durations."""
_PATIENCE = 30.0
"""Time limit for one recording, besides its duration, s: the program takes 0.5 s to start, then 0.07 s per second."""


class NoAligner(CreationFault):
    """The extra that finds words in recordings is not installed."""

    code = "no-aligner"
    template = (
        "times of words in recorded and streamed speech are estimated; for exact ones: "
        "pip install 'reactive-realizer[align]'"
    )


class CannotAlign(CreationFault):
    """A recording whose words cannot be found."""

    code = "words-estimated"
    template = "the times of words in {file} are estimated: {reason}"
    file: str
    reason: str


async def aligned(file: str, words: Sequence[str], samples: NDArray[np.int16], rate: int) -> SpeechTimes:
    """The times of words in a recording of American English, and of their sounds.

    Args:
        file: name of the recording, for messages.
        words: of the text, without punctuation.
        samples: mono, (N,).
        rate: of the samples, Hz.

    Raises:
        RealizerError: "no-aligner" or "words-estimated".
    """
    if find_spec("pocketsphinx") is None:
        raise RealizerError(NoAligner())
    plain = [word.casefold().replace("\u2019", "'") for word in words]
    if not all(map(spelled, plain)):
        raise RealizerError(CannotAlign(file=file, reason="the text has words in another script"))
    resampled = await asyncio.to_thread(soxr.resample, samples, rate, _RATE)
    duration = len(samples) / rate
    found = await _run(file, json.dumps(plain).encode() + b"\n" + resampled.tobytes(), _PATIENCE + duration)
    return SpeechTimes(tuple(phones[0][1] * _FRAME + LAG for phones in found), tuple(_phonemes(found, duration)))


async def _run(file: str, request: bytes, patience: float) -> list[list[tuple[str, int, int]]]:
    process = await asyncio.create_subprocess_exec(
        sys.executable, "-m", _PROGRAM,
        stdin=asyncio.subprocess.PIPE, stdout=asyncio.subprocess.PIPE, stderr=asyncio.subprocess.DEVNULL,
        start_new_session=True,
    )  # fmt: skip
    try:
        async with asyncio.timeout(patience):
            reply, _ = await process.communicate(request)
    except TimeoutError:
        raise RealizerError(CannotAlign(file=file, reason="the search took too long")) from None
    finally:
        if process.returncode is None:
            process.kill()
            await process.wait()
    if process.returncode != 0:
        raise RealizerError(CannotAlign(file=file, reason="the text does not fit it"))
    found: list[list[tuple[str, int, int]]] = json.loads(reply)
    return found


def _phonemes(words: Iterable[Sequence[tuple[str, int, int]]], end: float) -> Iterable[Phoneme]:
    """The sounds of all words, with the silences around and between them."""
    until = 0.0
    for name, first, frames in (phone for word in words for phone in word):
        begin = first * _FRAME + LAG
        if begin > until + _FRAME / 2:
            yield Phoneme("", until, begin - until)
        until = min(begin + frames * _FRAME, end)
        yield phoneme(CMU[name], begin, until)
    if until < end:
        yield Phoneme("", until, end - until)
