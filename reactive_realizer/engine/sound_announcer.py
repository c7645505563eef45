"""Announces the sounds and captions of planned units: early, to be there when the units start."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from reactive_realizer.clock.units import GlobalTime, Time
from reactive_realizer.embodiment.audio import (
    AudioChange,
    AudioClip,
    AudioGain,
    AudioMove,
    AudioStart,
    AudioStop,
    Caption,
    Sound,
)
from reactive_realizer.engine.sound_unit import SoundPart, SoundUnit
from reactive_realizer.planunit.plan_unit import UnitState

_WORTH_MOVING = 1e-3
"""The smallest change of a start time that is announced, s."""

_FADE = 0.02
"""Fade of a sound that is cut, s: long enough to avoid a click, short enough to be silent at once."""


@dataclass(slots=True)
class _Announced:
    """The last announcement of a sound, and the tick of the last one of its gain, which is sent once a tick at most."""

    clip: str
    part: SoundPart
    start: Time
    gain: float
    caption: Caption | None
    gain_tick: Time = None

    def ended(self, time: GlobalTime) -> bool:
        """Whether it has ended by itself at a time."""
        return self.start is not None and self.start + self.part.end - self.part.begin <= time


class SoundAnnouncer:
    """Keeps track of the sounds of the planned units of an engine, and announces what changes.

    Args:
        character: its id.
        prefix: of the ids of clips, unique among the engines of all characters.
    """

    def __init__(self, character: str, prefix: str) -> None:
        self._character = character
        self._prefix = prefix
        self._announced: dict[SoundUnit, list[_Announced]] = {}
        self._sources: dict[SoundUnit, list[SoundPart]] = {}
        """The sounds of each unit; a unit that makes all of them again has new ones."""
        self._unsent: dict[SoundUnit, None] = {}
        """The units of which a gain is left for the next tick."""
        self._count = 0

    def find(self, clip: str) -> tuple[SoundUnit, SoundPart] | None:
        """The live unit that a clip was announced for, and its part."""
        pairs = ((unit, each) for unit, announced in self._announced.items() if unit.live for each in announced)
        return next(((unit, each.part) for unit, each in pairs if each.clip == clip), None)

    def changes(self, units: Iterable[SoundUnit], now: GlobalTime) -> tuple[AudioChange, ...]:
        """The changes since the last call.

        Args:
            units: all that may have changed, in the order of planning.
            now: the time of the tick.
        """
        units = tuple(dict.fromkeys((*self._unsent, *units)))
        self._unsent.clear()
        out: list[AudioChange] = []
        for unit in units:
            announced = self._announced.get(unit)
            if announced is not None:
                out += self._updates(unit, announced, now)
        for unit in units:
            if unit.live:
                announced, self._sources[unit] = self._announced.setdefault(unit, []), unit.sounds
                out += [self._announce(unit, part, announced) for part in unit.sounds[len(announced) :]]
        return tuple(out)

    def _updates(self, unit: SoundUnit, announced: list[_Announced], now: GlobalTime) -> Iterator[AudioChange]:
        """The changes of what was announced of a unit; none of it counts any more if the unit has ended."""
        if unit.live and unit.sounds is self._sources[unit]:
            yield from _differences(unit, announced, now)
            if unit.elastic:
                yield from self._restated(unit, announced)
            if any(each.gain != unit.gain and not each.ended(now) for each in announced):
                self._unsent[unit] = None
        else:
            del self._announced[unit], self._sources[unit]
            yield from _silences(unit, announced, now)

    def _announce(self, unit: SoundUnit, part: SoundPart, announced: list[_Announced]) -> AudioStart:
        self._count += 1
        start = _start(unit.origin, part)
        caption = None if unit.caption is None else unit.caption.later(-part.begin)
        clip = AudioClip(f"{self._prefix}-{self._count}", part.sound, caption)
        announced.append(_Announced(clip.id, part, start, unit.gain, caption))
        return AudioStart(self._character, clip, start, unit.gain)

    def _restated(self, unit: SoundUnit, announced: Iterable[_Announced]) -> Iterator[AudioStart]:
        """The caption of a speech without sound again, if its words have moved."""
        caption = unit.caption
        for each in announced:
            if caption != each.caption:
                each.caption = caption
                each.part = SoundPart(0.0, Sound(b"", unit.length))
                clip = AudioClip(each.clip, each.part.sound, caption)
                yield AudioStart(self._character, clip, each.start, unit.gain)


def _start(origin: Time, part: SoundPart) -> Time:
    """When the first sample of a part is heard, whose unit begins to be heard at a time."""
    return None if origin is None else GlobalTime(origin + part.begin)


def _differences(unit: SoundUnit, announced: Iterable[_Announced], now: GlobalTime) -> Iterator[AudioChange]:
    """The changes of the sounds of a live unit since their last announcement, which they update."""
    origin, gain = unit.origin, unit.gain
    for each, part in zip(announced, unit.sounds, strict=False):
        if not each.ended(now):
            time = _start(origin, each.part)
            if time is not None and (each.start is None or abs(time - each.start) > _WORTH_MOVING):
                each.start = time
                yield AudioMove(each.clip, time, now)
            if gain != each.gain and each.gain_tick != now:
                each.gain, each.gain_tick = gain, now
                yield AudioGain(each.clip, gain, now)
        if part.until != each.part.until and each.start is not None:  # another sound takes its place
            each.part = part
            yield AudioStop(each.clip, GlobalTime(each.start + part.until - part.begin), _FADE)


def _silences(unit: SoundUnit, announced: Sequence[_Announced], now: GlobalTime) -> Iterator[AudioChange]:
    """The stops of the sounds of a unit."""
    for each, following in zip(announced, (*announced[1:], None), strict=True):
        yield from _silence(unit, each, following, now)


def _silence(
    unit: SoundUnit, announced: _Announced, following: _Announced | None, now: GlobalTime
) -> list[AudioChange]:
    """The stop of a sound that was cut or never started.

    One that ended by itself is silent already. But its caption is still shown in the pause before the following sound.
    """
    if unit.state is UnitState.DONE and unit.cut is None:
        return []
    time = next((time for time in (unit.cut, announced.start) if time is not None), now)
    shown = announced.caption is not None and (following is None or following.start is None or following.start > time)
    if announced.ended(time) and not shown:
        return []
    return [AudioStop(announced.clip, time, _FADE)]
