"""Reads GestureBinding files, in AsapRealizer's format, and finds the unit that plays a behavior."""

import logging
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from reactive_realizer.binding.xml_file import Element, attribute, bad, read_xml
from reactive_realizer.bml.names import BML

_log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class UnitSpec:
    """One entry of a binding: which behaviors it is for, and what plays them.

    Attributes:
        behavior: name of the behavior's element, such as "gesture".
        namespace: of that element.
        constraints: attribute -> value that a behavior must have; an attribute of another namespace is `{uri}name`.
        unit: kind of the unit that plays it: ProcAnimation (a file as it is), Gesture (a file with preparation and
            retraction), or what another engine knows.
        file: the unit's file, None for a unit without one.
        implementation: name of the unit's implementation, None for a unit that is a file.
        parameter_map: attribute of the behavior -> parameter of the unit.
        defaults: parameter of the unit -> value where the behavior says nothing.
    """

    behavior: str
    namespace: str
    constraints: Mapping[str, str]
    unit: str
    file: str | None
    implementation: str | None
    parameter_map: Mapping[str, str]
    defaults: Mapping[str, str]

    def fits(self, behavior: str, namespace: str, attributes: Mapping[str, str]) -> bool:
        """Whether a behavior meets every constraint; words compare in any case, `_` like `-`."""
        return (
            behavior == self.behavior
            and namespace == self.namespace
            and all(
                name in attributes and _word(attributes[name]) == _word(value)
                for name, value in self.constraints.items()
            )
        )

    def parameters(self, attributes: Mapping[str, str]) -> dict[str, str]:
        """The unit's parameters for a behavior with these attributes: what it says, else the defaults."""
        said = {to: attributes[name] for name, to in self.parameter_map.items() if name in attributes}
        return {**self.defaults, **said}


@dataclass(frozen=True, slots=True)
class GestureBinding:
    """The entries of a binding, in the order of its file."""

    specs: tuple[UnitSpec, ...]

    @classmethod
    def read(cls, path: Path) -> "GestureBinding":
        """The binding in a file; rest poses and rest gazes are logged and left out.

        Raises:
            RealizerError: "bad-asset", with file, line and element.
            OSError: the file cannot be read.
        """
        root = read_xml(path, "gesturebinding")
        for element in root:
            if element.tag in ("RestPoseSpec", "RestGazeSpec"):
                _log.info("%s, line %s: <%s> is not realized", path.name, element.sourceline, element.tag)
            elif element.tag != "MotionUnitSpec":
                raise bad(element, "known are MotionUnitSpec, RestPoseSpec, RestGazeSpec")
        return cls(tuple(_spec(element) for element in root.iterfind("MotionUnitSpec")))

    def match(self, behavior: str, namespace: str, attributes: Mapping[str, str]) -> tuple[UnitSpec, ...]:
        """The entries that fit a behavior, in the order of the file: the first one that can be played plays it.

        Args:
            behavior: name of its element.
            namespace: of its element.
            attributes: as written; those of other namespaces as `{uri}name`.
        """
        return tuple(spec for spec in self.specs if spec.fits(behavior, namespace, attributes))


def numbers(parameters: Mapping[str, str]) -> dict[str, float]:
    """Those parameters that are finite numbers."""
    return dict(_numbers(parameters))


def _numbers(parameters: Mapping[str, str]) -> Iterator[tuple[str, float]]:
    for name, text in parameters.items():
        try:
            value = float(text)
        except ValueError:
            continue
        if math.isfinite(value):
            yield name, value


def _spec(element: Element) -> UnitSpec:
    unit = element.find("MotionUnit")
    if unit is None:
        raise bad(element, "no MotionUnit inside")
    defaults = _pairs(element, "parameterdefaults/parameterdefault", "name", "value")
    file, implementation = unit.get("file", defaults.pop("file", None)), unit.get("class")
    if file is None and implementation is None:
        raise bad(unit, "neither a file nor a class")
    return UnitSpec(
        behavior=attribute(element, "type"),
        namespace=element.get("namespace", BML),
        constraints=_pairs(element, "constraints/constraint", "name", "value"),
        unit=implementation if attribute(unit, "type") == "class" and implementation else attribute(unit, "type"),
        file=file,
        implementation=implementation,
        parameter_map=_pairs(element, "parametermap/parameter", "src", "dst"),
        defaults=defaults,
    )


def _pairs(element: Element, path: str, name: str, value: str) -> dict[str, str]:
    return {_qualified(pair, attribute(pair, name)): attribute(pair, value) for pair in element.iterfind(path)}


def _qualified(pair: Element, name: str) -> str:
    namespace = pair.get("namespace")
    return f"{{{namespace}}}{name}" if namespace else name


@lru_cache
def _word(text: str) -> str:
    return text.strip().casefold().replace("_", "-")
