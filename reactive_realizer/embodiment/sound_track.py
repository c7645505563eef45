"""Writes the sounds of a session into one file."""

from collections import deque
from collections.abc import Iterator
from math import inf
from pathlib import Path
from typing import Final

import numpy as np
import soundfile

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.audio import AudioChange
from reactive_realizer.embodiment.played_sound import RATE, PlayedSound, PlayedSounds, Samples

_PIECE: Final = 10 * RATE
"""Number of samples that are mixed at a time."""


class SoundTrack:
    """Collects the changes of sounds (`Realizer.hear`), and mixes them when the session is over.

    Each sound begins at its last announced start, to the sample.
    """

    def __init__(self) -> None:
        self._sounds = PlayedSounds()

    def take(self, change: AudioChange) -> None:
        """Note a sound, or a change of one."""
        self._sounds.take(change)

    def write(self, path: Path, end: GlobalTime) -> None:
        """Write a WAV file of 16 bits: mono, or stereo if a sound is.

        Args:
            path: of the file.
            end: of the session, s. The file lasts until then, or until the last fade.

        Raises:
            OSError: the file cannot be written.
        """
        channels, pieces = self.mixed(end)
        try:
            with soundfile.SoundFile(path, "w", RATE, channels, "PCM_16", format="WAV") as file:
                for piece in pieces:
                    file.write(piece)
        except soundfile.LibsndfileError as problem:
            raise OSError(str(problem)) from problem

    def mixed(self, end: GlobalTime) -> tuple[int, Iterator[Samples]]:
        """The number of channels, and the mix in pieces: (length, channels) float32, 48 kHz, which may exceed -1..1.

        Args:
            end: as for `write`.
        """
        sounds = (each for each in self._sounds.by_id.values() if each.heard_from < inf)
        heard = sorted(sounds, key=lambda each: each.heard_from)
        length = _index(max((end, *(each.faded_at for each in heard))))
        channels = max((each.channels for each in heard), default=1)
        return channels, _mixed(heard, length, channels)


def _mixed(heard: list[PlayedSound], length: int, channels: int) -> Iterator[Samples]:
    """The mix of sounds in the order of their beginnings, in pieces."""
    waiting = deque(heard)
    sounding: list[tuple[int, Samples]] = []
    for first in range(0, length, _PIECE):
        last = min(first + _PIECE, length)
        while waiting and _index(waiting[0].heard_from) < last:
            sound = waiting.popleft()
            sounding.append((_index(sound.heard_from), _rendered(sound)))
        mix = np.zeros((last - first, channels), np.float32)
        for begin, samples in sounding:
            part = samples[max(first - begin, 0) : max(last - begin, 0)]
            at = max(begin - first, 0)
            mix[at : at + len(part)] += part
        sounding = [(begin, samples) for begin, samples in sounding if begin + len(samples) > last]
        yield mix


def _index(time: float) -> int:
    """The sample at a time, s."""
    return round(time * RATE)


def _rendered(sound: PlayedSound) -> Samples:
    """The samples of a sound from its start on, with its gain and its fade."""
    samples = sound.samples()
    times = sound.heard_from + np.arange(len(samples)) / RATE
    return samples * sound.gain_at(times)[:, None]
