"""Makes speech faster or slower without a change of its pitch."""

import numpy as np
import numpy.typing as npt

from reactive_realizer.engines.speech.course import Course

_HOP = 0.012
"""Half the length of a frame, s: a frame has two periods of a low voice."""
_TOLERANCE = 0.01
"""How far a frame may be taken from its place, s."""
_SEARCH_RATE = 11_025
"""Samples a second at which frames are compared, Hz: enough for the sounds of a voice that have a pitch."""
_SILENCE = 1e4
"""Energy that is added to that of frames in comparisons, so that noise in silence does not count."""

Samples = npt.NDArray[np.float64]


class TimeScale:
    """Sound in overlapping frames, each taken near its place in the source, where it continues the previous one best.

    This is WSOLA (W. Verhelst and M. Roelands, "An overlap-add technique based on waveform similarity (WSOLA) for high
    quality time-scale modification of speech", 1993). A frame goes on where the one before it ended, as long as it
    stays near its place: so a sound that is not stretched stays as it is, to the sample. Samples are integers, so that
    their sums, by which frames are compared, are exact: every machine makes the same sound.

    Args:
        pcm: the source: mono, int16, little-endian.
        rate: its samples a second, Hz.

    Attributes:
        hop: samples from a frame to the next.
        next: when the next frame begins, samples from the start; each is two hops long.
    """

    def __init__(self, pcm: bytes, rate: int) -> None:
        self._rate = rate
        self.hop = round(_HOP * rate)
        self.next = -self.hop
        self._length = 2 * self.hop
        self._tolerance = round(_TOLERANCE * rate)
        self._step = max(1, rate // _SEARCH_RATE)
        phase = 2.0 * np.pi * np.arange(self._length) / self._length
        self._window = 0.5 - 0.5 * np.cos(phase)
        self._margin = 2 * self._length
        self._source = np.pad(np.frombuffer(pcm, "<i2").astype(np.float64), self._margin)
        self._place: int | None = None
        """Where the last frame was taken from, in the source."""

    def frames(self, course: Course, count: int) -> Samples:
        """The next frames, added up: the first half of the first one grows louder, the last half of the last one fades.

        Args:
            course: when which position of the source is heard, s.
            count: number of frames.
        """
        added = np.zeros((count + 1) * self.hop)
        for begin in range(0, count * self.hop, self.hop):
            center = (self.next + self.hop) / self._rate
            self._place = self._find(round(course.position(center) * self._rate) - self.hop + self._margin)
            if not course.waits(center):
                frame = self._source[self._place : self._place + self._length]
                added[begin : begin + self._length] += self._window * frame
            self.next += self.hop
        return added

    def _find(self, ideal: int) -> int:
        """Where to take a frame that should be from a place in the source."""
        ideal = min(max(ideal, self._tolerance), len(self._source) - self._length - self._tolerance)
        if self._place is None:
            return ideal
        follows = self._place + self.hop
        if abs(follows - ideal) <= self._tolerance // 2:
            return follows
        first, last = ideal - self._tolerance, ideal + self._tolerance + self._length
        around = self._source[first : last : self._step]
        wanted = self._source[follows : follows + self._length : self._step]
        energy = np.concatenate(([0.0], np.cumsum(around * around)))
        energies = energy[len(wanted) :] - energy[: -len(wanted)]
        alike = np.correlate(around, wanted, "valid") / np.sqrt(energies + _SILENCE)
        return first + self._step * int(np.argmax(alike))
