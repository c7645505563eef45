"""The times of the words and sounds of a recorded speech."""

from dataclasses import dataclass

from reactive_realizer.engine.phonetics import onset
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


def phoneme(symbol: str, begin: float, end: float) -> Phoneme:
    """A sound from its interval, s; that of a plosive includes its closure."""
    start = onset(symbol, begin, end)
    return Phoneme(symbol, start, end - start)
