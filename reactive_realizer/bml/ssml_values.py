"""Values of SSML attributes, as factors and seconds (W3C, Speech Synthesis Markup Language 1.1, section 3.2).

The standard leaves it to processors what strengths of breaks, and words for rate, pitch and volume mean; here, they
mean what they mean to espeak-ng.
"""

import re
from collections.abc import Mapping
from typing import Final

from reactive_realizer.errors import Fault, RealizerError

LONGEST_BREAK: Final = 10.0
"""The longest break, s."""

_PAUSES: Final = {"none": 0.0, "x-weak": 0.06, "weak": 0.09, "medium": 0.25, "strong": 0.4, "x-strong": 0.65}
_RATES: Final = {"x-slow": 0.6, "slow": 0.8, "medium": 1.0, "fast": 1.25, "x-fast": 1.6, "default": 1.0}
_PITCHES: Final = {"x-low": 0.7, "low": 0.85, "medium": 1.0, "high": 1.1, "x-high": 1.2, "default": 1.0}
_VOLUMES: Final = {
    "silent": 0.0,
    "x-soft": 0.3,
    "soft": 0.65,
    "medium": 1.0,
    "loud": 1.5,
    "x-loud": 2.3,
    "default": 1.0,
}

_NUMBER: Final = re.compile(r"([+-]?)(\d+(?:\.\d*)?|\.\d+)\s*(%|st|dB|Hz|ms|s|)")
_ABSURD = 1e5
"""A number that no attribute has: 100 s in ms."""
_SLOWEST, _FASTEST = 0.1, 10.0
_MOST: Final = 10.0
"""The greatest factor of a pitch or a volume."""
_MOST_DECIBELS, _MOST_SEMITONES = 100.0, 100.0
"""More than the greatest factor, and what a float can hold."""


class NotSsmlValue(Fault):
    """A value that an attribute of SSML cannot have."""

    code = "not-ssml-value"
    template = "it must be {wanted}"
    wanted: str


def read_time(text: str) -> float:
    """The duration of a break, s.

    Raises:
        RealizerError: ``not-ssml-value``.
    """
    sign, number, unit = _parts(text)
    seconds = number / 1000 if unit == "ms" else number
    if sign or unit not in {"ms", "s"} or seconds > LONGEST_BREAK:
        raise RealizerError(NotSsmlValue(wanted=f"a time such as 250ms or 1.5s, at most {LONGEST_BREAK:g}s"))
    return seconds


def read_strength(text: str) -> float:
    """The duration of a break of a strength, s.

    Raises:
        RealizerError: ``not-ssml-value``.
    """
    if text not in _PAUSES:
        raise RealizerError(NotSsmlValue(wanted=_words(_PAUSES)))
    return _PAUSES[text]


def read_rate(text: str) -> float:
    """How many times as fast a part is spoken.

    Raises:
        RealizerError: ``not-ssml-value``.
    """
    factor = _RATES.get(text) or _factor(*_parts(text), {"": 1.0, "%": 0.01})
    if factor is None or not _SLOWEST <= factor <= _FASTEST:
        raise RealizerError(NotSsmlValue(wanted=f"a rate such as 80% or 1.2, or {_words(_RATES)}"))
    return factor


def read_pitch(text: str) -> float | None:
    """How many times the usual frequency a part has; None for a frequency in Hz, which is none.

    Raises:
        RealizerError: ``not-ssml-value``.
    """
    sign, number, unit = _parts(text)
    if unit == "Hz":
        return None
    factor: float | None
    if unit == "st" and sign:
        factor = 2 ** (float(sign + "1") * min(number, _MOST_SEMITONES) / 12)
    else:
        factor = _PITCHES.get(text) or _factor(sign, number, unit, {"%": 0.01})
    if factor is None or not 0 < factor <= _MOST:
        raise RealizerError(NotSsmlValue(wanted=f"a change such as +10% or -2st, or {_words(_PITCHES)}"))
    return factor


def read_volume(text: str) -> float:
    """How many times the usual amplitude a part has; 0 for silence.

    Raises:
        RealizerError: ``not-ssml-value``.
    """
    sign, number, unit = _parts(text)
    factor: float | None
    if unit == "dB":
        factor = 10 ** (float(sign + "1") * min(number, _MOST_DECIBELS) / 20)
    elif text in _VOLUMES:
        factor = _VOLUMES[text]
    else:
        factor = _factor(sign, number, unit, {"%": 0.01} if sign else {"": 0.01, "%": 0.01})
    if factor is None or not 0 <= factor <= _MOST:
        raise RealizerError(NotSsmlValue(wanted=f"a change such as +6dB or -20%, or {_words(_VOLUMES)}"))
    return factor


def _factor(sign: str, number: float, unit: str, units: Mapping[str, float]) -> float | None:
    """A factor from a number in one of some units; with a sign, it is the difference to 1."""
    if unit not in units:
        return None
    return 1 + float(sign + "1") * number * units[unit] if sign else number * units[unit]


def _parts(text: str) -> tuple[str, float, str]:
    """The sign, the absolute value and the unit of a number; for other texts, and absurd numbers, an unknown unit."""
    found = _NUMBER.fullmatch(text)
    if found is None or float(found[2]) > _ABSURD:
        return "", 0.0, "?"
    return found[1], float(found[2]), found[3]


def _words(words: Mapping[str, float]) -> str:
    *first, last = words
    return f"{', '.join(first)} or {last}"
