"""Mixes the sounds that are heard now, for the sound device of this machine."""

from collections import deque
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass, replace
from math import inf
from statistics import median
from threading import Lock
from typing import Final

import numpy as np

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.audio import AudioChange, AudioGain, AudioHeard, AudioStart, AudioStop
from reactive_realizer.embodiment.played_sound import RATE, PlayedSound, PlayedSounds, Samples

_CHANNELS: Final = 2
"""Mono sounds are heard on both sides."""
_MEASURED: Final = 100
"""Number of pieces by which the time of the device is measured: a second, if they take 10 ms."""
_FOLLOWED: Final = 1.0
"""Delay up to which a sound that comes late is played from its first sample, s: that up to which plans follow."""

Rendering = Callable[[Callable[[], Samples]], "Future[Samples]"]
"""Calls a function, usually in another thread."""


@dataclass(slots=True)
class _Begun:
    """A sound that plays: the sample of the device at which its first one is played."""

    begin: int
    samples: Samples


class SoundMixer:
    """Gives the samples of the device piece by piece, and tells what is heard of each sound.

    The clock of a device differs from that of the realizer. A sound is placed once, by the time of the device when it
    begins, and then played without a gap: the plan follows what is heard (thesis 8.17), as with pages.

    Samples may be asked for in another thread.

    Args:
        render: calls what takes long.
    """

    def __init__(self, render: Rendering) -> None:
        self._render = render
        self._lock = Lock()
        self._sounds = PlayedSounds()
        self._rendered: dict[str, Future[Samples]] = {}
        self._begun: dict[str, _Begun] = {}
        self._position = 0
        self._origins: deque[float] = deque(maxlen=_MEASURED)

    def take(self, change: AudioChange) -> None:
        """Note a sound, or a change of one; a change that comes late takes effect with the next sample."""
        with self._lock:
            if isinstance(change, AudioGain | AudioStop):
                change = replace(change, time=GlobalTime(max(change.time, self._mixed_until(change.id))))
            self._sounds.take(change)
            if isinstance(change, AudioStart) and (sound := self._sounds.by_id.get(change.clip.id)) is not None:
                self._rendered[change.clip.id] = self._render(sound.samples)

    def mixed(self, count: int, heard: float) -> Samples:
        """The next samples, (N, 2).

        Args:
            count: number of samples.
            heard: realizer time at which the first one is heard, s.
        """
        with self._lock:
            self._origins.append(heard - self._position / RATE)
            mix = np.zeros((count, _CHANNELS), np.float32)
            for id_, sound in list(self._sounds.by_id.items()):
                if id_ not in self._begun:
                    self._begin(id_, sound, count)
                if id_ in self._begun:
                    self._add(id_, sound, mix)
                elif sound.stop is not None and sound.heard_from == inf:
                    self._forget(id_)
            self._position += count
            return np.clip(mix, -1.0, 1.0)

    def heard(self, now: GlobalTime) -> list[AudioHeard]:
        """What is heard of each sound at a time, s."""
        with self._lock:
            positions = ((id_, now - self._time(each.begin), len(each.samples)) for id_, each in self._begun.items())
            return [
                AudioHeard(id_, position, now) for id_, position, length in positions if 0 <= position < length / RATE
            ]

    def _begin(self, id_: str, sound: PlayedSound, count: int) -> None:
        """Place a sound that begins within the next samples."""
        if sound.heard_from == inf or not self._rendered[id_].done():
            return
        wanted = round((sound.heard_from - self._time(0)) * RATE)
        if wanted < self._position + count:
            late = self._position - wanted
            begin = wanted if late > _FOLLOWED * RATE else max(wanted, self._position)
            self._begun[id_] = _Begun(begin, self._rendered[id_].result())

    def _add(self, id_: str, sound: PlayedSound, mix: Samples) -> None:
        """Add the next samples of a sound; one that has ended is forgotten."""
        begun = self._begun[id_]
        first = self._position - begun.begin
        part = begun.samples[max(first, 0) : max(first + len(mix), 0)]
        at = max(-first, 0)
        times = (sound.start or 0.0) + (max(first, 0) + np.arange(len(part))) / RATE
        mix[at : at + len(part)] += part * sound.gain_at(times)[:, None]
        faded = sound.stop is not None and (not len(times) or times[-1] >= sound.stop.time + sound.stop.fade)
        if faded or first + len(mix) >= len(begun.samples):
            self._forget(id_)

    def _forget(self, id_: str) -> None:
        del self._sounds.by_id[id_], self._rendered[id_]
        self._begun.pop(id_, None)

    def _mixed_until(self, id_: str) -> float:
        """The time in the plan of a sound up to which it was mixed, s."""
        sound, begun = self._sounds.by_id.get(id_), self._begun.get(id_)
        if sound is None or begun is None or sound.start is None:
            return -inf
        return sound.start + (self._position - begun.begin) / RATE

    def _time(self, sample: int) -> float:
        """When a sample of the device is heard, s."""
        return median(self._origins) + sample / RATE
