"""Markup of a text to be spoken: properties of its parts, in units that do not depend on the voice."""

from dataclasses import dataclass
from enum import StrEnum


class MarkupKind(StrEnum):
    """The kinds of markup, named after elements and attributes of SSML."""

    BREAK = "break"
    """A silence of ``number`` s in front of a character."""
    RATE = "rate"
    """Spoken ``number`` times as fast."""
    PITCH = "pitch"
    """Spoken with ``number`` times the frequency."""
    VOLUME = "volume"
    """Spoken with ``number`` times the amplitude."""
    EMPHASIS = "emphasis"
    """``text`` is strong, moderate or reduced."""
    SUB = "sub"
    """``text`` is spoken instead."""
    SAY_AS = "say-as"
    """``text`` is characters or digits: spelled."""
    PHONEME = "phoneme"
    """``text`` is the pronunciation, in the International Phonetic Alphabet."""
    VOICE = "voice"
    """``text`` is the name of a voice."""
    LANGUAGE = "lang"
    """``text`` is a language tag, such as en-GB."""
    SENTENCE = "s"
    """A sentence, or a paragraph."""
    OTHER = "other"
    """Something that no voice here can do."""


@dataclass(frozen=True, slots=True)
class Markup:
    """One property of a part of a text. The parts are nested: none begins in another one and ends after it.

    Attributes:
        kind: of the property.
        first: index of the first character of the part.
        last: index after its last character; equal to ``first`` for a break.
        written: the element, with the attribute that says so, for messages.
        number: see `MarkupKind`.
        text: see `MarkupKind`.
    """

    kind: MarkupKind
    first: int
    last: int
    written: str
    number: float = 1.0
    text: str = ""
