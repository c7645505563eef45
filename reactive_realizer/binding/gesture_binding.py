"""Reads gesture bindings in AsapRealizer's format, and finds the units that can play a behavior (thesis 8.6.1)."""

import logging
import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path

from lxml import etree

from reactive_realizer.binding.asset_file import XmlElement, asset_error, attribute, read_xml
from reactive_realizer.binding.unit_spec import UnitSpec, normalized, unit_id
from reactive_realizer.bml.elements import ELEMENTS
from reactive_realizer.bml.names import BML
from reactive_realizer.bml.vocabulary import StanceType
from reactive_realizer.errors import RealizerError
from reactive_realizer.limits import Limits

_log = logging.getLogger(__name__)

_MODE = "mode"
"""The attribute that selects the hands. If a behavior omits it, the realizer chooses the hands."""

_LEXEME = "lexeme"
"""The attribute in which most entries differ."""

_CONTROLLER = "PhysicalController"
"""The kind of unit whose class is a parameter."""

_CACHE_SIZE = 1000
"""Number of cached matches. Most behaviors are repeated often."""
_LONGEST_KEPT = 1000
"""Characters of the attributes for which the matches are remembered; a client may send more."""

_Attributes = tuple[tuple[str, str], ...]

_LexemeKey = tuple[str, str, str | None]
"""Namespace and name of an element, and its `normalized` lexeme or None."""


@dataclass(frozen=True, slots=True)
class GestureBinding:
    """The entries of one or more binding files, in order.

    Attributes:
        specs: which unit plays which behaviors.
        rest_poses: stance, as BML spells it -> file of its rest pose.
    """

    specs: tuple[UnitSpec, ...]
    rest_poses: Mapping[str, str]
    _by_lexeme: Mapping[_LexemeKey, list[UnitSpec]] = field(init=False, repr=False)
    _matches: Callable[[str, str, _Attributes], tuple[UnitSpec, ...]] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "_by_lexeme", _by_lexeme(self.specs))
        object.__setattr__(self, "_matches", lru_cache(_CACHE_SIZE)(self._match))

    @classmethod
    def read(cls, *paths: Path) -> "GestureBinding":
        """Read binding files. Entries of earlier files come first.

        Raises:
            RealizerError: "bad-asset", with file, line and element.
            OSError: a file cannot be read.
        """
        elements = [element for path in paths for element in read_xml(path, "gesturebinding")]
        for element in elements:
            if element.tag not in (*_SPECS, _REST_POSE):
                raise asset_error(element, f"known are {', '.join((*_SPECS, _REST_POSE))}")
        poses = (pose for element in elements if element.tag == _REST_POSE for pose in _rest_poses(element))
        return cls(
            tuple(_spec(element, *_SPECS[element.tag]) for element in elements if element.tag in _SPECS),
            dict(reversed(list(poses))),  # the first pose for a stance wins, as with specs
        )

    def match(self, behavior: str, namespace: str, attributes: Mapping[str, str]) -> tuple[UnitSpec, ...]:
        """Return the entries that fit a behavior, best first.

        Entries keep the order of the files. If the behavior does not name its hands, entries for specific hands also
        match, after all others. If it does, only its best match may leave the hands open: another such entry might use
        the other hand.

        Args:
            behavior: name of its element.
            namespace: of its element.
            attributes: of the behavior (`behavior_attributes`).
        """
        size = sum(len(name) + len(value) for name, value in attributes.items())
        matches = self._matches if size <= _LONGEST_KEPT else self._match
        return matches(behavior, namespace, tuple(attributes.items()))

    def _match(self, behavior: str, namespace: str, attributes: _Attributes) -> tuple[UnitSpec, ...]:
        values = normalized(dict(attributes))
        others = self._by_lexeme.get((namespace, behavior, None), ())
        specs = self._by_lexeme.get((namespace, behavior, values.get(_LEXEME)), others)
        exact = [spec for spec in specs if spec.fits(values)]
        if _MODE in values:
            return (*exact[:1], *(spec for spec in exact[1:] if _MODE in spec.constraints))
        return (*exact, *(spec for spec in specs if _MODE in spec.constraints and spec.fits(values, _MODE)))

    def constrained_values(self, behavior: str, namespace: str) -> Mapping[str, tuple[str, ...]]:
        """Return the attributes that the entries for an element constrain, each with its values in these entries."""
        values: dict[str, dict[str, None]] = {}
        for spec in self.specs:
            if (spec.behavior, spec.namespace) == (behavior, namespace):
                for name, value in spec.constraints.items():
                    values.setdefault(name, {})[value] = None
        return {name: tuple(own) for name, own in values.items()}


def _by_lexeme(specs: Iterable[UnitSpec]) -> dict[_LexemeKey, list[UnitSpec]]:
    """Index the entries by element and lexeme, in order. Entries without a lexeme are listed under every lexeme."""
    index: dict[_LexemeKey, list[UnitSpec]] = {}
    for spec in specs:
        element, lexeme = (spec.namespace, spec.behavior), spec.normalized_constraints.get(_LEXEME)
        general = index.setdefault((*element, None), [])
        if lexeme is not None:
            index.setdefault((*element, lexeme), [*general]).append(spec)
            continue
        for known, entries in index.items():
            if known[:2] == element:
                entries.append(spec)
    return index


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


_SPECS: Mapping[str, tuple[str, str | None]] = {
    "MotionUnitSpec": ("MotionUnit", None),
    "RestGazeSpec": ("RestGaze", "gazeShift"),
}
"""Entry element -> the child element that names the unit, and the behavior if the entry is always for the same one."""

_REST_POSE = "RestPoseSpec"


def _spec(element: XmlElement, part: str, behavior: str | None) -> UnitSpec:
    unit = _part(element, part)
    behavior, namespace = behavior or attribute(element, "type"), element.get("namespace", BML)
    _named(element, namespace, behavior)
    parameter_map = _pairs(element, "parametermap/parameter", "src", "dst")
    defaults = _pairs(element, "parameterdefaults/parameterdefault", "name", "value")
    file = unit.get("file", defaults.pop("file", None))
    if file is None and "class" not in unit.attrib and not {"file", "name"} & set(parameter_map.values()):
        raise asset_error(unit, "neither a file nor a class")
    kind = attribute(unit, "type")
    if kind == _CONTROLLER and "class" in unit.attrib:
        defaults.setdefault("class", attribute(unit, "class"))
    return UnitSpec(
        behavior=behavior,
        namespace=namespace,
        constraints=_constraints(element, behavior, namespace),
        unit=unit_id(attribute(unit, "class")) if kind == "class" else kind,
        file=file,
        parameter_map=parameter_map,
        defaults=defaults,
        location=f"{Path(element.base or '').name}, line {element.sourceline}",
    )


def _rest_poses(element: XmlElement) -> Iterator[tuple[str, str]]:
    pose, stance = _part(element, "RestPose"), _pairs(element, "constraints/constraint", "name", "value").get("stance")
    if stance is None or "file" not in pose.attrib:
        _log_skipped(element, "no stance or no file")
    elif stance.upper() not in list(StanceType):
        _log_skipped(element, f"stance='{stance}': known are {', '.join(StanceType)}")
    else:
        yield stance.upper(), attribute(pose, "file")


def _log_skipped(element: XmlElement, reason: str) -> None:
    _log.warning("%s; it is skipped", asset_error(element, reason).fault.sentence)


def _part(element: XmlElement, name: str) -> XmlElement:
    part = element.find(name)
    if part is None:
        raise asset_error(element, f"no {name} inside")
    return part


def _constraints(element: XmlElement, behavior: str, namespace: str) -> dict[str, str]:
    """Read the constraints. Values of closed vocabularies get the spelling of BML 1.0."""
    known = ELEMENTS.get(behavior)
    own = {each.name: each.type for each in known.attributes} if known and known.namespace == namespace else {}
    constraints = _pairs(element, "constraints/constraint", "name", "value")
    try:
        return {
            name: str(own[name].read(value, Limits())) if name in own else value for name, value in constraints.items()
        }
    except RealizerError as problem:
        raise asset_error(element, f"a constraint: {problem.fault.sentence}") from problem


def _pairs(element: XmlElement, path: str, name: str, value: str) -> dict[str, str]:
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
