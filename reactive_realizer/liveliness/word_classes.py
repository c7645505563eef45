"""The classes of words with which people move, read from a data file (assets/liveliness/english.toml)."""

import tomllib
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final, Self

from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.file_cache import remembered
from reactive_realizer.liveliness.movement import PARTS
from reactive_realizer.liveliness.prosody import SpokenWord

_STRESSED: Final = 0.5
"""The least prominence of a word that counts as stressed."""


class BadWordClasses(Fault):
    """A file of word classes that cannot be read."""

    code = "bad-word-classes"
    template = "{file}: {reason}"
    file: str
    reason: str


@dataclass(frozen=True, slots=True)
class WordBehavior:
    """What a speaker does with a word.

    Attributes:
        element: a behavior of BML.
        attributes: those of the element; ``SIDE`` and ``AWAY`` in them stand for a direction.
        amount: its extent, 0 to 1; None for one without.
        rest: whether it lasts until the end of the phrase, not only for the word.
    """

    element: str
    attributes: Mapping[str, str]
    amount: float | None
    rest: bool


@dataclass(frozen=True, slots=True)
class WordClass:
    """Words with which people do the same.

    Attributes:
        name: for readers.
        stressed: whether unstressed words do not count.
        behaviors: what people do.
    """

    name: str
    stressed: bool
    behaviors: tuple[WordBehavior, ...]


@dataclass(frozen=True, slots=True)
class Found:
    """A class that occurs in a phrase.

    Attributes:
        word: the most prominent word of the entry that occurs.
        kind: the class.
    """

    word: SpokenWord
    kind: WordClass


class WordClasses:
    """The classes of a language.

    Args:
        function_words: that are hardly ever stressed.
        classes: with their entries, each a word or several in lowercase; one that begins with ``*`` stands for all
            words that end with the rest. Classes that come first take precedence.
    """

    def __init__(self, function_words: Iterable[str], classes: Iterable[tuple[WordClass, Sequence[str]]]) -> None:
        self.function_words = frozenset(function_words)
        self._entries: defaultdict[str, list[tuple[int, WordClass, list[str]]]] = defaultdict(list)
        self._endings: list[tuple[str, int, WordClass]] = []
        for rank, (kind, entries) in enumerate(classes):
            for words in map(str.split, entries):
                if words[0].startswith("*"):
                    self._endings.append((words[0][1:], rank, kind))
                else:
                    self._entries[words[0]].append((rank, kind, words))

    @classmethod
    def from_toml(cls, text: str) -> Self:
        """Read the format of assets/liveliness/english.toml."""
        table = tomllib.loads(text)
        return cls(table["function_words"], ((_class(each), each["words"]) for each in table["class"]))

    def find(self, words: Sequence[SpokenWord]) -> list[Found]:
        """The classes that occur in a phrase, in the order of precedence, each once, at the first of its words."""
        found: dict[int, Found] = {}
        for rank, kind, entry in self._occurring(words):
            word = max(entry, key=lambda word: word.prominence)
            if rank not in found and (word.prominence >= _STRESSED or not kind.stressed):
                found[rank] = Found(word, kind)
        return [found[rank] for rank in sorted(found)]

    def _occurring(self, words: Sequence[SpokenWord]) -> Iterator[tuple[int, WordClass, Sequence[SpokenWord]]]:
        for index, word in enumerate(words):
            for rank, kind, entry in self._entries.get(word.text, ()):
                spoken = words[index : index + len(entry)]
                if [each.text for each in spoken] == entry:
                    yield rank, kind, spoken
            for ending, rank, kind in self._endings:
                if word.text.endswith(ending):
                    yield rank, kind, [word]


NO_CLASSES: Final = WordClasses((), ())
"""Those of a language that is not known: every word is a content word."""


@remembered
def read_word_classes(path: Path) -> WordClasses:
    """Read a file of word classes.

    Raises:
        RealizerError: "bad-word-classes": it is not TOML, or a key is missing, unknown or has a bad value.
    """
    try:
        return WordClasses.from_toml(path.read_text("utf-8"))
    except (ValueError, TypeError, AttributeError, RecursionError) as problem:
        raise RealizerError(BadWordClasses(file=path.name, reason=str(problem))) from problem
    except KeyError as problem:
        raise RealizerError(BadWordClasses(file=path.name, reason=f"the key {problem} is missing")) from problem


def _class(table: Mapping[str, Any]) -> WordClass:
    return WordClass(table["name"], table.get("stressed", False), tuple(_behavior(each) for each in table["behaviors"]))


def _behavior(table: Mapping[str, Any]) -> WordBehavior:
    """A behavior of a class.

    Raises:
        ValueError: its element is none that movements can have, or its span or its amount is none.
        KeyError: its element or its span is missing.
    """
    own = {name: str(value) for name, value in table.items() if name not in ("element", "span", "amount")}
    element, amount, span = table["element"], table.get("amount"), table["span"]
    if element not in PARTS:
        raise ValueError(f"the element is {element!r}, not one of {', '.join(PARTS)}")
    if span not in ("word", "rest"):
        raise ValueError(f"the span is {span!r}, neither 'word' nor 'rest'")
    if amount is not None and not 0.0 <= amount <= 1.0:
        raise ValueError(f"the amount {amount} is not from 0 to 1")
    return WordBehavior(element, own, amount, span == "rest")
