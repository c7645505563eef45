"""The times of the words and sounds of a recorded speech."""

from dataclasses import dataclass

from reactive_realizer.engine.tts import Phoneme


@dataclass(frozen=True, slots=True)
class SpeechTimes:
    """Times from the start of a recording.

    Attributes:
        words: when each word of the text begins, s.
        phonemes: in the order of time; none leave the mouth closed.
    """

    words: tuple[float, ...]
    phonemes: tuple[Phoneme, ...]


CLOSURE = 0.04
"""Time from the closure of a plosive to its release (s), which is the start of its `Phoneme`."""

_PLOSIVES = frozenset("pbtdk\u0261")


def phoneme(symbol: str, begin: float, end: float) -> Phoneme:
    """A sound from its interval, s; that of a plosive includes its closure."""
    start = begin + min(CLOSURE, (end - begin) / 2) if symbol in _PLOSIVES else begin
    return Phoneme(symbol, start, end - start)
