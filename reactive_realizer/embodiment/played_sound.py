"""Sounds as pages play them (web/src/utterance.ts): their samples, and the course of their gain."""

import io
from dataclasses import dataclass, field
from itertools import pairwise
from math import inf
from typing import Final

import numpy as np
import soundfile
import soxr
from numpy.typing import NDArray

from reactive_realizer.clock.units import Time
from reactive_realizer.embodiment.audio import AudioChange, AudioGain, AudioMove, AudioStart, AudioStop

RATE: Final = 48_000
"""The sample rate at which sounds are mixed, Hz."""

_GAIN_SETTLES: Final = 0.02
"""Time constant of a change of gain, s."""
_FADE_FALLS: Final = 0.2
"""Time constant of a fade, as a fraction of its duration."""

Samples = NDArray[np.float32]
"""Samples (N, C), from -1 to 1."""


@dataclass(slots=True)
class PlayedSound:
    """A sound with its last announced start, its changes of gain, and its stop."""

    announced: AudioStart
    start: Time
    gains: list[AudioGain] = field(default_factory=list)
    stop: AudioStop | None = None

    @property
    def heard_from(self) -> float:
        """When it begins, s; infinity if nothing of it is heard."""
        revoked = self.stop is not None and self.start is not None and self.stop.time <= self.start
        return inf if self.start is None or revoked else self.start

    @property
    def faded_at(self) -> float:
        """When it is silent because it was stopped, s; minus infinity if it was not, or never began."""
        return -inf if self.stop is None or self.heard_from == inf else self.stop.time + self.stop.fade

    @property
    def channels(self) -> int:
        """1 for mono, 2 for stereo."""
        return int(soundfile.info(io.BytesIO(self.announced.clip.sound.wav)).channels)

    def samples(self) -> Samples:
        """Its samples at `RATE`, as recorded."""
        samples: Samples
        samples, rate = soundfile.read(io.BytesIO(self.announced.clip.sound.wav), dtype="float32", always_2d=True)
        return samples if rate == RATE else soxr.resample(samples, rate, RATE)

    def gain_at(self, times: NDArray[np.float64]) -> NDArray[np.float32]:
        """The gain at some times, s: every target is approached exponentially from where the gain is then."""
        courses = [(each.time, each.gain, _GAIN_SETTLES) for each in self.gains]
        first = [gain for time, gain, _ in courses if time <= self.heard_from]
        gain = first[-1] if first else self.announced.gain
        courses = courses[len(first) :]
        if self.stop is not None:
            courses.append((self.stop.time, 0.0, _FADE_FALLS * self.stop.fade))
        gains = np.full(len(times), gain)
        for (begin, target, constant), (until, _, _) in pairwise([*courses, (inf, 0.0, 1.0)]):
            after = times >= begin
            gains[after] = target + (gain - target) * np.exp((begin - times[after]) / constant)
            gain = target + (gain - target) * np.exp((begin - until) / constant)
        if self.stop is not None:
            gains[times >= self.faded_at] = 0.0
        return gains.astype(np.float32)


class PlayedSounds:
    """The sounds that were announced, by the ids of their clips; captions without sound are left out."""

    def __init__(self) -> None:
        self.by_id: dict[str, PlayedSound] = {}

    def take(self, change: AudioChange) -> None:
        """Note a sound, or a change of one."""
        match change:
            case AudioStart(clip=clip, start=start) if clip.sound.wav:
                self.by_id[clip.id] = PlayedSound(change, start)
            case AudioMove(id_, start) if id_ in self.by_id:
                self.by_id[id_].start = start
            case AudioGain(id_) if id_ in self.by_id:
                self.by_id[id_].gains.append(change)
            case AudioStop(id_) if id_ in self.by_id:
                self.by_id[id_].stop = change
            case _:
                pass
