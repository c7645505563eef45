"""Audio of planned speeches. Sounds are announced when they are planned, so that they are there when they start."""

import io
import wave
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from reactive_realizer.clock.units import GlobalTime, Time
from reactive_realizer.embodiment.audio import AudioChange, AudioClip, AudioGain, AudioMove, AudioStart, AudioStop
from reactive_realizer.engine.tts import Utterance
from reactive_realizer.engines.speech.speech_unit import SpeechUnit
from reactive_realizer.planunit.plan_unit import UnitState

_WORTH_MOVING = 1e-3
"""The smallest change of a start time that is announced, s."""

_FADE = 0.03
"""Fade of a sound that is cut, s: long enough to avoid a click, short enough to be silent at once."""


@dataclass(slots=True)
class _Announced:
    """The last announcement of a sound, and the tick of the last one of its gain, which is sent once a tick at most."""

    clip: str
    start: Time
    gain: float
    gain_tick: Time = None


class SpeechAudio:
    """Keeps track of the sounds of a character's planned speeches and announces what changes."""

    def __init__(self, character: str) -> None:
        self._character = character
        self._announced: dict[SpeechUnit, _Announced] = {}
        self._count = 0

    def unit(self, clip: str) -> SpeechUnit | None:
        """The live speech that a clip was announced for."""
        return next((unit for unit, announced in self._announced.items() if announced.clip == clip and unit.live), None)

    def changes(self, units: Iterable[SpeechUnit], now: GlobalTime) -> tuple[AudioChange, ...]:
        """The changes since the last call."""
        out: list[AudioChange] = []
        for unit, announced in list(self._announced.items()):
            if unit.live:
                out += _differences(unit, announced, now)
            else:
                del self._announced[unit]
                out += _silence(unit, announced, now)
        out += [self._announce(unit) for unit in units if self._is_new(unit)]
        return tuple(out)

    def _is_new(self, unit: SpeechUnit) -> bool:
        return unit.live and bool(unit.utterance.audio) and unit not in self._announced

    def _announce(self, unit: SpeechUnit) -> AudioStart:
        self._count += 1
        start = unit.origin
        clip = AudioClip(f"{self._character}-{self._count}", wav_bytes(unit.utterance), unit.utterance.duration)
        self._announced[unit] = _Announced(clip.id, start, unit.gain)
        return AudioStart(self._character, clip, start, unit.gain)


def wav_bytes(utterance: Utterance) -> bytes:
    """The audio of an utterance as a WAV file: mono, 16 bit, at its sample rate."""
    file = io.BytesIO()
    with wave.open(file, "wb") as sound:
        sound.setnchannels(1)
        sound.setsampwidth(2)
        sound.setframerate(utterance.sample_rate)
        sound.writeframes(utterance.audio)
    return file.getvalue()


def _differences(unit: SpeechUnit, announced: _Announced, now: GlobalTime) -> Iterator[AudioChange]:
    """The changes of a live speech since its last announcement, which they update."""
    time = unit.origin
    if time is not None and (announced.start is None or abs(time - announced.start) > _WORTH_MOVING):
        announced.start = time
        yield AudioMove(announced.clip, time)
    if unit.gain != announced.gain and announced.gain_tick != now:
        announced.gain, announced.gain_tick = unit.gain, now
        yield AudioGain(announced.clip, unit.gain, now)


def _silence(unit: SpeechUnit, announced: _Announced, now: GlobalTime) -> list[AudioChange]:
    """The stop of a speech that was cut or never started; the sound of one that ended by itself has ended too."""
    if unit.state is UnitState.DONE and unit.cut is None:
        return []
    time = next((time for time in (unit.cut, announced.start) if time is not None), now)
    return [AudioStop(announced.clip, time, _FADE)]
