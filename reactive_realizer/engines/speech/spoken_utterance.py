"""An utterance as it is spoken while it is being made."""

from dataclasses import replace
from types import MappingProxyType

from reactive_realizer.clock.units import RESOLUTION
from reactive_realizer.embodiment.audio import Sound
from reactive_realizer.engine.sound_unit import SoundPart
from reactive_realizer.engine.tts import Phoneme, Utterance
from reactive_realizer.engines.speech.course import Course


class SpokenUtterance:
    """An utterance that grows, with the pauses in which its next part was waited for.

    Attributes:
        utterance: as the voice speaks it.
        timed: the utterance, with the times that it has with these pauses.
        sounds: what is made of it, a part for each time that it has grown; without samples if the voice is silent.
    """

    def __init__(self, utterance: Utterance) -> None:
        self.timed = self.utterance = utterance
        self.sounds = [SoundPart(0.0, _sound(utterance, b"", 0.0))]
        self._pauses: dict[float, float] = {}

    @property
    def course(self) -> Course:
        """When its positions are heard, s from the start."""
        course, later = Course([0.0], [0.0]), 0.0
        for at, seconds in sorted(self._pauses.items()):
            course = course.then(Course([0.0, at + later, at + later + seconds], [0.0, at, at]))
            later += seconds
        duration = self.utterance.duration
        return course.then(Course([0.0, duration + later], [0.0, duration]))

    @property
    def next_part(self) -> float | None:
        """When the part begins that is made next, s from the start; None if the utterance is complete."""
        return None if self.utterance.complete else self._shifted(self.utterance.made)

    def extend(self, utterance: Utterance) -> None:
        """Take the utterance when more of it is made."""
        before, self.utterance = self.utterance, utterance
        if utterance.made > before.made:
            sound = _sound(utterance, before.audio, before.made)
            self.sounds.append(SoundPart(self._shifted(before.made), sound))
        self._retime()

    def pause(self, until: float) -> None:
        """Have the next part not begin before a time, s from the start."""
        made = self.utterance.made
        if (later := until - self._shifted(made)) > 0.0:
            self._pauses[made] = self._pauses.get(made, 0.0) + later
            self._retime()

    def _shifted(self, time: float) -> float:
        """A time of the utterance with its pauses, s."""
        return time + sum(seconds for at, seconds in self._pauses.items() if at <= time + RESOLUTION)

    def _retime(self) -> None:
        made, shifted = self.utterance, self._shifted
        phonemes = [replace(each, start=shifted(each.start)) for each in made.phonemes]
        silences = [Phoneme("", shifted(at) - seconds, seconds) for at, seconds in self._pauses.items() if phonemes]
        self.timed = replace(
            made,
            duration=shifted(made.duration),
            words=tuple(replace(word, start=shifted(word.start)) for word in made.words),
            marks=MappingProxyType({name: shifted(time) for name, time in made.marks.items()}),
            phonemes=tuple(sorted((*phonemes, *silences), key=lambda each: each.start)),
        )


def _sound(utterance: Utterance, before: bytes, made: float) -> Sound:
    """The sound of what is made after some audio, which lasts until a time (s)."""
    if utterance.audio:
        return Sound.from_pcm(utterance.audio[len(before) :], utterance.sample_rate)
    return Sound(b"", min(utterance.made, utterance.duration) - made)
