"""Namespaces, reserved ids, and locations in a document."""

from dataclasses import dataclass
from functools import lru_cache
from typing import Final

from lxml import etree

BML: Final = "http://www.bml-initiative.org/bml/bml-1.0"
"""BML 1.0 core."""
BML_EXT: Final = "http://www.bml-initiative.org/bml/coreextensions-1.0"
"""Core extensions of BML 1.0 (faceFacs)."""
BMLA: Final = "http://www.asap-project.org/bmla"
"""BMLA: continuous interaction, of AsapRealizer."""
BMLT: Final = "http://hmi.ewi.utwente.nl/bmlt"
"""BMLT: the extensions of Elckerlyc, from Twente."""
BMLIS: Final = "http://www.asap-project.org/bmlis"
"""BMLIS: incremental speech, of AsapRealizer."""
CONTINUOUS: Final = (BMLA, BMLT)
"""The namespaces of continuous interaction; a name that both have means the same in both."""
SBM: Final = "urn:smartbody"
"""What the prefix of SmartBody's own elements and attributes stands for, which no script declares."""
MURML: Final = "http://www.techfak.uni-bielefeld.de/ags/soa/murml"
"""MURML, the gesture language of ACE and AsapRealizer."""
OWN: Final = "urn:reactive-realizer:1"
"""The extensions of this realizer."""

BLOCK: Final = "bml"
"""Reserved id: in a reference the block itself, in a warning a block whose id could not be read."""
ANTICIPATORS: Final = "anticipators"
"""Reserved block id of references to anticipators: ``anticipators:metronome:tick3``."""
EVENTS: Final = "events"
"""Reserved id of the anticipator whose points are emitted events: ``anticipators:events:go``."""

_NO_SYNC_IDS: Final = frozenset({"id", "xmlns"})


_LONGEST_KEPT = 100
"""Characters of the longest names that are remembered; a client may send longer ones."""


def is_sync_id(name: str) -> bool:
    """Whether an attribute of an element can have the name of a sync point: an NCName (Namespaces in XML 1.0, 7).

    Its own id is excluded, and `xmlns`, which is not an attribute.
    """
    return _is_ncname(name) if len(name) <= _LONGEST_KEPT else _is_ncname.__wrapped__(name)


@lru_cache(1000)
def _is_ncname(name: str) -> bool:
    try:
        return name not in _NO_SYNC_IDS and etree.QName(name).text == etree.QName(name).localname
    except ValueError:
        return False


@dataclass(frozen=True, slots=True, order=True)
class Location:
    """The location of a start tag: line and column in characters, both from 1."""

    line: int
    column: int

    def after(self, text: str) -> "Location":
        """The location after `text`, read from here; its newlines are line feeds."""
        lines, newline, last = text.rpartition("\n")
        if not newline:
            return Location(self.line, self.column + len(text))
        return Location(self.line + lines.count("\n") + 1, len(last) + 1)
