"""Writes a text with marks and markup as the SSML that espeak-ng understands."""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Final
from xml.sax.saxutils import escape, quoteattr

from reactive_realizer.bml.markup import Markup, MarkupKind
from reactive_realizer.engine.tts import STOPS

FOLLOWED: Final = frozenset(MarkupKind) - {MarkupKind.PHONEME, MarkupKind.OTHER}
"""The kinds of markup that espeak-ng follows; for voices and languages, only those that it has."""

_NO_VOICES: Final[Mapping[str, str]] = MappingProxyType({})
_STRONG: Final = '<break strength="strong"/>'
_SPELLED: Final = {"characters": "characters", "digits": "tts:digits"}


@dataclass(frozen=True, slots=True)
class SsmlDocument:
    """A text as SSML.

    Attributes:
        ssml: the whole document; mark number n of the text is named ``mn``, so that no name has to be quoted.
        origins: for each character of the SSML, the index of the corresponding character of the text; for a tag, that
            of the character after it.
        left_out: the markup that espeak-ng cannot follow.
    """

    ssml: str
    origins: tuple[int, ...]
    left_out: tuple[Markup, ...] = ()

    def origin(self, position: int) -> int:
        """The index into the text for a 1-based position in the SSML, as espeak-ng counts."""
        return self.origins[min(max(position, 1), len(self.origins)) - 1]


def ssml_document(
    text: str, marks: Sequence[int], markup: Sequence[Markup] = (), voices: Mapping[str, str] = _NO_VOICES
) -> SsmlDocument:
    """A plain text with empty ``<mark>`` elements and with markup.

    Args:
        text: plain.
        marks: the index of the character that each precedes, 0 to ``len(text)``.
        markup: outer parts first.
        voices: the library's identifier of each voice, by its common name in lower case.
    """
    writer = _Writer(text, voices)
    begins = defaultdict(list)
    for each in markup:
        begins[each.first].append(each)
    pending = sorted((index, number) for number, index in enumerate(marks))
    for index in range(len(text) + 1):
        writer.close(index)
        writer.pause(begins[index])
        while pending and pending[0][0] <= index:
            writer.write(f'<mark name="m{pending.pop(0)[1]}"/>', index)
        writer.open(begins[index])
        writer.character(index)
    writer.write("</speak>", len(text))
    ssml = "".join(piece for piece, _ in writer.pieces)
    origins = tuple(origin for piece, origin in writer.pieces for _ in piece)
    return SsmlDocument(ssml, origins, tuple(writer.left_out))


class _Writer:
    """Writes a document from its first character to its last.

    Attributes:
        pieces: of the document, with the index of the character of the text to which each belongs.
        left_out: the markup that is not written.
    """

    def __init__(self, text: str, voices: Mapping[str, str]) -> None:
        self.pieces: list[tuple[str, int]] = [("<speak>", 0)]
        self.left_out: list[Markup] = []
        self._text = text
        self._voices = voices
        self._open: list[tuple[int, str]] = []
        self._resume = 0  # where the text goes on after a part that is replaced

    def write(self, piece: str, index: int) -> None:
        self.pieces.append((piece, index))

    def character(self, index: int) -> None:
        """Writes a character, unless something else is spoken instead."""
        if index >= self._resume:
            self.write(escape(self._text[index : index + 1]), index)

    def close(self, index: int) -> None:
        """Ends the parts that end before a character."""
        while self._open and self._open[-1][0] <= index:
            self.write(self._open.pop()[1], index)

    def pause(self, markup: Sequence[Markup]) -> None:
        """Writes the breaks."""
        for each in markup:
            if each.kind is MarkupKind.BREAK and each.first >= self._resume:
                self.write(f'<break time="{1000 * each.number:.0f}ms"/>', each.first)

    def open(self, markup: Sequence[Markup]) -> None:
        """Begins parts, outer ones first."""
        for each in markup:
            if each.kind is MarkupKind.OTHER:
                self.left_out.append(each)
            elif each.last > each.first >= self._resume:
                self._begin(each)

    def _begin(self, markup: Markup) -> None:
        if markup.kind is MarkupKind.SUB:
            # Not as <sub>: espeak-ng would not tell the position of the words that are spoken instead.
            self.write(escape(markup.text), markup.first)
            self._resume = markup.last
        elif markup.kind is MarkupKind.SENTENCE:
            # Not as <s>, which espeak-ng begins with half a second of silence.
            ends = self._text[markup.first : markup.last].rstrip()[-1:] in STOPS or markup.last == len(self._text)
            self._open.append((markup.last, "" if ends else _STRONG))
        elif (tag := _tag(markup, self._voices)) is not None:
            self.write(f"<{tag}>", markup.first)
            self._open.append((markup.last, f"</{tag.partition(' ')[0]}>"))
        else:
            self.left_out.append(markup)


def _tag(markup: Markup, voices: Mapping[str, str]) -> str | None:
    """The start tag of markup, without its brackets; None if espeak-ng cannot follow it."""
    match markup.kind:
        case MarkupKind.RATE | MarkupKind.VOLUME:
            return f'prosody {markup.kind}="{markup.number:.0%}"'
        case MarkupKind.PITCH:
            return f'prosody pitch="{markup.number - 1:+.0%}"'
        case MarkupKind.EMPHASIS:
            return f'emphasis level="{markup.text}"'
        case MarkupKind.SAY_AS:
            return f'say-as interpret-as="{_SPELLED[markup.text]}"'
        case MarkupKind.VOICE | MarkupKind.LANGUAGE if markup.text.lower() in voices:
            return f"voice name={quoteattr(voices[markup.text.lower()])}"
    return None
