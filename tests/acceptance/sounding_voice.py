"""A fake voice whose words are tones with silence between them, so that a test can find them in the sound."""

import asyncio
from collections.abc import AsyncIterator
from dataclasses import replace
from itertools import accumulate
from pathlib import Path

import numpy as np
import numpy.typing as npt
import soundfile

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.audio import AudioChange
from reactive_realizer.embodiment.sound_track import SoundTrack
from reactive_realizer.engine.tts import Phoneme, Utterance, Word, word_spans

_RATE = 8000
_TONE = 0.2
_GAP = 0.08
"""Silence after a word, s."""
PAUSE = 0.3
"""Silence after a comma, s."""
PITCH = 150.0
"""Frequency of the tones, Hz."""
_QUIET = 200.0
FASTER = 0.9
"""The expected duration of what is not made, as a factor."""


class SoundingVoice:
    """Each word is a tone of 0.2 s, and 0.08 s of silence or, after a comma, 0.3 s."""

    def synthesize(self, text: str, marks: tuple[tuple[str, int], ...], voice: str | None) -> Utterance:
        """Speaks a text; see `TTSBinding.synthesize`."""
        spans = word_spans(text)
        silences = [PAUSE if text[last : last + 1] == "," else _GAP for _, last in spans]
        begins = [*accumulate((_TONE + silence for silence in silences), initial=0.0)]
        words = tuple(Word(text[first:last], at, first, last) for (first, last), at in zip(spans, begins, strict=False))
        sounds = [each for word, silence in zip(words, silences, strict=True) for each in _sounds(word, silence)]
        audio = b"".join(_tone(silence) for silence in silences)
        spoken = Utterance(text, begins[-1], words, {}, tuple(sounds), audio, _RATE)
        times = {name: spoken.time_of_character(index) for name, index in marks}
        return Utterance(text, begins[-1], words, times, tuple(sounds), audio, _RATE)


class GrowingVoice(SoundingVoice):
    """Speaks as `SoundingVoice`, in parts, when a test lets it; what is not made is estimated to be faster.

    Args:
        cuts: where parts end, s from the start; the last one ends with the utterance.
    """

    def __init__(self, *cuts: float) -> None:
        self._cuts = cuts
        self._let = len(cuts) + 1
        self._more = asyncio.Event()

    def hold(self) -> None:
        """Make only the first part, until `let`."""
        self._let = 1

    def let(self, parts: int | None = None) -> None:
        """Make some parts in all, by default all of them."""
        self._let = len(self._cuts) + 1 if parts is None else parts
        self._more.set()
        self._more = asyncio.Event()

    async def stream(
        self, text: str, marks: tuple[tuple[str, int], ...], voice: str | None
    ) -> AsyncIterator[Utterance]:
        """Speaks a text; see `TTSBinding.synthesize`."""
        whole = self.synthesize(text, marks, voice)
        for index, made in enumerate((*self._cuts, whole.duration)):
            while index >= self._let:
                await self._more.wait()
            yield _made(whole, made)


def _made(whole: Utterance, made: float) -> Utterance:
    """An utterance of which a part is made, and the rest is expected to be faster."""

    def time(at: float) -> float:
        return at if at <= made else made + FASTER * (at - made)

    return replace(
        whole,
        duration=time(whole.duration),
        words=tuple(replace(each, start=time(each.start)) for each in whole.words),
        marks={name: time(at) for name, at in whole.marks.items()},
        phonemes=tuple(replace(each, start=time(each.start)) for each in whole.phonemes),
        audio=whole.audio[: 2 * round(made * _RATE)],
        made=made,
    )


def onsets(changes: list[AudioChange], end: float, path: Path) -> list[float]:
    """When tones begin in the sound of a session, s.

    Args:
        changes: of its sounds.
        end: of the session, s.
        path: of a file to write the sound to.
    """
    samples, rate = recorded(changes, end, path)
    step = rate // 500
    loud = np.abs(samples[: len(samples) // step * step]).reshape(-1, step).max(axis=1) > _QUIET / 32768
    begun = [k for k in range(len(loud)) if loud[k] and not loud[max(0, k - 10) : k].any()]
    return [k * step / rate for k in begun]


def recorded(changes: list[AudioChange], end: float, path: Path) -> tuple[npt.NDArray[np.float64], int]:
    """The sound of a session, -1 to 1, and its samples a second; as `onsets`."""
    track = SoundTrack()
    for change in changes:
        track.take(change)
    track.write(path, GlobalTime(end))
    samples, rate = soundfile.read(path)
    return samples, rate


def _sounds(word: Word, silence: float) -> list[Phoneme]:
    return [Phoneme("a", word.start, _TONE), Phoneme("", word.start + _TONE, silence)]


def _tone(silence: float) -> bytes:
    times = np.arange(round(_TONE * _RATE)) / _RATE
    tone = 8000 * np.sign(np.sin(2 * np.pi * PITCH * times + 1e-3)) * np.minimum(1.0, (_TONE - times) / 0.02)
    return tone.astype("<i2").tobytes() + bytes(2 * round(silence * _RATE))
