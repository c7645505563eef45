"""Signs of the International Phonetic Alphabet, and the time course of plosives."""

from typing import Final

PRIMARY_STRESS: Final = "\u02c8"
SECONDARY_STRESS: Final = "\u02cc"
STRESS: Final = PRIMARY_STRESS + SECONDARY_STRESS
"""The marks before a stressed sound."""

PLOSIVES: Final = frozenset("pbtdkgcɟqɢʈɖ\u0261")
CLOSURE: Final = 0.04
"""Time from the closure of a plosive to its release, s: espeak-ng has 0.030 to 0.045."""


def is_plosive(symbol: str) -> bool:
    """Whether a sound is a plosive, stressed or not; affricates are none."""
    return symbol.strip(STRESS) in PLOSIVES


def onset(symbol: str, begin: float, end: float) -> float:
    """The onset of a sound, as of a `Phoneme`, from its interval, s: that of a plosive begins with its closure."""
    return begin + min(CLOSURE, (end - begin) / 2) if is_plosive(symbol) else begin
