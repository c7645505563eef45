"""Namespaces, reserved ids, and places in a document."""

from dataclasses import dataclass
from functools import lru_cache
from typing import Final

from lxml import etree

BML: Final = "http://www.bml-initiative.org/bml/bml-1.0"
"""BML 1.0 core."""
BML_EXT: Final = "http://www.bml-initiative.org/bml/coreextensions-1.0"
"""BML 1.0 core extensions (faceFacs)."""
BMLA: Final = "http://www.asap-project.org/bmla"
"""Behavior for continuous interaction, of AsapRealizer."""
BMLT: Final = "http://hmi.ewi.utwente.nl/bmlt"
"""Twente's extensions, of Elckerlyc."""
CONTINUOUS: Final = (BMLA, BMLT)
"""The namespaces of continuous interaction: what both name means the same in either."""
OWN: Final = "urn:reactive-realizer:1"
"""What this realizer adds."""

BLOCK: Final = "bml"
"""The reserved id by which a reference names a block itself, and a warning a block whose id could not be read."""
ANTICIPATORS: Final = "anticipators"
"""The reserved block id of references to anticipators: ``anticipators:metronome:tick3``."""

_NO_SYNC_IDS: Final = frozenset({"id", "xmlns"})


@lru_cache(1000)
def is_sync_id(name: str) -> bool:
    """Whether an element can tell a sync point by an attribute of its name: an NCName (Namespaces in XML 1.0, 7).

    But for its own id, and for `xmlns`, which is no attribute.
    """
    try:
        return name not in _NO_SYNC_IDS and etree.QName(name).text == etree.QName(name).localname
    except ValueError:
        return False


@dataclass(frozen=True, slots=True, order=True)
class Location:
    """Where a start tag begins: line and column in characters, both from 1."""

    line: int
    column: int

    def after(self, text: str) -> "Location":
        """Where one is when `text` has been read from here; its newlines are line feeds."""
        lines, newline, last = text.rpartition("\n")
        if not newline:
            return Location(self.line, self.column + len(text))
        return Location(self.line + lines.count("\n") + 1, len(last) + 1)
