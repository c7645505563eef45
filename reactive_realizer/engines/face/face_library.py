"""The faces that the binding of a character has for behaviors."""

import logging
from collections.abc import Iterator, Mapping
from dataclasses import replace

from reactive_realizer.binding.unit_spec import UnitSpec, behavior_attributes
from reactive_realizer.binding.unit_specs import UnitSpecs
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.engine.lexicon import LexiconEntry
from reactive_realizer.engines.face.expressions import NoFace
from reactive_realizer.engines.face.face_shapes import KINDS, LEXEMES, FaceParameters, FaceShapes
from reactive_realizer.engines.face.face_timing import TIMING, FaceShape
from reactive_realizer.errors import CreationFault, Fault, RealizerError
from reactive_realizer.planunit.timing import Timing

_log = logging.getLogger(__name__)

_LEXEME = "lexeme"


class NoFaceUnit(CreationFault):
    """No kind of face unit has the name."""

    code = "no-face-unit"
    template = "there is no face unit '{unit}'; available: {known}"
    unknown = "unit"
    unit: str
    known: tuple[str, ...] = tuple(KINDS)


class FaceLibrary:
    """Makes the faces of one character.

    Attributes:
        binding: with the entries to choose from.
        shapes: the faces of its avatar.
    """

    def __init__(self, binding: UnitSpecs, shapes: FaceShapes) -> None:
        self.binding = binding
        self.shapes = shapes
        self._lexemes = {
            spec.constraints[_LEXEME]: spec for spec in reversed(binding.specs) if _LEXEME in spec.constraints
        }
        self._refused: set[UnitSpec] = set()
        for spec in binding.specs:
            _log_unknown_parameters(spec)

    def face(self, behavior: Behavior) -> FaceShape:
        """The expression for a behavior, from the first entry that fits and can be made.

        Raises:
            RealizerError: there is none; the error of the first one that fits is raised.
        """
        attributes = behavior_attributes(behavior)
        refused: dict[UnitSpec, Fault] = {}
        for spec in self.binding.match(behavior.name, behavior.namespace, attributes):
            try:
                shape = self._made(spec, attributes)
            except RealizerError as problem:
                refused[spec] = problem.fault
            else:
                self._log_refused(refused)
                return shape
        self._log_refused(refused)
        fault = next(iter(refused.values()))
        raise RealizerError(
            replace(fault, known=(*fault.known, *self._lexemes)) if isinstance(fault, NoFace) else fault
        )

    def lexicon(self) -> Iterator[LexiconEntry]:
        """The lexemes: those of the entries, then those in the libraries of others, then those of the table."""
        for lexeme, spec in reversed(self._lexemes.items()):
            try:
                yield _entry(lexeme, spec.file, self._made(spec, spec.constraints).timing)
            except RealizerError as problem:
                yield LexiconEntry(spec.behavior, lexeme, file=spec.file, problem=problem.fault.sentence)
        for spec in self.binding.specs:
            yield from self._in_library(spec)
        for lexeme in self.shapes.expressions.names:
            if lexeme not in self._lexemes:
                yield _entry(lexeme, LEXEMES, self.shapes.expressions.face(lexeme, 1.0).timing)

    def _in_library(self, spec: UnitSpec) -> Iterator[LexiconEntry]:
        """The lexemes of an entry for all those in a file."""
        kind = KINDS.get(spec.unit)
        if kind is None or kind.names is None or _LEXEME in spec.constraints:
            return
        try:
            yield from (_entry(lexeme, spec.file, TIMING) for lexeme in kind.names(self.shapes, spec.file))
        except RealizerError as problem:
            yield LexiconEntry(spec.behavior, "", file=spec.file, problem=problem.fault.sentence)

    def _made(self, spec: UnitSpec, attributes: Mapping[str, str]) -> FaceShape:
        kind = KINDS.get(spec.unit)
        if kind is None:
            raise RealizerError(NoFaceUnit(unit=spec.unit))
        return kind.make(self.shapes, FaceParameters(spec.parameters(attributes), spec.file))

    def _log_refused(self, refused: Mapping[UnitSpec, Fault]) -> None:
        """Log skipped entries, each once."""
        # An entry without constraints does not promise to play every behavior.
        new = [spec for spec in refused if spec.constraints and spec not in self._refused]
        for spec in new:
            _log.warning("%s: this entry is skipped: %s", spec.location, refused[spec].sentence)
        self._refused.update(new)


def _entry(lexeme: str, file: str | None, timing: Timing) -> LexiconEntry:
    return LexiconEntry("faceLexeme", lexeme, sync_points=timing.points, duration=timing.offsets[-1], file=file)


def _log_unknown_parameters(spec: UnitSpec) -> None:
    """Log the parameters of an entry that its face unit does not have."""
    kind = KINDS.get(spec.unit)
    if kind is not None and (names := {*spec.parameter_map.values(), *spec.defaults}.difference(kind.parameters)):
        _log.warning(
            "%s: the face unit %s has no parameter %s; it has %s",
            spec.location,
            spec.unit,
            ", ".join(sorted(names)),
            ", ".join(kind.parameters),
        )
