"""What is heard: clips that start at a time, move, change volume and stop."""

from dataclasses import dataclass

from reactive_realizer.clock.units import GlobalTime


@dataclass(frozen=True, slots=True)
class AudioClip:
    """A sound, as a WAV file in memory."""

    id: str
    wav: bytes
    duration: float


@dataclass(frozen=True, slots=True)
class AudioStart:
    """A clip is to sound from a time on; ``gain`` 1 is as recorded."""

    character: str
    clip: AudioClip
    start: GlobalTime
    gain: float = 1.0


@dataclass(frozen=True, slots=True)
class AudioMove:
    """A clip that was announced is to start at another time."""

    id: str
    start: GlobalTime


@dataclass(frozen=True, slots=True)
class AudioGain:
    """A clip is to sound with another gain from a time on; 1 is as recorded."""

    id: str
    gain: float
    time: GlobalTime


@dataclass(frozen=True, slots=True)
class AudioStop:
    """A clip falls silent at a time, faded out over ``fade`` s."""

    id: str
    time: GlobalTime
    fade: float


AudioChange = AudioStart | AudioMove | AudioGain | AudioStop
