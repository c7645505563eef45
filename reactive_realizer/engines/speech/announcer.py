"""Tells what is to be heard, before it is: sounds are scheduled, not played when it is too late."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from reactive_realizer.clock.units import GlobalTime, Time
from reactive_realizer.embodiment.audio import AudioChange, AudioClip, AudioGain, AudioMove, AudioStart, AudioStop
from reactive_realizer.engines.speech.audio import wav_bytes
from reactive_realizer.engines.speech.speech_unit import SpeechUnit
from reactive_realizer.planunit.plan_unit import UnitState

_WORTH_MOVING = 1e-3
_FADE = 0.03
"""s: long enough not to click, short enough to be silence at once."""


@dataclass(slots=True)
class _Told:
    """What was said last of a sound; and in which tick its gain, for that is said once a tick."""

    clip: str
    start: GlobalTime
    gain: float
    gain_told: Time = None


class Announcer:
    """Follows the planned speeches of a character and says what changed about their sounds."""

    def __init__(self, character: str) -> None:
        self._character = character
        self._announced: dict[SpeechUnit, _Told] = {}
        self._count = 0

    def changes(self, units: Iterable[SpeechUnit], now: GlobalTime) -> tuple[AudioChange, ...]:
        """What changed since the last call."""
        out: list[AudioChange] = []
        for unit, told in list(self._announced.items()):
            if unit.live:
                out += _differences(unit, told, now)
            else:
                del self._announced[unit]
                out += _silence(unit, told)
        out += [self._announce(unit, time) for unit in units if (time := self._new(unit)) is not None]
        return tuple(out)

    def _new(self, unit: SpeechUnit) -> GlobalTime | None:
        new = unit.live and unit.utterance.audio and unit not in self._announced
        return unit.time("start") if new else None

    def _announce(self, unit: SpeechUnit, start: GlobalTime) -> AudioStart:
        self._count += 1
        clip = AudioClip(f"{self._character}-{self._count}", wav_bytes(unit.utterance), unit.utterance.duration)
        self._announced[unit] = _Told(clip.id, start, unit.gain)
        return AudioStart(self._character, clip, start, unit.gain)


def _differences(unit: SpeechUnit, told: _Told, now: GlobalTime) -> Iterator[AudioChange]:
    """What is another than it was told, and is so from now on."""
    time = unit.time("start")
    if time is not None and abs(time - told.start) > _WORTH_MOVING:
        told.start = time
        yield AudioMove(told.clip, time)
    if unit.gain != told.gain and told.gain_told != now:
        told.gain, told.gain_told = unit.gain, now
        yield AudioGain(told.clip, unit.gain, now)


def _silence(unit: SpeechUnit, told: _Told) -> list[AudioChange]:
    """One that ended by itself is silent already."""
    if unit.state is UnitState.DONE and unit.cut is None:
        return []
    return [AudioStop(told.clip, unit.cut if unit.cut is not None else told.start, _FADE)]
