"""Sounds, audio clips that start at a time, and changes to them."""

import io
import wave
from dataclasses import dataclass, field, replace
from typing import Self

from reactive_realizer.clock.units import GlobalTime, Time

_SAMPLE_BYTES = 2


@dataclass(frozen=True, slots=True, weakref_slot=True)
class Sound:
    """A sound, as a WAV file in memory, which is empty for silence; ``duration`` is in s."""

    wav: bytes
    duration: float

    @classmethod
    def from_pcm(cls, pcm: bytes, sample_rate: int, channels: int = 1) -> Self:
        """A sound of some samples.

        Args:
            pcm: int16, little-endian; in stereo, left and right alternate.
            sample_rate: Hz.
            channels: 1 for mono, 2 for stereo.
        """
        file = io.BytesIO()
        with wave.open(file, "wb") as sound:
            sound.setnchannels(channels)
            sound.setsampwidth(_SAMPLE_BYTES)
            sound.setframerate(sample_rate)
            sound.writeframes(pcm)
        return cls(file.getvalue(), len(pcm) / (_SAMPLE_BYTES * channels * sample_rate))

    def pcm(self, start: float, end: float) -> bytes:
        """The samples between two times, s, as far as there are any: int16, little-endian."""
        if not self.wav:
            return b""
        with wave.open(io.BytesIO(self.wav)) as sound:
            rate, number = sound.getframerate(), sound.getnframes()
            first, last = (min(max(0, round(time * rate)), number) for time in (start, end))
            sound.setpos(first)
            return bytes(sound.readframes(max(0, last - first)))


@dataclass(frozen=True, slots=True)
class Caption:
    """The text of a speech, to be read while it is heard.

    Attributes:
        text: what is spoken.
        words: of each word in their order, its start, s from the start of the speech, and its place in the text: the
            index of its first character, and that after its last one.
    """

    text: str
    words: tuple[tuple[float, int, int], ...]

    def later(self, seconds: float) -> Self:
        """The caption with later words, for a sound that begins earlier or within the speech."""
        return replace(self, words=tuple((begin + seconds, first, last) for begin, first, last in self.words))


@dataclass(frozen=True, slots=True)
class AudioClip:
    """A sound that clients know by its id, with the caption of a speech."""

    id: str
    sound: Sound
    caption: Caption | None = None


@dataclass(frozen=True, slots=True)
class AudioStart:
    """A clip starts at a time, which may be unknown until it moves; ``gain`` 1 is as recorded."""

    character: str
    clip: AudioClip
    start: Time
    gain: float = 1.0


@dataclass(frozen=True, slots=True)
class AudioMove:
    """An announced clip starts at another time.

    Attributes:
        id: of the clip.
        start: of its first sample, s.
        time: of the first frame that shows the new start, s.
    """

    id: str
    start: GlobalTime
    time: GlobalTime


@dataclass(frozen=True, slots=True)
class AudioGain:
    """A clip gets another gain at a time; 1 is as recorded."""

    id: str
    gain: float
    time: GlobalTime


@dataclass(frozen=True, slots=True)
class AudioStop:
    """A clip stops at a time, faded out over ``fade`` s."""

    id: str
    time: GlobalTime
    fade: float


@dataclass(frozen=True, slots=True)
class AudioHeard:
    """A client reports what is heard of a clip.

    Attributes:
        id: of the clip.
        position: in the clip, s.
        time: of the frames that the client shows at that moment, s.
    """

    id: str
    position: float
    time: GlobalTime


@dataclass(frozen=True, slots=True)
class StreamedAudio:
    """A client sends sound of a speech that it streams.

    Attributes:
        stream: its name.
        audio: mono PCM, int16 little-endian; it may be cut anywhere, also in the middle of a sample.
        words: further words of the text, each with its start in s from the start of the stream.
        end: whether nothing follows.
    """

    stream: str
    audio: bytes = field(default=b"", repr=False)
    words: tuple[tuple[str, float], ...] = ()
    end: bool = False


AudioChange = AudioStart | AudioMove | AudioGain | AudioStop
