"""Makes utterances of recorded speech."""

import asyncio
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import accumulate, pairwise
from pathlib import Path, PurePosixPath
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.binding.faults import NoAsset
from reactive_realizer.bml.speech import RecordedSpeech
from reactive_realizer.embodiment.sound_files import read_samples
from reactive_realizer.engine.tts import Phoneme, Utterance, Word, word_spans
from reactive_realizer.engines.speech.recorded.aligner import aligned
from reactive_realizer.engines.speech.recorded.phones import CMU, spelled
from reactive_realizer.engines.speech.recorded.speech_times import SpeechTimes, phoneme
from reactive_realizer.engines.speech.recorded.times_file import TIMES_SUFFIXES, read_times
from reactive_realizer.errors import CreationFault, Fault, RealizerError

_AUDIBLE = 0.03
"""Share of the greatest amplitude that is heard as speech."""


class MarkAfterEnd(CreationFault):
    """A sync point of a recorded speech after the end of the recording; times in s."""

    code = "mark-after-end"
    template = "the sync point '{mark}' is at {time} s, but {file} lasts {duration} s"
    compared = ("time", "duration")
    mark: str
    time: float
    file: str
    duration: float


@dataclass(frozen=True, slots=True)
class Recording:
    """A speech whose sound comes from elsewhere: from a file, or from a client as far as it has arrived.

    Attributes:
        utterance: its sound and times.
        note: what is to be told of it, such as why its times are estimated.
    """

    utterance: Utterance
    note: Fault | None = None


class Recordings:
    """Finds the files of recorded speeches, and the times of their words.

    Args:
        asset: finds a file by name.
        longest: limit on the duration of a recording, s.
    """

    def __init__(self, asset: Callable[[str], Path], longest: float) -> None:
        self._asset = asset
        self._longest = longest
        self._aligning = asyncio.Semaphore()

    def file(self, speech: RecordedSpeech) -> Path:
        """The sound file of a speech; a name without a suffix means a WAV file, as in SmartBody.

        Raises:
            RealizerError: "no-asset" or "forbidden-path".
        """
        name = PurePosixPath(speech.file_name)
        return self._asset(speech.file_name if name.suffix else f"{speech.file_name}.wav")

    async def read(self, speech: RecordedSpeech) -> Recording:
        """The recording of a speech; its slow work is done in other threads and processes.

        Raises:
            RealizerError: the file or its times cannot be read, or a mark lies after its end.
        """
        path = self.file(speech)
        samples, rate = await asyncio.to_thread(read_mono, path, self._longest)
        duration = len(samples) / rate
        spans = word_spans(speech.text)
        spoken = [speech.text[first:last] for first, last in spans]
        times, note = await self._times(speech, path, spoken, samples, rate)
        words = tuple(
            Word(text, start, first, last)
            for text, start, (first, last) in zip(spoken, times.words, spans, strict=True)
        )
        unmarked = Utterance(speech.text, duration, words, {}, times.phonemes, samples.tobytes(), rate)
        marks = {mark.id: unmarked.time_of_character(mark.char_index) for mark in speech.marks}
        for mark in speech.mark_times:
            if mark.time > duration:
                fault = MarkAfterEnd(mark=mark.id, time=mark.time, file=path.name, duration=duration)
                raise RealizerError(fault)
            marks[mark.id] = mark.time
        return Recording(replace(unmarked, marks=MappingProxyType(marks)), note)

    async def _times(
        self, speech: RecordedSpeech, path: Path, words: list[str], samples: NDArray[np.int16], rate: int
    ) -> tuple[SpeechTimes, Fault | None]:
        if not words:
            return SpeechTimes((), ()), None
        for suffix in TIMES_SUFFIXES:
            if (file := self._beside(speech, suffix)) is not None:
                return await asyncio.to_thread(read_times, file, words, len(samples) / rate), None
        try:
            async with self._aligning:  # a client may send hundreds of recordings at once
                return await aligned(path.name, words, samples, rate), None
        except RealizerError as problem:
            return await asyncio.to_thread(spread, words, samples, rate), problem.fault

    def _beside(self, speech: RecordedSpeech, suffix: str) -> Path | None:
        """The file with the times of a recording, which has its name and another suffix."""
        try:
            return self._asset(str(PurePosixPath(speech.file_name).with_suffix(suffix)))
        except RealizerError as problem:
            if isinstance(problem.fault, NoAsset):
                return None
            raise


def read_mono(path: Path, longest: float) -> tuple[NDArray[np.int16], int]:
    """The samples (N,) of a sound file, mixed to mono, and their rate; see `read_samples`."""
    samples, rate = read_samples(path, longest)
    return samples.mean(axis=1).astype("<i2"), rate


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
