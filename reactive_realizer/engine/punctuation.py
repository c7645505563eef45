"""Marks between words at which speakers pause."""

from typing import Final

SENTENCE_ENDS: Final = ".!?\u2026"
DASHES: Final = "\u2013\u2014"
CLAUSE_ENDS: Final = ",;:" + DASHES
"""The marks that end a clause within a sentence."""
STOPS: Final = SENTENCE_ENDS + CLAUSE_ENDS
