"""Audio clips that start at a time, and changes to them."""

from dataclasses import dataclass

from reactive_realizer.clock.units import GlobalTime, Time


@dataclass(frozen=True, slots=True)
class AudioClip:
    """A sound, as a WAV file in memory; ``duration`` is in s."""

    id: str
    wav: bytes
    duration: float


@dataclass(frozen=True, slots=True)
class AudioStart:
    """A clip starts at a time, which may be unknown until it moves; ``gain`` 1 is as recorded."""

    character: str
    clip: AudioClip
    start: Time
    gain: float = 1.0


@dataclass(frozen=True, slots=True)
class AudioMove:
    """An announced clip starts at another time."""

    id: str
    start: GlobalTime


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


AudioChange = AudioStart | AudioMove | AudioGain | AudioStop
