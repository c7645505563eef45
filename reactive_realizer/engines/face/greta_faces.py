"""Reads libraries of faces of Greta: expressions as action units with intensities.

The format is that of its file ``facelibrary.xml`` (https://github.com/isir/greta).
"""

import logging
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Final, NamedTuple

from reactive_realizer.binding.asset_file import XmlElement, asset_error, attribute, number, read_xml
from reactive_realizer.binding.faults import NotInLibrary
from reactive_realizer.bml.vocabulary import Side
from reactive_realizer.errors import RealizerError
from reactive_realizer.file_cache import remembered

_log = logging.getLogger(__name__)

_UNIT: Final = re.compile(r"AU0*([0-9]{1,3})", re.IGNORECASE)


class GretaAction(NamedTuple):
    """An action unit of an expression.

    Attributes:
        unit: its number.
        intensity: 0 to 1.
        side: of the face.
    """

    unit: int
    intensity: float
    side: Side


@dataclass(frozen=True, slots=True)
class GretaFaces:
    """The expressions of a file.

    Attributes:
        file: its name.
        faces: action units by the name of the expression.
    """

    file: str
    faces: Mapping[str, tuple[GretaAction, ...]]

    @staticmethod
    @remembered
    def read(path: Path, units: frozenset[int]) -> "GretaFaces":
        """Read a file. What cannot be read or shown is left out, and the log says so.

        Args:
            path: of the file.
            units: numbers of the action units that faces have; an expression with none of these is left out.

        Raises:
            RealizerError: "bad-asset": it is no library of faces; "asset-too-big".
            OSError: the file cannot be read.
        """
        faces: dict[str, tuple[GretaAction, ...]] = {}
        lacking: set[int] = set()
        for element in read_xml(path, "facelibrary").iterchildren("expression"):
            try:
                name = attribute(element, "instance")
            except RealizerError as refused:
                _log.warning("%s; it is left out", refused.fault.sentence)
                continue
            actions = tuple(_actions(element))
            shown = tuple(action for action in actions if action.unit in units)
            lacking.update(action.unit for action in actions if action.unit not in units)
            if shown or not len(element):
                faces[name] = shown
        if lacking:
            named = ", ".join(map(str, sorted(lacking)))
            _log.warning("%s: faces do not have these action units, which are left out: %s", path.name, named)
        return GretaFaces(path.name, faces)

    def face(self, name: str) -> tuple[GretaAction, ...]:
        """Return the action units of an expression.

        Args:
            name: its instance, or ``class=instance``; regardless of case.

        Raises:
            RealizerError: "not-in-library".
        """
        word = name.rpartition("=")[2].strip().lower()
        found = next((actions for each, actions in self.faces.items() if each.lower() == word), None)
        if found is None:
            raise RealizerError(NotInLibrary(file=self.file, element="face", name=name, known=tuple(self.faces)))
        return found


def _actions(expression: XmlElement) -> Iterator[GretaAction]:
    for element in expression:
        try:
            yield _action(element)
        except RealizerError as refused:
            _log.warning("%s; it is left out", refused.fault.sentence)


def _action(element: XmlElement) -> GretaAction:
    """Return an action unit.

    Raises:
        RealizerError: "bad-asset".
    """
    if element.tag != "action":
        raise asset_error(element, "known is action")
    named = _UNIT.fullmatch(attribute(element, "name"))
    if named is None:
        raise asset_error(element, f"name='{element.get('name')}' is no action unit, such as AU12")
    intensity = number(element, "intensity") if "intensity" in element.attrib else 1.0
    if not 0.0 <= intensity <= 1.0:
        raise asset_error(element, f"intensity='{intensity:g}' is not from 0 to 1")
    side = element.get("side", Side.BOTH).upper()
    if side not in list(Side):
        raise asset_error(element, f"side='{side}': known are {', '.join(Side)}")
    return GretaAction(int(named[1]), intensity, Side(side))
