"""Makes speech faster or slower, and higher or lower, independently of each other."""

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

    For another pitch, a frame takes more or less of the source and is resampled, which moves the formants too.

    Args:
        rate: samples a second of the source and of the frames, Hz.
        begin: of the sound that it makes, s.

    Attributes:
        hop: samples from a frame to the next.
        next: when the next frame begins, samples from the start; each is two hops long.
    """

    def __init__(self, rate: int, begin: float = 0.0) -> None:
        self._rate = rate
        self.hop = round(_HOP * rate)
        self.next = round(begin * rate) if begin else -self.hop
        self._tolerance = round(_TOLERANCE * rate)
        self._step = max(1, rate // _SEARCH_RATE)
        phase = 2.0 * np.pi * np.arange(2 * self.hop) / (2 * self.hop)
        self._window = 0.5 - 0.5 * np.cos(phase)
        self._source: Samples = np.zeros(0)
        self._follows: int | None = None
        """Where the last frame goes on, in the source."""

    def add(self, pcm: bytes) -> None:
        """Add samples to the source: mono, int16, little-endian."""
        self._source = np.concatenate((self._source, np.frombuffer(pcm, "<i2").astype(np.float64)))

    def reach(self, pitch: float) -> float:
        """How much of the source a frame may need after the position of its middle, s."""
        return (pitch * self.hop + self._tolerance + 1) / self._rate

    def frames(self, course: Course, count: int, pitch: float = 1.0) -> Samples:
        """The next frames, added up: the first half of the first one grows louder, the last half of the last one fades.

        Args:
            course: when which position of the source is heard, s.
            count: number of frames.
            pitch: a factor.
        """
        hop = round(pitch * self.hop)
        added = np.zeros((count + 1) * self.hop)
        for begin in range(0, count * self.hop, self.hop):
            center = (self.next + self.hop) / self._rate
            place = self._find(round(course.position(center) * self._rate) - hop, 2 * hop)
            if not course.waits(center):
                added[begin : begin + 2 * self.hop] += self._window * self._frame(place, pitch)
            self._follows = place + hop
            self.next += self.hop
        return added

    def _frame(self, place: int, pitch: float) -> Samples:
        """A frame that begins at a place in the source."""
        if pitch == 1.0:
            return self._taken(place, 2 * self.hop)
        at = pitch * np.arange(2 * self.hop)
        source = self._taken(place, int(at[-1]) + 2)
        resampled: Samples = np.rint(np.interp(at, np.arange(len(source)), source))
        return resampled

    def _find(self, ideal: int, length: int) -> int:
        """Where to take a frame of a length that should be from a place in the source."""
        if self._follows is None or abs(self._follows - ideal) <= self._tolerance // 2:
            return ideal if self._follows is None else self._follows
        first = ideal - self._tolerance
        around = self._taken(first, length + 2 * self._tolerance)[:: self._step]
        wanted = self._taken(self._follows, length)[:: self._step]
        energy = np.concatenate(([0.0], np.cumsum(around * around)))
        energies = energy[len(wanted) :] - energy[: -len(wanted)]
        alike = np.correlate(around, wanted, "valid") / np.sqrt(energies + _SILENCE)
        return first + self._step * int(np.argmax(alike))

    def _taken(self, first: int, count: int) -> Samples:
        """Samples of the source from a place on; silence outside of it."""
        part = self._source[max(first, 0) : max(first + count, 0)]
        before = min(max(-first, 0), count)
        return part if len(part) == count else np.pad(part, (before, count - before - len(part)))
