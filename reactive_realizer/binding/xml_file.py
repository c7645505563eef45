"""XML files that people write for the realizer: read with care, refused by file, line and element."""

import math
from pathlib import Path

from lxml import etree

from reactive_realizer.binding.asset_file import read_bytes
from reactive_realizer.binding.flag import flag
from reactive_realizer.errors import RealizerError, error

Element = etree._Element


def read_xml(path: Path, root: str) -> Element:
    """The root element of an XML file.

    Args:
        path: the file.
        root: name the root element must have.

    Raises:
        RealizerError: "bad-asset": not well-formed, a DOCTYPE, or another root; "asset-too-big".
        OSError: the file cannot be read.
    """
    parser = etree.XMLParser(
        resolve_entities=False, no_network=True, load_dtd=False, huge_tree=False, remove_comments=True, remove_pis=True
    )
    try:
        document = etree.fromstring(read_bytes(path), parser, base_url=path.as_posix())
    except etree.XMLSyntaxError as problem:
        line, _ = problem.position
        raise error("bad-asset", file=path.name, row=line, element=root, reason=problem.msg) from problem
    if document.getroottree().docinfo.internalDTD is not None:
        raise bad(document, "a DOCTYPE is refused")
    if document.tag != root:
        raise bad(document, f"the file should begin with <{root}>")
    return document


def bad(element: Element, reason: str) -> RealizerError:
    """What is wrong with an element, with its file and line."""
    file = Path(element.base or "").name
    # Not the `line` of the fault: that is a place in somebody's BML, this one in a file of ours.
    return error("bad-asset", file=file, row=element.sourceline, element=element.tag, reason=reason)


def attribute(element: Element, name: str) -> str:
    """An attribute that must be there.

    Raises:
        RealizerError: "bad-asset": it is not.
    """
    value = element.get(name)
    if value is None:
        raise bad(element, f"the attribute {name} is missing")
    return value.strip()


def number(element: Element, name: str) -> float:
    """A finite number that must be there.

    Raises:
        RealizerError: "bad-asset": it is missing or no such number.
    """
    text = attribute(element, name)
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise bad(element, f"{name}='{text}' is no number")
    return value


def boolean(element: Element, name: str, otherwise: bool) -> bool:
    """Whether an attribute is true.

    Args:
        element: which may have it.
        name: of the attribute.
        otherwise: what it is where it is not there.

    Raises:
        RealizerError: "bad-asset": it is neither true nor false.
    """
    text = element.get(name)
    try:
        return otherwise if text is None else flag(name, text)
    except RealizerError as problem:
        raise bad(element, problem.fault.sentence) from problem
