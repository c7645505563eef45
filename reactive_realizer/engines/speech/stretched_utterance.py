"""An utterance that is stretched while it is heard."""

from collections.abc import Iterable
from dataclasses import replace
from math import ceil, inf
from types import MappingProxyType
from typing import Final

import numpy as np

from reactive_realizer.clock.units import RESOLUTION
from reactive_realizer.embodiment.audio import Sound
from reactive_realizer.engine.sound_unit import SoundPart
from reactive_realizer.engine.tts import STRETCH, Utterance
from reactive_realizer.engines.speech.course import REACH, Course, StretchLimits
from reactive_realizer.engines.speech.time_scale import TimeScale

_PAUSE: Final = 0.1
"""The shortest silence that is a pause between clauses, s."""
_LONGEST_PART: Final = 0.5
"""The most sound that is made at once, s."""
_EARLY: Final = 0.02
"""How long before its sound is missing a speech waits, s: two ticks, so that no word is reported before."""


class StretchedUtterance:
    """The sound of an utterance, made word by word shortly before it is heard.

    Its pace follows from its sync points, or else from a rate. What is made does not change. Parts overlap: each fades
    out while the next one fades in. The utterance may grow; its sound waits for what is missing.

    Args:
        utterance: as the voice speaks it, as far as it is made.
        course: what is heard up to ``begin``; None if nothing is.
        begin: from when on its sound is made, s from its start.
        sounds: those that are heard before.

    Attributes:
        utterance: as the voice speaks it.
        pitch: of what is made next, a factor.
        limits: how it can be stretched.
        course: when its positions are heard, s from its start: final up to ``made``, and after that as planned now.
        made: how much of its sound is made, s from its start.
        sounds: its parts.
    """

    def __init__(
        self,
        utterance: Utterance,
        course: Course | None = None,
        begin: float = 0.0,
        sounds: list[SoundPart] | None = None,
    ) -> None:
        self.utterance = utterance
        self.pitch = 1.0
        self.limits = stretch_limits(utterance)
        self.course = course or Course([0.0, utterance.duration], [0.0, utterance.duration])
        self.made = self._final = begin
        self._timed = utterance
        self.sounds = [] if sounds is None else sounds
        self._scale = TimeScale(utterance.sample_rate, begin)
        self._scale.add(utterance.audio)
        self._retime()

    @property
    def complete(self) -> bool:
        """Whether all of its sound is made."""
        return self.utterance.complete and self.course.position(self.made) >= self.utterance.duration

    @property
    def timed(self) -> Utterance:
        """The utterance with the times that it has by its course."""
        return self._timed

    @property
    def next_part(self) -> float | None:
        """When sound is missing, s from its start; None if the voice has made all of it."""
        return None if self.utterance.complete else max(self._available(), self._final) - _EARLY

    @property
    def makes_next(self) -> float | None:
        """When the sound that is made next begins, s from its start; None if there is none, or not yet."""
        frame = self._scale.hop / self.utterance.sample_rate
        return None if self.complete or self._available() < self.made + frame else self.made

    def follow(self, goals: Iterable[tuple[float, float]], rate: float = 1.0) -> None:
        """Have it reach some positions in time, from what is made on.

        Args:
            goals: times, s from its start, and positions, in order.
            rate: after the last goal, a factor of the pace of the voice.
        """
        begun = self._begun()
        course = begun.then(self.limits.course(begun.times[-1], begun.positions[-1], goals))
        rest = self.utterance.duration - course.positions[-1]
        if rate != 1.0 and rest > 0.0:
            time, position = course.times[-1], course.positions[-1]
            course = course.then(Course([time, time + rest / rate], [position, position + rest]))
        known = (*course.positions, *self.course.positions)
        if any(abs(course.time(each) - self.course.time(each)) > RESOLUTION for each in known):
            self.course = course
            self._retime()

    def extend(self, utterance: Utterance) -> None:
        """Take the utterance when more of it is made."""
        self._scale.add(utterance.audio[len(self.utterance.audio) :])
        self.utterance, self.limits = utterance, stretch_limits(utterance)
        self._retime()

    def pause(self, until: float) -> None:
        """Have what is not made not begin before a time, s from its start."""
        if not self.utterance.complete:
            self._final = max(self._final, self._available())
        begun = self._begun()
        if until <= begun.times[-1]:
            return
        later = until - begun.times[-1]
        ahead = [k for k, time in enumerate(self.course.times) if time > begun.times[-1]]
        held = begun.held(until)
        self.course = Course(
            [*held.times, *(self.course.times[k] + later for k in ahead)],
            [*held.positions, *(self.course.positions[k] for k in ahead)],
        )
        self._final = until
        self._retime()

    def earliest(self, position: float) -> float:
        """The earliest time at which a position can be heard, s from its start."""
        planned = self.course.time(position)
        hurried = self._final + self.limits.least * (position - self.course.position(self._final))
        return planned if planned <= self._final else min(planned, hurried)

    def make(self, until: float) -> None:
        """Make its sound up to the first word after a time (s), in parts, as far as the voice has made it."""
        rate, hop = self.utterance.sample_rate, self._scale.hop
        while self.made <= until and not self.complete:
            end = min(border_after(self._timed, max(until, self.made) + 2 * hop / rate), self.made + _LONGEST_PART)
            count = self._count(min(end, self._available()))
            if count < 1:
                return
            begin = self._scale.next
            samples = self._scale.frames(self.course, count, self.pitch)
            if begin < 0:
                samples, begin = samples[-begin:], 0
            pcm = np.clip(np.rint(samples), -32768, 32767).astype("<i2").tobytes()
            self.sounds.append(SoundPart(begin / rate, Sound.from_pcm(pcm, rate)))
            self.made = self._scale.next / rate
            self._final = max(self._final, self.made)

    def _begun(self) -> Course:
        """The course up to where it is final."""
        return self.course.until(self._final) if self._final else Course([0.0], [0.0])

    def _available(self) -> float:
        """Up to when its sound can be made, s from its start: as far as the voice has made it."""
        reach = self._scale.reach(self.pitch)
        return inf if self.utterance.complete else self.course.time(self.utterance.made - reach)

    def _count(self, end: float) -> int:
        """The number of frames whose middles are before a time, s from its start."""
        return (ceil(end * self.utterance.sample_rate) - 1 - self._scale.next) // self._scale.hop

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


def border_after(timed: Utterance, time: float) -> float:
    """A time after another one at which a frame cannot contain a part of the next word, or the end of all, s."""
    borders = (word.start - REACH for word in timed.words if word.start - REACH > time)
    return next(borders, max(timed.duration, time))


def stretch_limits(utterance: Utterance) -> StretchLimits:
    """How the sound of an utterance can be stretched."""
    silences = (each for each in utterance.phonemes if not each.symbol and each.duration >= _PAUSE)
    least, most = utterance.stretch or STRETCH
    return StretchLimits(least, most, [each.start + each.duration / 2 for each in silences])
