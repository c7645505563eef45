"""Sounds and captions that can still be played, for clients that take or fetch them or that connect late."""

import struct
from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import inf

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.audio import AudioChange, AudioClip, AudioGain, AudioMove, AudioStart, AudioStop
from reactive_realizer.server.protocol import Message, encode
from reactive_realizer.server.subscribers import Subscribers

_KIND, _VERSION = 2, 1

_MOST_AHEAD = 1024 * 1024
"""Size above which a sound is not sent ahead, bytes: it would hold up the frames behind it."""

_GRACE = 10.0
"""Time after the end of a sound during which it can be fetched, s: pages play a little later than the realizer."""

_TIDYING = 1.0
"""Time between two searches for sounds that have ended, s."""


@dataclass(frozen=True, slots=True)
class _Sound:
    start: AudioStart
    stop: AudioStop | None = None

    @property
    def end(self) -> float:
        start = inf if self.start.start is None else self.start.start
        natural = start + self.start.clip.sound.duration
        return natural if self.stop is None else min(natural, self.stop.time + self.stop.fade)


class AudioStream:
    """Keeps sounds from their announcement until shortly after their end.

    Args:
        most_bytes: size limit of the WAV files; the oldest are dropped first.

    Attributes:
        subscribers: of the changes, as texts of the protocol.
        takers: of the sounds themselves, as binary messages, each before the text that announces it.
    """

    def __init__(self, most_bytes: int) -> None:
        self.subscribers: Subscribers[str] = Subscribers()
        self.takers: Subscribers[bytes] = Subscribers()
        self._most_bytes = most_bytes
        self._bytes = 0
        self._next_tidying = -inf
        self._sounds: dict[str, _Sound] = {}

    def take(self, change: AudioChange) -> None:
        """Handles a sound that starts, moves, changes volume or stops."""
        match change:
            case AudioStart():
                self._forget(change.clip.id)
                self._sounds[change.clip.id] = _Sound(change)
                self._bytes += len(change.clip.sound.wav)
                self._send_ahead(change.clip)
            case AudioMove(id_, start) if id_ in self._sounds:
                sound = self._sounds[id_]
                self._sounds[id_] = replace(sound, start=replace(sound.start, start=start))
            case AudioGain(id_, gain) if id_ in self._sounds:
                sound = self._sounds[id_]
                self._sounds[id_] = replace(sound, start=replace(sound.start, gain=gain))
            case AudioStop(id_) if id_ in self._sounds:
                self._sounds[id_] = replace(self._sounds[id_], stop=change)
            case _:
                pass
        if self.subscribers:
            for message in messages_of(change):
                self.subscribers.publish(encode(message))

    def _send_ahead(self, clip: AudioClip) -> None:
        if self.takers and 0 < len(clip.sound.wav) <= _MOST_AHEAD:
            self.takers.publish(encode_sound(clip))

    def tidy(self, now: GlobalTime) -> None:
        """Drops sounds that have ended, once a second, and the oldest above the size limit."""
        if now >= self._next_tidying:
            self._next_tidying = now + _TIDYING
            for id_ in [id_ for id_, sound in self._sounds.items() if sound.end + _GRACE < now]:
                self._forget(id_)
        while self._bytes > self._most_bytes:
            self._forget(next(iter(self._sounds)))

    def _forget(self, id_: str) -> None:
        sound = self._sounds.pop(id_, None)
        self._bytes -= 0 if sound is None else len(sound.start.clip.sound.wav)

    def sounding(self, now: GlobalTime) -> list[Message]:
        """The messages for a client that connects now: all sounds that have not ended."""
        ahead = [sound for sound in self._sounds.values() if sound.end > now]
        changes = [change for sound in ahead for change in (sound.start, sound.stop) if change is not None]
        return [message for change in changes for message in messages_of(change)]

    def wav(self, id_: str) -> bytes | None:
        """The WAV file of a sound; None if there is no such sound."""
        sound = self._sounds.get(id_)
        return None if sound is None else sound.start.clip.sound.wav or None


def encode_sound(clip: AudioClip) -> bytes:
    """Encodes a sound (docs/protocol.md, sounds): u8 kind, u8 version, u16 length of its id, the id, and a WAV file."""
    id_ = clip.id.encode()
    return struct.pack("<BBH", _KIND, _VERSION, len(id_)) + id_ + clip.sound.wav


def messages_of(change: AudioChange) -> Iterator[Message]:
    """A change as messages of the protocol."""
    match change:
        case AudioStart(character, clip, start, gain):
            times = {"start": None if start is None else round(start, 6), "duration": round(clip.sound.duration, 6)}
            common = {"character": character, "id": clip.id, **times, "gain": round(gain, 6)}
            if clip.caption is not None:
                words = [(round(begin, 3), first, last) for begin, first, last in clip.caption.words]
                yield {"type": "caption", **common, "text": clip.caption.text, "words": words}
            if clip.sound.wav:
                yield {"type": "audio", **common, "url": f"/audio/{clip.id}.wav"}
        case AudioMove(id_, start, time):
            yield {"type": "audio_move", "id": id_, "start": round(start, 6), "time": round(time, 6)}
        case AudioGain(id_, gain, time):
            yield {"type": "audio_gain", "id": id_, "gain": round(gain, 6), "time": round(time, 6)}
        case AudioStop(id_, time, fade):
            yield {"type": "audio_stop", "id": id_, "time": round(time, 6), "fade": fade}
