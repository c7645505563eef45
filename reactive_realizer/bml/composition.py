"""How the word that joins a block to others is written."""

import re
from dataclasses import dataclass
from typing import ClassVar

from reactive_realizer.bml.attribute_types import Names, Word
from reactive_realizer.bml.words import Composition
from reactive_realizer.errors import RealizerError, error
from reactive_realizer.limits import Limits

_AFTER = re.compile(r"\s*(APPEND|CHUNK)[-_]?AFTER\s*\((.*)\)\s*", re.IGNORECASE | re.DOTALL)


@dataclass(frozen=True, slots=True)
class Composed:
    """What a composition says: a word, and the blocks after which it has the block start."""

    composition: Composition = Composition.MERGE
    append_after: tuple[str, ...] = ()
    chunk_after: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class CompositionText:
    """A word of `Composition`, or blocks to wait for: ``APPEND-AFTER(b1,b2)`` (thesis 6.6.8.1), ``CHUNK-AFTER(b1)``."""

    description: ClassVar[str] = f"{Word(Composition).description}, APPEND-AFTER(ids), CHUNK-AFTER(ids)"

    def read(self, text: str, limits: Limits) -> Composed:
        """What is written, in any case, with ``_``, ``-`` or nothing between the parts of a word."""
        after = _AFTER.fullmatch(text)
        if after is not None:
            blocks = Names().read(after[2], limits)
            return Composed(append_after=blocks) if after[1].upper() == "APPEND" else Composed(chunk_after=blocks)
        try:
            return Composed(Composition(str(Word(Composition).read(text, limits))))
        except RealizerError:
            raise error("unknown-word", known=self.description) from None
