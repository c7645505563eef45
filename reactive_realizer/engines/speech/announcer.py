"""Tells what is to be heard, before it is: sounds are scheduled, not played when it is too late."""

from collections.abc import Iterable

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.audio import AudioChange, AudioClip, AudioMove, AudioStart, AudioStop
from reactive_realizer.engines.speech.audio import wav_bytes
from reactive_realizer.engines.speech.speech_unit import SpeechUnit
from reactive_realizer.planunit.plan_unit import UnitState

_WORTH_MOVING = 1e-3
_FADE = 0.03
"""s: long enough not to click, short enough to be silence at once."""


class Announcer:
    """Follows the planned speeches of a character and says what changed about their sounds."""

    def __init__(self, character: str) -> None:
        self._character = character
        self._announced: dict[SpeechUnit, tuple[str, GlobalTime]] = {}
        self._count = 0

    def changes(self, units: Iterable[SpeechUnit]) -> tuple[AudioChange, ...]:
        """What changed since the last call."""
        out: list[AudioChange] = []
        for unit, (clip, start) in list(self._announced.items()):
            if not unit.live:
                del self._announced[unit]
                out += _silence(unit, clip, start)
            elif (time := unit.time("start")) is not None and abs(time - start) > _WORTH_MOVING:
                self._announced[unit] = (clip, time)
                out.append(AudioMove(clip, time))
        out += [self._announce(unit, time) for unit in units if (time := self._new(unit)) is not None]
        return tuple(out)

    def _new(self, unit: SpeechUnit) -> GlobalTime | None:
        new = unit.live and unit.utterance.audio and unit not in self._announced
        return unit.time("start") if new else None

    def _announce(self, unit: SpeechUnit, start: GlobalTime) -> AudioStart:
        self._count += 1
        clip = AudioClip(f"{self._character}-{self._count}", wav_bytes(unit.utterance), unit.utterance.duration)
        self._announced[unit] = (clip.id, start)
        return AudioStart(self._character, clip, start)


def _silence(unit: SpeechUnit, clip: str, start: GlobalTime) -> list[AudioChange]:
    """One that ended by itself is silent already."""
    if unit.state is UnitState.DONE and unit.cut is None:
        return []
    return [AudioStop(clip, unit.cut if unit.cut is not None else start, _FADE)]
