"""Lips for sound whose words are unknown: open where it is loud, spread where bright, and rounded where dark.

They close in pauses, and in a short silence before a burst without high frequencies: the burst of t and d is strongest
there, that of p and b is not (K. N. Stevens and S. E. Blumstein, "Invariant cues for place of articulation in stop
consonants", 1978). In 160 s of speech of four synthetic voices, these silences are 55 % of the closures of p and b, and
32 % of those of t, d, k and g. The sound m is not told from n.
"""

from collections.abc import Iterator
from itertools import groupby
from typing import Final

import numpy as np

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
_CLOSED: Final = "m"
"""A sound with closed lips."""
_QUIET: Final = 0.2
"""Loudness below which there may be a closure."""
_LONGEST: Final = 7
"""The most frames of a closure; a longer silence is a pause."""
_HELD: Final = (2, 4)
"""For how many frames, at least and at most, the lips are closed before a burst."""
_RISE: Final = 4
"""Frames after a closure within which the sound is loud, at least `_LOUD`."""
_LOUD: Final = 0.4
_LOW: Final = 0.06
"""Share of the energy in high frequencies below which a burst is that of the lips."""


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
        levels, known = self._levels, len(self._symbols)
        for frame in range(known, len(levels.loudness)):
            loudness, bright, center = levels.loudness[frame], levels.brightness[frame], levels.centers[frame]
            self._symbols.append(_symbol(float(loudness), float(bright), float(center)))
        for first, last in _closures(levels, max(0, known - _LONGEST - _RISE)):
            self._symbols[first:last] = [_CLOSED] * (last - first)
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


def _closures(levels: SoundLevels, since: int) -> Iterator[tuple[int, int]]:
    """The closures of the lips after a frame: the first frame of each, and that after the last one."""
    loudness, brightness = levels.loudness[since:], levels.brightness[since:]
    quiet = np.flatnonzero(np.diff((loudness < _QUIET).astype(int), prepend=1, append=0))
    for first, last in zip(quiet[1::2].tolist(), quiet[2::2].tolist(), strict=True):
        if last - first > _LONGEST or last == len(loudness) or loudness[last : last + _RISE].max() < _LOUD:
            continue
        burst = slice(first + int(np.argmin(loudness[first:last])) + 1, last + 1)
        if np.average(brightness[burst], weights=loudness[burst] ** 2) < _LOW:
            shortest, longest = _HELD
            begin = max(min(first, last - shortest), last - longest, 0)
            yield since + begin, since + last


def _steady(symbols: list[str]) -> list[str]:
    """The sounds of all frames; one of a single frame between two others takes the sound before it."""
    return [
        before if before != symbol != after else symbol
        for before, symbol, after in zip(symbols[:1] + symbols[:-1], symbols, symbols[1:] + symbols[-1:], strict=True)
    ]
