"""Reads sound files: WAV, Ogg, MP3, FLAC and the other formats of libsndfile."""

import re
from pathlib import Path
from threading import Lock
from typing import Final
from weakref import WeakValueDictionary

import numpy as np
import soundfile
import soxr
from numpy.typing import NDArray

from reactive_realizer.embodiment.audio import Sound
from reactive_realizer.errors import CreationFault, RealizerError

HIGHEST_RATE: Final = 48_000
"""The sample rate above which sounds are resampled, Hz."""

_RATES: Final = range(4_000, 192_001)
_MOST_CHANNELS: Final = 2

_REPAIRED: Final = re.compile(r"^data : (\d+) \(should be (\d+)\)$", re.MULTILINE)
"""What libsndfile notes of a WAV file whose header does not state the size of its data, bytes."""
_UNKNOWN_SIZE: Final = 0x7FFF0000
"""Programs that write a WAV file into a pipe state this size or more, because they do not know it yet."""


class NotASound(CreationFault):
    """A file that cannot be read as a sound."""

    code = "not-a-sound"
    template = "{file} cannot be read as a sound: {reason}"
    file: str
    reason: str


class SoundTooLong(CreationFault):
    """A sound file that exceeds the limit on its duration, s."""

    code = "sound-too-long"
    template = "{file} lasts {duration} s; at most {limit} s are allowed"
    compared = ("duration", "limit")
    file: str
    duration: float
    limit: float


class SoundTruncated(CreationFault):
    """A sound file that ends before its end; durations in s."""

    code = "sound-truncated"
    template = "{file} is truncated: it contains {there} s of {whole} s"
    compared = ("there", "whole")
    file: str
    there: float
    whole: float


class SoundFiles:
    """Reads sound files. A file that several behaviors use at the same time is in memory once.

    It may be used in several threads.

    Args:
        longest: limit on the duration of a file, s.
    """

    def __init__(self, longest: float) -> None:
        self._longest = longest
        self._lock = Lock()
        self._sounds: WeakValueDictionary[tuple[Path, int], Sound] = WeakValueDictionary()

    def read(self, path: Path) -> Sound:
        """The sound in a file, mono or stereo, with at most `HIGHEST_RATE`.

        Raises:
            RealizerError: "not-a-sound", "sound-too-long" or "sound-truncated".
        """
        with self._lock:
            key = path, path.stat().st_mtime_ns
            sound = self._sounds.get(key)
            if sound is None:
                samples, rate = read_samples(path, self._longest)
                pcm = samples.astype("<i2").tobytes()
                sound = self._sounds[key] = Sound.from_pcm(pcm, rate, samples.shape[1])
            return sound


def read_samples(path: Path, longest: float) -> tuple[NDArray[np.int16], int]:
    """The samples (N, C) of a sound file, C being 1 or 2, and their rate, at most `HIGHEST_RATE`.

    Args:
        path: of the file.
        longest: limit on its duration, s.

    Raises:
        RealizerError: "not-a-sound", "sound-too-long" or "sound-truncated".
    """
    try:
        with soundfile.SoundFile(path) as file:
            _check_format(path, file)
            duration = file.frames / file.samplerate
            if duration > longest:
                raise RealizerError(SoundTooLong(file=path.name, duration=duration, limit=longest))
            samples, rate = file.read(file.frames, dtype="int16", always_2d=True), file.samplerate
            _check_whole(path, len(samples) / rate, _stated_duration(file))
    except soundfile.LibsndfileError as problem:
        raise RealizerError(NotASound(file=path.name, reason=problem.error_string)) from problem
    except TypeError as problem:  # the library takes a name that ends in .raw for samples without a header
        raise RealizerError(NotASound(file=path.name, reason="it has no header")) from problem
    return (samples, rate) if rate <= HIGHEST_RATE else (soxr.resample(samples, rate, HIGHEST_RATE), HIGHEST_RATE)


def _check_format(path: Path, file: soundfile.SoundFile) -> None:
    reason = None
    if file.channels > _MOST_CHANNELS:
        reason = f"it has {file.channels} channels; only mono and stereo are supported"
    elif file.samplerate not in _RATES:
        reason = f"its sample rate of {file.samplerate} Hz is not from {_RATES[0]} to {_RATES[-1]} Hz"
    elif not file.frames:
        reason = "it has no samples"
    if reason is not None:
        raise RealizerError(NotASound(file=path.name, reason=reason))


def _check_whole(path: Path, there: float, whole: float) -> None:
    if there < whole:
        raise RealizerError(SoundTruncated(file=path.name, there=there, whole=whole))


def _stated_duration(file: soundfile.SoundFile) -> float:
    """The duration that the header of a file states, s."""
    repaired = _REPAIRED.search(file.extra_info)
    whole: float = file.frames / file.samplerate
    if repaired is None or int(repaired[1]) >= _UNKNOWN_SIZE:
        return whole
    return whole * int(repaired[1]) / max(int(repaired[2]), 1)
