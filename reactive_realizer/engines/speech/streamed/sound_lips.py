"""Lips for sound whose words are unknown: open where it is loud, spread where bright, and rounded where dark."""

from itertools import groupby
from typing import Final

from reactive_realizer.engine.tts import Phoneme
from reactive_realizer.engines.speech.streamed.sound_levels import AUDIBLE, FRAME, SoundLevels

_OPENINGS: Final = ((0.2, "n"), (0.45, "\u026a"), (0.75, "\u025b"))
"""Sounds that open the mouth further and further, each below a loudness; louder sound is an a."""
_ROUND: Final = ((0.45, "u"), (float("inf"), "o"))
"""Rounded sounds, each below a loudness."""
_HISSING: Final = 0.5
"""Share of the energy in high frequencies above which a sound is an s."""
_DARK: Final = 450.0
"""Center of the spectrum below which a sound is rounded, Hz."""


class SoundLips:
    """Sounds for the lips, from the sound alone, as it arrives.

    Args:
        levels: of the sound.
    """

    def __init__(self, levels: SoundLevels) -> None:
        self._levels = levels
        self._symbols: list[str] = []

    def phonemes(self, since: float) -> list[Phoneme]:
        """What is heard since a time, s."""
        levels = self._levels
        for frame in range(len(self._symbols), len(levels.loudness)):
            loudness, bright, center = levels.loudness[frame], levels.brightness[frame], levels.centers[frame]
            self._symbols.append(_symbol(float(loudness), float(bright), float(center)))
        frame, at = round(since / FRAME), since
        phonemes = []
        for symbol, same in groupby(_steady(self._symbols)[frame:]):
            frame += sum(1 for _ in same)
            phonemes.append(Phoneme(symbol, at, frame * FRAME - at))
            at = frame * FRAME
        return phonemes


def _symbol(loudness: float, bright: float, center: float) -> str:
    if loudness < AUDIBLE:
        return ""
    if bright > _HISSING:
        return "s"
    shapes = _ROUND if center < _DARK and loudness > _OPENINGS[0][0] else _OPENINGS
    return next((symbol for most, symbol in shapes if loudness < most), "a")


def _steady(symbols: list[str]) -> list[str]:
    """The sounds of all frames; one of a single frame between two others takes the sound before it."""
    return [
        before if before != symbol != after else symbol
        for before, symbol, after in zip(symbols[:1] + symbols[:-1], symbols, symbols[1:] + symbols[-1:], strict=True)
    ]
