"""Loudness and brightness of sound as it arrives, frame by frame, and the time in it that is speech."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

FRAME: Final = 0.02
"""Duration of a frame, s."""
_QUIETEST: Final = 0.04
"""The lowest level of loud speech, as a share of full scale, so that noise alone is not taken for it."""
_PAUSE: Final = 0.2
"""Duration from which what is not audible is a pause, s; the closures of plosives are shorter."""
AUDIBLE: Final = 0.08
"""Share of the level of loud speech above which a frame is speech."""
_BRIGHT: Final = 3000.0
"""Frequency above which most of the energy of an s is, Hz."""

Floats = NDArray[np.float64]


class SoundLevels:
    """The levels of sound that arrives.

    Args:
        rate: of its samples, Hz.

    Attributes:
        loudness: of each frame, 1 for loud speech, (F,).
        brightness: share of the energy of each frame above 3 kHz, 0 to 1, (F,).
        centers: center of the spectrum of each frame, Hz, (F,).
    """

    def __init__(self, rate: int) -> None:
        self._size = round(rate * FRAME)
        self._frequencies = np.fft.rfftfreq(self._size, 1 / rate)
        self._window = np.hanning(self._size)
        self._rest = np.zeros(0)
        self._levels = np.zeros(0)
        self.loudness = np.zeros(0)
        self.brightness = np.zeros(0)
        self.centers = np.zeros(0)

    def add(self, samples: bytes) -> None:
        """Add samples: mono PCM, int16 little-endian."""
        heard = np.concatenate([self._rest, np.frombuffer(samples, "<i2") / 32768])
        count = len(heard) // self._size
        frames, self._rest = heard[: count * self._size].reshape(count, self._size), heard[count * self._size :]
        energy = np.abs(np.fft.rfft(frames * self._window)) ** 2
        total = energy.sum(axis=1) + 1e-9
        self._levels = np.append(self._levels, np.sqrt((frames**2).mean(axis=1)))
        self.brightness = np.append(self.brightness, energy[:, self._frequencies > _BRIGHT].sum(axis=1) / total)
        self.centers = np.append(self.centers, energy @ self._frequencies / total)
        loud = max(float(np.percentile(self._levels, 95)) if len(self._levels) else 0.0, _QUIETEST)
        # What was heard keeps its loudness, because it may have been shown.
        self.loudness = np.append(self.loudness, self._levels[len(self.loudness) :] / loud)

    @property
    def pauses(self) -> list[tuple[float, float]]:
        """The start and end of each pause, s."""
        quiet = np.concatenate([[False], self.loudness <= AUDIBLE, [False]])
        edges = np.flatnonzero(quiet[1:] != quiet[:-1]).reshape(-1, 2) * FRAME
        return [(first, last) for first, last in edges.tolist() if last - first >= _PAUSE - FRAME / 2]


class SpokenTime:
    """Time that is speech, without pauses; after what has arrived, speech is assumed to go on.

    Args:
        loudness: of each frame, (F,).
        heard: duration of what has arrived, s.
    """

    def __init__(self, loudness: Floats, heard: float) -> None:
        self._heard = heard
        self._audible = np.flatnonzero(loudness > AUDIBLE)
        self.total = len(self._audible) * FRAME

    def at(self, time: float) -> float:
        """How much speech there is before a time, s."""
        first = int(time / FRAME + 1e-6)
        before = int(np.searchsorted(self._audible, first))
        within = time - first * FRAME if before < len(self._audible) and self._audible[before] == first else 0.0
        return before * FRAME + within + max(0.0, time - self._heard)

    def time(self, spoken: float) -> float:
        """The time before which there is this much speech, and at which it goes on, s."""
        number = int(spoken / FRAME + 1e-6)
        if number >= len(self._audible):
            return self._heard + spoken - self.total
        return float(self._audible[number]) * FRAME + spoken - number * FRAME
