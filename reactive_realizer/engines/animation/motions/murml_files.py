"""Reads murml-descriptions in files and in bindings."""

from functools import lru_cache
from pathlib import Path
from typing import NamedTuple, cast

from lxml import etree

from reactive_realizer.binding.asset_file import XmlElement, read_xml
from reactive_realizer.binding.faults import BadAsset
from reactive_realizer.bml.murml.behaviors import DESCRIPTION
from reactive_realizer.bml.murml.description import MurmlDescription, Scope
from reactive_realizer.bml.murml.reader import MurmlReader
from reactive_realizer.bml.names import MURML, Location
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.limits import Limits


class MurmlAsset(NamedTuple):
    """A description that is no part of a BML block.

    Attributes:
        description: what it means.
        notes: faults of what is left out.
    """

    description: MurmlDescription
    notes: tuple[Fault, ...]


def read_murml_file(path: Path, scope: Scope) -> MurmlAsset:
    """Return the description of a file; changed files are read again.

    Args:
        path: of the file.
        scope: the arm of movements that name none.

    Raises:
        RealizerError: "bad-asset", with file, line and reason; or the file is too big.
        OSError: the file cannot be read.
    """
    return _read_file(path, path.stat().st_mtime_ns, scope)


@lru_cache(256)
def _read_file(path: Path, changed: int, scope: Scope) -> MurmlAsset:
    return _read(read_xml(path, DESCRIPTION, MURML), path.name, scope)


@lru_cache(256)
def read_murml_text(text: str, name: str, scope: Scope) -> MurmlAsset:
    """Return the description in XML.

    Args:
        text: of its element.
        name: for messages.
        scope: the arm of movements that name none.

    Raises:
        RealizerError: "bad-asset", with name, line in the text, and reason.
    """
    return _read(etree.fromstring(text), name, scope)


def _read(element: XmlElement, file: str, scope: Scope) -> MurmlAsset:
    reader = MurmlReader(lambda tree: Location(cast("int", tree.sourceline), 1), scope, Limits())
    try:
        description = reader.read(element)
    except RealizerError as refused:
        raise RealizerError(_in_file(refused.fault, file)) from None
    return MurmlAsset(description, tuple(_in_file(note, file) for note in reader.notes))


def _in_file(fault: Fault, file: str) -> Fault:
    """Return a fault with a line of an asset, which is none of a BML block."""
    return BadAsset(file=file, row=fault.line, element=DESCRIPTION, reason=fault.sentence)
