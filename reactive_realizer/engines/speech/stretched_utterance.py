"""An utterance that is stretched while it is heard."""

from collections.abc import Iterable
from dataclasses import replace
from types import MappingProxyType
from typing import Final

import numpy as np

from reactive_realizer.clock.units import RESOLUTION
from reactive_realizer.embodiment.audio import Sound
from reactive_realizer.engine.sound_unit import SoundPart
from reactive_realizer.engine.tts import Utterance
from reactive_realizer.engines.speech.course import REACH, Course, Pace
from reactive_realizer.engines.speech.time_scale import TimeScale

STRETCH: Final = (0.8, 1.3)
"""How much shorter and longer speech may become and still sound natural, as factors."""
_PAUSE: Final = 0.1
"""The shortest silence that is a pause between clauses, s."""
_LONGEST_PART: Final = 0.5
"""The most sound that is made at once, s."""


class StretchedUtterance:
    """The sound of an utterance, made word by word shortly before it is heard, as fast as its sync points ask for.

    What is made does not change. Parts overlap: each fades out while the next one fades in.

    Attributes:
        utterance: as the voice speaks it.
        pace: how it can be stretched.
        course: when its positions are heard, s from its start: final up to ``made``, and after that as planned now.
        made: how much of its sound is made, s from its start.
        sounds: its parts.
    """

    def __init__(self, utterance: Utterance) -> None:
        self.utterance = utterance
        self.pace = pace_of(utterance)
        self.course = Course([0.0, utterance.duration], [0.0, utterance.duration])
        self.made = 0.0
        self.sounds: list[SoundPart] = []
        self._scale = TimeScale(utterance.audio, utterance.sample_rate)
        self._timed = utterance

    @property
    def complete(self) -> bool:
        """Whether all of its sound is made."""
        return self.course.position(self.made) >= self.utterance.duration

    @property
    def timed(self) -> Utterance:
        """The utterance with the times that it has by its course."""
        return self._timed

    def follow(self, goals: Iterable[tuple[float, float]]) -> None:
        """Have it reach some positions in time, from what is made on.

        Args:
            goals: times, s from its start, and positions, in order.
        """
        begun = self.course.until(self.made) if self.made else Course([0.0], [0.0])
        course = begun.then(self.pace.course(begun.times[-1], begun.positions[-1], goals))
        if any(abs(course.time(each) - self.course.time(each)) > RESOLUTION for each in course.positions):
            self.course = course
            self._retime()

    def earliest(self, position: float) -> float:
        """The earliest time at which a position can be heard, s from its start."""
        here = self.course.position(self.made)
        return self.course.time(position) if position <= here else self.made + self.pace.least * (position - here)

    def make(self, until: float) -> None:
        """Make its sound up to the first word after a time (s), in parts."""
        rate, hop = self.utterance.sample_rate, self._scale.hop
        while self.made <= until and not self.complete:
            end = min(self._border(max(until, self.made) + 2 * hop / rate), self.made + _LONGEST_PART)
            begin = self._scale.next
            samples = self._scale.frames(self.course, int(end * rate - begin) // hop)
            if begin < 0:
                samples, begin = samples[-begin:], 0
            pcm = np.clip(np.rint(samples), -32768, 32767).astype("<i2").tobytes()
            self.sounds.append(SoundPart(begin / rate, Sound.from_pcm(pcm, rate)))
            self.made = self._scale.next / rate

    def _border(self, time: float) -> float:
        """A time after another one at which a frame cannot contain a part of the next word, or the end of all, s."""
        borders = (word.start - REACH for word in self._timed.words if word.start - REACH > time)
        return next(borders, max(self._timed.duration, time))

    def _retime(self) -> None:
        spoken, time = self.utterance, self.course.time
        self._timed = replace(
            spoken,
            duration=time(spoken.duration),
            words=tuple(replace(word, start=time(word.start)) for word in spoken.words),
            marks=MappingProxyType({name: time(at) for name, at in spoken.marks.items()}),
            phonemes=tuple(
                replace(each, start=time(each.start), duration=time(each.start + each.duration) - time(each.start))
                for each in spoken.phonemes
            ),
        )


def pace_of(utterance: Utterance) -> Pace:
    """How the sound of an utterance can be stretched."""
    silences = (each for each in utterance.phonemes if not each.symbol and each.duration >= _PAUSE)
    least, most = utterance.stretch or STRETCH
    return Pace(least, most, [each.start + each.duration / 2 for each in silences])
