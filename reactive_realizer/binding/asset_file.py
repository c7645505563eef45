"""Finds and reads asset files. Errors in XML files name the file, line and element."""

import math
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import cast

from lxml import etree

from reactive_realizer.binding.faults import AssetTooBig, BadAsset, NoAsset, NotABoolean
from reactive_realizer.bml.attribute_types import Boolean
from reactive_realizer.bml.names import is_sync_id
from reactive_realizer.errors import RealizerError
from reactive_realizer.limits import Limits

_BOOLEAN, _LIMITS = Boolean(), Limits()

LARGEST = 8 * 1024 * 1024
"""Size limit of one file, bytes: several minutes of captured motion."""


def read_bytes(path: Path) -> bytes:
    """Return the content of a file.

    Raises:
        RealizerError: "asset-too-big": the file is over the limit and was not read.
        OSError: the file cannot be read.
    """
    size = path.stat().st_size
    if size > LARGEST:
        raise RealizerError(AssetTooBig(file=path.name, size=size, limit=LARGEST))
    return path.read_bytes()


def first_asset(asset: Callable[[str], Path], *names: str) -> Path:
    """Return the first of several files that exists.

    Args:
        asset: finds a file by name.
        names: one or more names, in order of preference.

    Raises:
        RealizerError: "no-asset": none of the files exists (the error names them all), or a name is invalid.
    """
    missing: list[NoAsset] = []
    for name in names:
        try:
            return asset(name)
        except RealizerError as problem:
            if not isinstance(problem.fault, NoAsset):
                raise
            missing.append(problem.fault)
    fault = NoAsset(
        name="' or '".join(each.name for each in missing),
        files=tuple(file for each in missing for file in each.files),
        known=tuple(dict.fromkeys(name for each in missing for name in each.known)),
    )
    raise RealizerError(fault)


def parse_boolean(name: str, text: str) -> bool:
    """Parse a boolean as BML attributes spell it.

    Args:
        name: of the value, for messages.
        text: the value.

    Raises:
        RealizerError: "not-a-flag": the value is neither true nor false.
    """
    try:
        return _BOOLEAN.read(text, _LIMITS)
    except RealizerError as problem:
        raise RealizerError(NotABoolean(name=name, value=text)) from problem


XmlElement = etree._Element


def read_xml(path: Path, root: str, namespace: str = "") -> XmlElement:
    """Return the root element of an XML file.

    Args:
        path: of the file.
        root: required name of the root element.
        namespace: that it may have.

    Raises:
        RealizerError: "bad-asset": the file is not well-formed, has a DOCTYPE, or has another root; "asset-too-big".
        OSError: the file cannot be read.
    """
    parser = etree.XMLParser(
        resolve_entities=False, no_network=True, load_dtd=False, huge_tree=False, remove_comments=True, remove_pis=True
    )
    try:
        document = etree.fromstring(read_bytes(path), parser, base_url=path.as_posix())
    except etree.XMLSyntaxError as problem:
        line, _ = problem.position
        raise RealizerError(BadAsset(file=path.name, row=line, element=root, reason=problem.msg)) from problem
    if document.getroottree().docinfo.internalDTD is not None:
        raise asset_error(document, "a DOCTYPE is refused")
    if document.tag not in (root, f"{{{namespace}}}{root}"):
        raise asset_error(document, f"the file should begin with <{root}>")
    return document


def asset_error(element: XmlElement, reason: str) -> RealizerError:
    """Return an error about an element, with its file and line."""
    file = Path(element.base or "").name
    # `Fault.line` is a line of a BML block; this is a line of an asset.
    row = cast("int | None", element.sourceline)
    return RealizerError(BadAsset(file=file, row=row, element=str(element.tag), reason=reason))


def attribute(element: XmlElement, name: str) -> str:
    """Return a required attribute.

    Raises:
        RealizerError: "bad-asset": it is missing.
    """
    value = element.get(name)
    if value is None:
        raise asset_error(element, f"the attribute {name} is missing")
    return value.strip()


def number(element: XmlElement, name: str) -> float:
    """Return a required attribute that is a finite number.

    Raises:
        RealizerError: "bad-asset": it is missing, or not a finite number.
    """
    text = attribute(element, name)
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise asset_error(element, f"{name}='{text}' is not a number")
    return value


def boolean(element: XmlElement, name: str, default: bool) -> bool:
    """Return an optional boolean attribute.

    Args:
        element: that may have the attribute.
        name: of the attribute.
        default: the value if the attribute is missing.

    Raises:
        RealizerError: "bad-asset": it is neither true nor false.
    """
    text = element.get(name)
    try:
        return default if text is None else parse_boolean(name, text)
    except RealizerError as problem:
        raise asset_error(element, problem.fault.sentence) from problem


ENDS: Mapping[str, float] = MappingProxyType({"start": 0.0, "end": 1.0})
"""The sync points that every motion has, and their phases."""


def sync_id(element: XmlElement, key: str = "id") -> str:
    """Return the sync point that an element defines. References and feedback use it.

    Args:
        element: such as a KeyPosition.
        key: the attribute with the name of the sync point.

    Raises:
        RealizerError: "bad-asset": there is no such attribute, or it is not a valid sync id (`is_sync_id`).
    """
    name = attribute(element, key)
    if not is_sync_id(name):
        raise asset_error(
            element,
            f"{key}='{name}' cannot name a sync point: it must be a valid attribute name other than id and xmlns",
        )
    return name


def by_sync_id(elements: Iterable[XmlElement], key: str = "id") -> dict[str, XmlElement]:
    """Return elements by the sync points that they define.

    Args:
        elements: such as KeyPositions.
        key: the attribute with the name of the sync point.

    Raises:
        RealizerError: "bad-asset": a name is missing, invalid or used twice.
    """
    found: dict[str, XmlElement] = {}
    for element in elements:
        name = sync_id(element, key)
        if name in found:
            raise asset_error(element, f"a second {element.tag} with {key}='{name}'")
        found[name] = element
    return found


def is_placed(sync: str, phase: float) -> bool:
    """Return whether a sync point may be at a phase: any from 0 to 1, but "start" only at 0 and "end" only at 1."""
    return 0.0 <= phase <= 1.0 and phase == ENDS.get(sync, phase)
