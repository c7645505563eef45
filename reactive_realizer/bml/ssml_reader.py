"""Reads SSML (W3C, Speech Synthesis Markup Language 1.1) as a plain text with marks and markup.

What no voice here can do stays in the markup too, so that a voice can tell all that it cannot do at once.
"""

import re
from dataclasses import replace
from typing import Final, NamedTuple

from reactive_realizer.bml.attribute_types import Id
from reactive_realizer.bml.attributes import Attribute
from reactive_realizer.bml.block_source import BlockSource
from reactive_realizer.bml.faults import DuplicateId, MissingElement
from reactive_realizer.bml.markup import Markup, MarkupKind
from reactive_realizer.bml.speech import Mark, Speech
from reactive_realizer.bml.speech_faults import TooMuchMarkup, TooMuchSilence, UtteranceTooLong
from reactive_realizer.bml.ssml_elements import ATTRIBUTES, break_of, is_ssml, properties_of
from reactive_realizer.bml.trees import Tree, name_of
from reactive_realizer.errors import Fault, RealizerError

MOST_MARKUP: Final = 1_000
"""Limit on the properties of the parts of one speech."""
MOST_SILENCE: Final = 60.0
"""Limit on the sum of the breaks of one speech, s."""

_NAME: Final = Attribute("name", "name", Id(), required=True, default=None, continuous=False)
_NOT_SPOKEN: Final = frozenset({"desc", "lexicon", "meta", "metadata"})
_SEPARATE: Final = frozenset({"p", "s"})
"""Elements whose text does not run on into the text around them."""


class MarkedUpText(NamedTuple):
    """The text of an SSML document, with its marks and markup.

    Attributes:
        text: runs of white space reduced to single spaces.
        marks: in the order of the text.
        markup: outer parts first.
    """

    text: str
    marks: tuple[Mark, ...]
    markup: tuple[Markup, ...]


def read_ssml(holder: Tree, source: BlockSource, notes: list[Fault]) -> MarkedUpText:
    """The content of the ``<speak>`` in an element.

    Args:
        holder: of the ``<speak>``.
        source: its block.
        notes: receives the faults of elements and attributes that are ignored; the text in them is spoken.

    Raises:
        RealizerError: there is no ``<speak>``, the text is too long, or there is too much markup.
    """
    speak = next((child for child in holder if is_ssml(child) and name_of(child) == "speak"), None)
    if speak is None:
        raise RealizerError(source.located(holder, MissingElement(element=name_of(holder), children="<speak>")))
    reading = _Reading(source, notes)
    reading.read(speak)
    return reading.result()


class _Reading:
    """A document that is being read."""

    def __init__(self, source: BlockSource, notes: list[Fault]) -> None:
        self._source = source
        self._notes = notes
        self._text = ""
        self._places: dict[str, int] = {}
        self._markup: list[Markup] = []
        self._silence = 0.0
        self._replacing = 0  # characters that are spoken instead of others

    def result(self) -> MarkedUpText:
        """Returns the text that has been read, with its marks and markup."""
        text = self._text.rstrip()
        marks = tuple(Mark(id=name, char_index=min(at, len(text))) for name, at in self._places.items())
        end = len(text)
        markup = (replace(each, first=min(each.first, end), last=min(each.last, end)) for each in self._markup)
        return MarkedUpText(text, marks, tuple(markup))

    def read(self, tree: Tree) -> None:
        """Reads an element and its content."""
        name = name_of(tree)
        if name in ATTRIBUTES and is_ssml(tree):
            self._notes += self._source.unknown_attributes(tree, ATTRIBUTES[name])
            if name in {"mark", "break"}:
                self._read_empty(tree)
                return
        elif name in _NOT_SPOKEN:
            return
        self._say(" " * (name in _SEPARATE), tree)
        self._read_content(tree)
        self._say(" " * (name in _SEPARATE), tree)

    def _read_content(self, tree: Tree) -> None:
        """Reads the content of an element, and what the element says of it."""
        first, number = len(self._text), len(self._markup)
        for markup in properties_of(tree, self._source, self._notes):
            self._add(markup, tree)
        inside = len(self._markup)
        self._say(tree.text or "", tree)
        for child in tree:
            self.read(child)
            self._say(child.tail or "", tree)
        for index in range(number, inside):
            self._markup[index] = replace(self._markup[index], first=first, last=len(self._text))

    def _read_empty(self, tree: Tree) -> None:
        """Reads a mark, or a break."""
        silence: Markup | None = None
        try:
            if name_of(tree) == "mark":
                self._places[self._new_mark(tree)] = len(self._text)
            else:
                silence = break_of(tree, self._source)
        except RealizerError as refused:
            self._notes.append(refused.fault)
        if silence is not None:
            self._add(replace(silence, first=len(self._text), last=len(self._text)), tree)

    def _new_mark(self, tree: Tree) -> str:
        (name,) = self._source.values(tree, [_NAME]).values()
        if name in self._places or name in Speech.SYNC_POINTS:
            raise RealizerError(self._source.located(tree, DuplicateId(element="mark", id=name)))
        return str(name)

    def _add(self, markup: Markup, tree: Tree) -> None:
        self._markup.append(markup)
        if len(self._markup) > MOST_MARKUP:
            raise RealizerError(self._source.located(tree, TooMuchMarkup(limit=MOST_MARKUP)))
        if markup.kind is MarkupKind.SUB:
            self._replacing += len(markup.text)
        if markup.kind is MarkupKind.BREAK:
            self._silence += markup.number
        if self._silence > MOST_SILENCE:
            raise RealizerError(self._source.located(tree, TooMuchSilence(limit=MOST_SILENCE)))

    def _say(self, piece: str, tree: Tree) -> None:
        spaced = re.sub(r"\s+", " ", piece)
        self._text += spaced.lstrip() if not self._text or self._text.endswith(" ") else spaced
        limit = self._source.limits.utterance_characters
        if len(self._text) + self._replacing > limit:
            raise RealizerError(self._source.located(tree, UtteranceTooLong(limit=limit)))
