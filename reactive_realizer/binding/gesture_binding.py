"""Reads gesture bindings in AsapRealizer's format (thesis 8.6.1)."""

import logging
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from lxml import etree

from reactive_realizer.binding.asset_file import XmlElement, asset_error, attribute, read_xml
from reactive_realizer.binding.spec_reader import pairs, part, read_spec
from reactive_realizer.binding.unit_spec import UnitSpec, unit_id
from reactive_realizer.binding.unit_specs import UnitSpecs
from reactive_realizer.bml.vocabulary import PosePart, StanceType
from reactive_realizer.file_cache import remembered

_log = logging.getLogger(__name__)

_CONTROLLER = "PhysicalController"
"""The kind of unit whose class is a parameter."""

_MURML = "MURML"
"""The kind of unit whose description may be inside."""

MURML_TEXT = "murml-description"
"""Parameter with the description inside a unit, as XML."""

_SPECS: Mapping[str, tuple[str, str | None]] = {
    "MotionUnitSpec": ("MotionUnit", None),
    "TimedMotionUnitSpec": ("TimedMotionUnit", None),
    "RestGazeSpec": ("RestGaze", "gazeShift"),
}
"""Entry element -> the child element that names the unit, and the behavior if the entry is always for the same one."""

_REST_POSE = "RestPoseSpec"

_STANCE = "stance"


@dataclass(frozen=True, slots=True)
class RestPose:
    """The rest pose of a stance, or of a posture that also has other poses.

    Attributes:
        stance: of the posture.
        poses: part of the body -> lexeme, in capitals and with ``_``, of the poses that the posture must have.
        file: with the pose of the whole posture.
    """

    stance: StanceType
    poses: Mapping[PosePart, str]
    file: str


@dataclass(frozen=True, slots=True)
class GestureBinding(UnitSpecs):
    """The entries of one or more gesture bindings, in order.

    Attributes:
        rest_poses: of stances and postures, in order.
    """

    rest_poses: tuple[RestPose, ...]

    @staticmethod
    @remembered
    def read(*paths: Path) -> "GestureBinding":
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
        return GestureBinding(
            tuple(_spec(element, *_SPECS[element.tag]) for element in elements if element.tag in _SPECS),
            tuple(poses),
        )


def _spec(element: XmlElement, name: str, behavior: str | None) -> UnitSpec:
    unit = part(element, name)
    kind = attribute(unit, "type")
    spec = read_spec(
        element, unit_id(attribute(unit, "class")) if kind == "class" else kind, unit.get("file"), behavior
    )
    named = spec.file is not None or "class" in unit.attrib or {"file", "name"} & set(spec.parameter_map.values())
    if not named and not len(unit):
        raise asset_error(unit, "neither a file nor a class")
    if kind == _MURML and len(unit):
        return replace(spec, defaults={MURML_TEXT: etree.tostring(unit[0], encoding="unicode"), **spec.defaults})
    if kind == _CONTROLLER and "class" in unit.attrib:
        return replace(spec, defaults={"class": attribute(unit, "class"), **spec.defaults})
    return spec


def _rest_poses(element: XmlElement) -> Iterator[RestPose]:
    pose, constraints = part(element, "RestPose"), pairs(element, "constraints/constraint", "name", "value")
    values = {name.upper(): value.upper().replace("-", "_") for name, value in constraints.items()}
    stance = values.pop(_STANCE.upper(), None)
    unknown = [name for name in values if name not in list(PosePart)]
    if stance is None or "file" not in pose.attrib:
        _log_skipped(element, "no stance or no file")
    elif stance not in list(StanceType):
        _log_skipped(element, f"stance='{stance}': known are {', '.join(StanceType)}")
    elif unknown:
        _log_skipped(element, f"a constraint on {unknown[0]}: known are {_STANCE}, {', '.join(PosePart)}")
    else:
        poses = {PosePart(name): value for name, value in values.items()}
        yield RestPose(StanceType(stance), poses, attribute(pose, "file"))


def _log_skipped(element: XmlElement, reason: str) -> None:
    _log.warning("%s; it is skipped", asset_error(element, reason).fault.sentence)
