"""The pictures that the binding of a character has for behaviors."""

import logging
from collections.abc import Callable, Iterator, Mapping, Sequence
from math import isfinite
from pathlib import Path
from typing import Final, NamedTuple

from reactive_realizer.binding.unit_spec import UnitSpec, behavior_attributes
from reactive_realizer.binding.unit_specs import UnitSpecs
from reactive_realizer.bml.behavior import Behavior, ForeignBehavior
from reactive_realizer.bml.elements import ELEMENTS
from reactive_realizer.bml.names import BML, OWN
from reactive_realizer.engine.lexicon import LexiconEntry
from reactive_realizer.engines.picture.picture_animation import (
    PictureAnimation,
    check_pictures,
    read_animation,
    read_folder,
    still,
)
from reactive_realizer.errors import CreationFault, RealizerError, WarningType

_log = logging.getLogger(__name__)

_SPEECH: Final = "speech"
"""The element whose entries are for the mouth while words sound."""
_REST: Final = "rest"
"""The element of the realizer's namespace, in bindings alone, whose entries are always shown."""
_BACKGROUND: Final = "SetImagePU"


class NoPictureUnit(CreationFault):
    """No kind of picture unit has the name."""

    code = "no-picture-unit"
    template = "there is no picture unit '{unit}'; available: {known}"
    unknown = "unit"
    unit: str
    known: tuple[str, ...]


class NoPictureEntry(CreationFault):
    """No entry of the picture binding fits a behavior."""

    code = "no-picture-entry"
    template = "no entry of the picture binding for <{element}> fits its attributes"
    warning = WarningType.BEHAVIOR_TYPE_NOT_SUPPORTED
    element: str


class NoPictureParameter(CreationFault):
    """A parameter that a picture unit needs is not set."""

    code = "no-picture-parameter"
    template = "its picture unit {unit} needs the parameter {name}"
    unit: str
    name: str


class NotALayer(CreationFault):
    """A layer of pictures that is not a finite number."""

    code = "not-a-layer"
    template = "the layer of pictures must be a number, not '{value}'"
    value: str


class Shown(NamedTuple):
    """The pictures of a behavior.

    Attributes:
        animation: the pictures.
        layer: on which they are shown.
        stays: whether the only picture becomes the background.
    """

    animation: PictureAnimation
    layer: float
    stays: bool


class PictureLibrary:
    """Finds the pictures of one character.

    Args:
        binding: with the entries to choose from.
        asset: finds a file by name.
        folder: returns the names of the files in a folder.
    """

    def __init__(
        self, binding: UnitSpecs, asset: Callable[[str], Path], folder: Callable[[str], Sequence[str]]
    ) -> None:
        self._binding = binding
        self._asset = asset
        self._folder = folder
        # Sequences whose pictures were found; to look for hundreds of files takes milliseconds.
        self._checked: dict[Path, PictureAnimation] = {}
        self._kinds: Mapping[str, Callable[[_Parameters], PictureAnimation]] = {
            "AddAnimationDirPU": self._of_folder,
            "AddAnimationXMLPU": self._of_file,
            "AddImagePU": self._single,
            _BACKGROUND: self._single,
        }

    def binds(self, behavior: Behavior) -> bool:
        """Return whether any entry plays the element of a behavior; those for speech are for the mouth."""
        return behavior.name != _SPEECH and self._binding.binds(behavior)

    def behaviors(self) -> frozenset[type[Behavior]]:
        """Return the kinds of behaviors that have entries."""
        bound = {(entry.namespace, entry.behavior) for entry in self._binding.specs if entry.behavior != _SPEECH}
        known = {(each.namespace, name): each.behavior for name, each in ELEMENTS.items()}
        return frozenset(known.get(element, ForeignBehavior) for element in bound)

    def lexicon(self) -> Iterator[LexiconEntry]:
        """Yield the lexemes of entries."""
        for entry in self._binding.specs:
            lexeme = entry.constraints.get("lexeme")
            if lexeme is None:
                continue
            try:
                points = self._shown(entry, entry.defaults).animation.points
            except RealizerError as problem:
                yield LexiconEntry(entry.behavior, lexeme, problem=problem.fault.sentence)
            else:
                yield LexiconEntry(entry.behavior, lexeme, sync_points=tuple(points), duration=points["end"])

    def pictures(self, behavior: Behavior) -> Shown:
        """Return the pictures for a behavior, from the first entry that fits.

        Raises:
            RealizerError: no entry fits, or its pictures cannot be used.
        """
        attributes = behavior_attributes(behavior)
        entry = next(iter(self._binding.match(behavior.name, behavior.namespace, attributes)), None)
        if entry is None:
            raise RealizerError(NoPictureEntry(element=behavior.name))
        return self._shown(entry, entry.parameters(attributes))

    def mouth(self) -> list[Shown]:
        """Return the pictures that are repeated while words of the character sound."""
        return self._lasting(BML, _SPEECH)

    def at_rest(self) -> list[Shown]:
        """Return the pictures that are repeated all the time."""
        return self._lasting(OWN, _REST)

    def _lasting(self, namespace: str, element: str) -> list[Shown]:
        """Return the pictures of entries that play no behavior. What cannot be used is logged."""
        shown: list[Shown] = []
        for entry in self._binding.match(element, namespace, {}):
            try:
                shown.append(self._shown(entry, entry.defaults))
            except RealizerError as problem:
                _log.warning("%s: this entry is skipped: %s", entry.location, problem.fault.sentence)
        return shown

    def _shown(self, entry: UnitSpec, values: Mapping[str, str]) -> Shown:
        make = self._kinds.get(entry.unit)
        if make is None:
            raise RealizerError(NoPictureUnit(unit=entry.unit, known=tuple(self._kinds)))
        animation = make(_Parameters(entry.unit, values))
        return Shown(animation, _layer(values.get("layer", "0")), entry.unit == _BACKGROUND)

    def _single(self, parameters: "_Parameters") -> PictureAnimation:
        file = parameters.path("filePath", "fileName")
        check_pictures([file], self._asset)
        return still(file)

    def _of_file(self, parameters: "_Parameters") -> PictureAnimation:
        path = self._asset(parameters.path("filePath", "fileName"))
        animation = read_animation(path)
        if self._checked.get(path) is not animation:
            check_pictures(animation.files, self._asset)
            self._checked[path] = animation
        return animation

    def _of_folder(self, parameters: "_Parameters") -> PictureAnimation:
        name = parameters.path("resourcePath", "directoryName")
        return read_folder(name, self._folder(name))


class _Parameters:
    """The parameters of a unit."""

    def __init__(self, unit: str, values: Mapping[str, str]) -> None:
        self._unit = unit
        self._values = values

    def path(self, folder: str, name: str) -> str:
        """Return a name in a folder; the parameter of the folder may be missing."""
        if name not in self._values:
            raise RealizerError(NoPictureParameter(unit=self._unit, name=name))
        return "/".join(filter(None, (self._values.get(folder, "").strip("/"), self._values[name].strip("/"))))


def _layer(text: str) -> float:
    try:
        layer = float(text)
    except ValueError as problem:
        raise RealizerError(NotALayer(value=text)) from problem
    if not isfinite(layer):
        raise RealizerError(NotALayer(value=text))
    return layer
