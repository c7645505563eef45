"""Reads face bindings in AsapRealizer's format (thesis 8.6.1): which face unit plays which behavior."""

from dataclasses import dataclass
from pathlib import Path

from reactive_realizer.binding.asset_file import XmlElement, asset_error, attribute, read_xml
from reactive_realizer.binding.spec_reader import part, read_spec
from reactive_realizer.binding.unit_spec import UnitSpec
from reactive_realizer.binding.unit_specs import UnitSpecs
from reactive_realizer.file_cache import remembered

_ENTRY = "FaceUnitSpec"
_UNIT = "FaceUnit"
_INSIDE = ("constraints", "parametermap", "parameterdefaults", _UNIT)


@dataclass(frozen=True, slots=True)
class FaceBinding(UnitSpecs):
    """The entries of one or more face bindings, in order."""

    @staticmethod
    @remembered
    def read(*paths: Path) -> "FaceBinding":
        """Read binding files. Entries of earlier files come first.

        Raises:
            RealizerError: "bad-asset", with file, line and element.
            OSError: a file cannot be read.
        """
        return FaceBinding(tuple(_spec(element) for path in paths for element in read_xml(path, "facebinding")))


def _spec(element: XmlElement) -> UnitSpec:
    if element.tag != _ENTRY:
        raise asset_error(element, f"known is {_ENTRY}")
    for child in element:
        if child.tag not in _INSIDE:
            raise asset_error(child, f"known are {', '.join(_INSIDE)}")
    unit = part(element, _UNIT)
    return read_spec(element, attribute(unit, "type"), unit.get("filename"))
