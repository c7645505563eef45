"""Where the words of a text are: the same for every voice, so that word indices do not depend on the voice."""

import re

_RUN = re.compile(r"[^\s\u2013\u2014]+")
"""What stands between white space, en dashes and em dashes."""
_AROUND = ".,;:!?\u2026\"'()[]{}\u00ab\u00bb\u201c\u201d\u201e\u2018\u2019\u00a1\u00bf"
"""Punctuation that may cling to a word: stops, quotation marks, brackets."""


def word_spans(text: str) -> tuple[tuple[int, int], ...]:
    """Character ranges (first, last), ``last`` exclusive, of the words of a text, punctuation around them left out.

    A word is what stands between spaces or dashes: a number, an abbreviation or an address is one word however many
    words it sounds like.
    """
    spans = (_without_punctuation(run.start(), run.group()) for run in _RUN.finditer(text))
    return tuple((first, last) for first, last in spans if first < last)


def _without_punctuation(first: int, run: str) -> tuple[int, int]:
    first += len(run) - len(run.lstrip(_AROUND))
    return first, first + len(run.strip(_AROUND))
