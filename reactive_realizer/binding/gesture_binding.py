"""Reads GestureBinding files, in AsapRealizer's format, and finds the units that play a behavior (thesis 8.6.1)."""

import logging
import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path

from lxml import etree

from reactive_realizer.binding.class_names import unit_id
from reactive_realizer.binding.unit_spec import UnitSpec, comparable
from reactive_realizer.binding.xml_file import Element, attribute, bad, read_xml
from reactive_realizer.bml.elements import ELEMENTS
from reactive_realizer.bml.names import BML
from reactive_realizer.bml.words import StanceType
from reactive_realizer.errors import RealizerError
from reactive_realizer.limits import Limits

_log = logging.getLogger(__name__)

_HANDS = "mode"
"""The attribute that says which hands; a behavior that does not leaves it to the realizer."""

_LEXEME = "lexeme"
"""The attribute by which most entries are told apart."""

_MOST = 1000
"""Behaviors, as bindings see them, of which it is kept what fits them: most are said again and again."""

_Said = tuple[tuple[str, str], ...]

_Asked = tuple[str, str, str | None]
"""Namespace and name of a behavior's element, and its lexeme if it has one, `comparable`."""


@dataclass(frozen=True, slots=True)
class GestureBinding:
    """The entries of bindings, in order.

    Attributes:
        specs: which unit plays what.
        rest_poses: stance, as BML writes it -> file of the pose that it is at rest.
    """

    specs: tuple[UnitSpec, ...]
    rest_poses: Mapping[str, str]
    _by_lexeme: Mapping[_Asked, list[UnitSpec]] = field(init=False, repr=False)
    _matches: Callable[[str, str, _Said], tuple[UnitSpec, ...]] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "_by_lexeme", _by_lexeme(self.specs))
        object.__setattr__(self, "_matches", lru_cache(_MOST)(self._match))

    @classmethod
    def read(cls, *paths: Path) -> "GestureBinding":
        """The bindings in files, those of earlier files first.

        Raises:
            RealizerError: "bad-asset", with file, line and element.
            OSError: a file cannot be read.
        """
        elements = [element for path in paths for element in read_xml(path, "gesturebinding")]
        for element in elements:
            if element.tag not in (*_SPECS, _REST_POSE):
                raise bad(element, f"known are {', '.join((*_SPECS, _REST_POSE))}")
        poses = (pose for element in elements if element.tag == _REST_POSE for pose in _rest_poses(element))
        return cls(
            tuple(_spec(element, *_SPECS[element.tag]) for element in elements if element.tag in _SPECS),
            dict(reversed(list(poses))),  # of two for one stance the earlier is to hold, as of specs
        )

    def match(self, behavior: str, namespace: str, attributes: Mapping[str, str]) -> tuple[UnitSpec, ...]:
        """The entries that fit a behavior, the best first.

        They are in the order of the files. A behavior that leaves its hands to the realizer may also be played by
        entries for certain hands, which come after the others. For one that names its hands an entry that does not is
        no second choice: it could be for the other hand.

        Args:
            behavior: name of its element.
            namespace: of its element.
            attributes: as `seen`.
        """
        return self._matches(behavior, namespace, tuple(attributes.items()))

    def _match(self, behavior: str, namespace: str, attributes: _Said) -> tuple[UnitSpec, ...]:
        said = comparable(dict(attributes))
        others = self._by_lexeme.get((namespace, behavior, None), ())
        specs = self._by_lexeme.get((namespace, behavior, said.get(_LEXEME)), others)
        exact = [spec for spec in specs if spec.fits(said)]
        if _HANDS in said:
            return (*exact[:1], *(spec for spec in exact[1:] if _HANDS in spec.constraints))
        return (*exact, *(spec for spec in specs if _HANDS in spec.constraints and spec.fits(said, _HANDS)))

    def chooses_by(self, behavior: str, namespace: str) -> frozenset[str]:
        """The attributes that the entries for an element ask for."""
        entries = (spec for spec in self.specs if (spec.behavior, spec.namespace) == (behavior, namespace))
        return frozenset().union(*(spec.constraints for spec in entries))


def _by_lexeme(specs: Iterable[UnitSpec]) -> dict[_Asked, list[UnitSpec]]:
    """For each lexeme the entries that may fit, in order, those for any lexeme too."""
    asked: dict[_Asked, list[UnitSpec]] = {}
    for spec in specs:
        element, lexeme = (spec.namespace, spec.behavior), spec.wanted.get(_LEXEME)
        general = asked.setdefault((*element, None), [])
        if lexeme is not None:
            asked.setdefault((*element, lexeme), [*general]).append(spec)
            continue
        for known, entries in asked.items():
            if known[:2] == element:
                entries.append(spec)
    return asked


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


_SPECS: Mapping[str, tuple[str, str | None]] = {
    "MotionUnitSpec": ("MotionUnit", None),
    "RestGazeSpec": ("RestGaze", "gazeShift"),
}
"""Element of an entry -> the element in it that says what plays, and the behavior, if it is always the same."""

_REST_POSE = "RestPoseSpec"


def _spec(element: Element, part: str, behavior: str | None) -> UnitSpec:
    unit = _part(element, part)
    behavior, namespace = behavior or attribute(element, "type"), element.get("namespace", BML)
    _named(element, namespace, behavior)
    parameter_map = _pairs(element, "parametermap/parameter", "src", "dst")
    defaults = _pairs(element, "parameterdefaults/parameterdefault", "name", "value")
    file = unit.get("file", defaults.pop("file", None))
    if file is None and "class" not in unit.attrib and not {"file", "name"} & set(parameter_map.values()):
        raise bad(unit, "neither a file nor a class")
    kind = attribute(unit, "type")
    return UnitSpec(
        behavior=behavior,
        namespace=namespace,
        constraints=_constraints(element, behavior, namespace),
        unit=unit_id(attribute(unit, "class")) if kind == "class" else kind,
        file=file,
        parameter_map=parameter_map,
        defaults=defaults,
        place=f"{Path(element.base or '').name}, line {element.sourceline}",
    )


def _rest_poses(element: Element) -> Iterator[tuple[str, str]]:
    pose, stance = _part(element, "RestPose"), _pairs(element, "constraints/constraint", "name", "value").get("stance")
    if stance is None or "file" not in pose.attrib:
        _leave_out(element, "no stance or no file")
    elif stance.upper() not in list(StanceType):
        _leave_out(element, f"stance='{stance}': known are {', '.join(StanceType)}")
    else:
        yield stance.upper(), attribute(pose, "file")


def _leave_out(element: Element, reason: str) -> None:
    _log.warning("%s; it is left out", bad(element, reason).fault.sentence)


def _part(element: Element, name: str) -> Element:
    part = element.find(name)
    if part is None:
        raise bad(element, f"no {name} inside")
    return part


def _constraints(element: Element, behavior: str, namespace: str) -> dict[str, str]:
    """As written; words of closed vocabularies in the spelling of BML 1.0."""
    known = ELEMENTS.get(behavior)
    own = {each.name: each.type for each in known.attributes} if known and known.namespace == namespace else {}
    constraints = _pairs(element, "constraints/constraint", "name", "value")
    try:
        return {
            name: str(own[name].read(value, Limits())) if name in own else value for name, value in constraints.items()
        }
    except RealizerError as problem:
        raise bad(element, f"a constraint: {problem.fault.sentence}") from problem


def _pairs(element: Element, path: str, name: str, value: str) -> dict[str, str]:
    return {_qualified(pair, attribute(pair, name)): attribute(pair, value) for pair in element.iterfind(path)}


def _qualified(pair: Element, name: str) -> str:
    namespace = pair.get("namespace")
    return _named(pair, namespace, name) if namespace else name


def _named(element: Element, namespace: str, name: str) -> str:
    """The name as ``{uri}name``, if XML can have it."""
    try:
        return etree.QName(namespace, name).text
    except ValueError as problem:
        raise bad(element, f"'{name}' of '{namespace}' is no name") from problem
