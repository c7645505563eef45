"""Reads the entries of bindings in AsapRealizer's format."""

import math
from collections.abc import Iterator, Mapping
from pathlib import Path

from lxml import etree

from reactive_realizer.binding.asset_file import XmlElement, asset_error, attribute, read_xml
from reactive_realizer.binding.unit_spec import UnitSpec
from reactive_realizer.binding.unit_specs import UnitSpecs
from reactive_realizer.bml.elements import ELEMENTS
from reactive_realizer.bml.names import BML
from reactive_realizer.errors import RealizerError
from reactive_realizer.file_cache import remembered
from reactive_realizer.limits import Limits


def finite_numbers(parameters: Mapping[str, str]) -> dict[str, float]:
    """Return the parameters that are finite numbers."""
    return dict(_numbers(parameters))


def _numbers(parameters: Mapping[str, str]) -> Iterator[tuple[str, float]]:
    for name, text in parameters.items():
        try:
            value = float(text)
        except ValueError:
            continue
        if math.isfinite(value):
            yield name, value


@remembered
def read_unit_specs(root: str, unit: str, *paths: Path) -> UnitSpecs:
    """Read binding files of faces or pictures (thesis 8.6.1). Entries of earlier files come first.

    Args:
        root: required name of the root elements.
        unit: name of the elements of units; those of entries end in Spec.
        paths: of the files.

    Raises:
        RealizerError: "bad-asset", with file, line and element.
        OSError: a file cannot be read.
    """
    return UnitSpecs(tuple(spec for path in paths for spec in _specs(path, root, unit)))


def _specs(path: Path, root: str, unit: str) -> Iterator[UnitSpec]:
    inside = ("constraints", "parametermap", "parameterdefaults", unit)
    for element in read_xml(path, root):
        if element.tag != f"{unit}Spec":
            raise asset_error(element, f"known is {unit}Spec")
        for child in element:
            if child.tag not in inside:
                raise asset_error(child, f"known are {', '.join(inside)}")
        played_by = part(element, unit)
        yield read_spec(element, attribute(played_by, "type"), played_by.get("filename"))


def read_spec(element: XmlElement, unit: str, file: str | None, behavior: str | None = None) -> UnitSpec:
    """Return an entry.

    Args:
        element: of the entry.
        unit: id of its unit.
        file: of the unit, unless it is among the defaults of the entry.
        behavior: that it plays; None if the entry names it.

    Raises:
        RealizerError: "bad-asset", with file, line and element.
    """
    behavior, namespace = behavior or attribute(element, "type"), element.get("namespace", BML)
    _named(element, namespace, behavior)
    defaults = pairs(element, "parameterdefaults/parameterdefault", "name", "value")
    default_file = defaults.pop("file", None)
    return UnitSpec(
        behavior=behavior,
        namespace=namespace,
        constraints=_constraints(element, behavior, namespace),
        unit=unit,
        file=default_file if file is None else file,
        parameter_map=pairs(element, "parametermap/parameter", "src", "dst"),
        defaults=defaults,
        location=f"{Path(element.base or '').name}, line {element.sourceline}",
    )


def part(element: XmlElement, name: str) -> XmlElement:
    """Return the child element with a name.

    Raises:
        RealizerError: "bad-asset": there is none.
    """
    found = element.find(name)
    if found is None:
        raise asset_error(element, f"no {name} inside")
    return found


def _constraints(element: XmlElement, behavior: str, namespace: str) -> dict[str, str]:
    """Read the constraints. Values of closed vocabularies get the spelling of BML 1.0."""
    known = ELEMENTS.get(behavior)
    own = {each.name: each.type for each in known.attributes} if known and known.namespace == namespace else {}
    constraints = pairs(element, "constraints/constraint", "name", "value")
    try:
        return {
            name: str(own[name].read(value, Limits())) if name in own else value for name, value in constraints.items()
        }
    except RealizerError as problem:
        raise asset_error(element, f"a constraint: {problem.fault.sentence}") from problem


def pairs(element: XmlElement, path: str, name: str, value: str) -> dict[str, str]:
    """Return two attributes of each element at a path, as names and values.

    Raises:
        RealizerError: "bad-asset": one of them is missing, or a name is invalid.
    """
    return {_qualified(pair, attribute(pair, name)): attribute(pair, value) for pair in element.iterfind(path)}


def _qualified(pair: XmlElement, name: str) -> str:
    namespace = pair.get("namespace")
    return _named(pair, namespace, name) if namespace else name


def _named(element: XmlElement, namespace: str, name: str) -> str:
    """Return the name as ``{uri}name``.

    Raises:
        RealizerError: "bad-asset": XML does not allow the name.
    """
    try:
        return etree.QName(namespace, name).text
    except ValueError as problem:
        raise asset_error(element, f"'{name}' of '{namespace}' is not a valid name") from problem
