"""The kinds of face units (thesis 8.8): each makes an expression from its parameters."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import TypeVar

from reactive_realizer.binding.asset_file import asset_error, attribute, number, read_xml
from reactive_realizer.binding.mouth_shapes import MouthShape
from reactive_realizer.binding.viseme_binding import VisemeBinding
from reactive_realizer.bml.attribute_types import Enumeration, Float, Integer
from reactive_realizer.bml.extensions import WHOLE_FACE
from reactive_realizer.bml.vocabulary import Side
from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.face_map import STAND_INS, FaceMap, StandIns
from reactive_realizer.engine.context import EngineContext
from reactive_realizer.engines.face.emotion_wheel import EmotionWheel
from reactive_realizer.engines.face.expressions import Expressions
from reactive_realizer.engines.face.face_timing import FaceShape
from reactive_realizer.engines.face.faps import FapTable
from reactive_realizer.engines.face.greta_faces import GretaFaces
from reactive_realizer.engines.face.weights import Weights, added, limited, scaled
from reactive_realizer.errors import CreationFault, Fault, RealizerError
from reactive_realizer.file_cache import remembered
from reactive_realizer.limits import Limits

T = TypeVar("T")

LEXEMES = "face/lexemes.json"
_UNITS = "face/action_units.json"
_FAPS = "face/faps.json"
_WHEEL = "face/emotion_wheel.json"
_GRETA = "**/facelibrary.xml"
"""The name of a library of faces in Greta."""

_SHARE, _ANGLE, _ACTIVATION, _VALUE = Float(0, 1), Float(0, 360), Float(0, 7), Float()
_MOST_ACTION_UNITS = 999
_SELECTIONS = (
    *("viseme_select1", "viseme_select2", "viseme_blend"),
    *("expression_select1", "expression_intensity1", "expression_select2", "expression_intensity2"),
)
"""The parameters of a face unit that select visemes and expressions of MPEG-4."""


class NoMorph(CreationFault):
    """The avatar has no morph target with the name."""

    code = "no-morph"
    template = "the avatar has no morph target '{morph}'; available: {known}"
    unknown = "morph"
    morph: str
    known: tuple[str, ...]


class BadFaceParameter(CreationFault):
    """A parameter of a face unit that is missing, or has an invalid value."""

    code = "bad-face-parameter"
    template = "the parameter {name} of a face unit {reason}"
    name: str
    reason: str


@dataclass(frozen=True, slots=True)
class FaceParameters:
    """The parameters of a face unit.

    Attributes:
        values: as they are written.
        file: of the unit; None if it has none.
    """

    values: Mapping[str, str]
    file: str | None = None

    @property
    def intensity(self) -> float:
        """The strength, 0 to 1; 1 by default."""
        return self.read("intensity", _SHARE.read, "1")

    def read(self, name: str, read: Callable[[str, Limits], T], default: str | None = None) -> T:
        """A value.

        Raises:
            RealizerError: "bad-face-parameter": it is missing or invalid.
        """
        text = self.values.get(name, default)
        if text is None:
            raise RealizerError(BadFaceParameter(name=name, reason="is missing"))
        try:
            return read(text, Limits())
        except RealizerError as problem:
            raise RealizerError(BadFaceParameter(name=name, reason=_sentence(text, problem.fault))) from problem


@remembered
def _fap_table(path: Path, avatar: Avatar, stand_ins: Path) -> FapTable:
    return FapTable(path, avatar, FaceMap(avatar, StandIns.read(stand_ins)))


@dataclass(frozen=True, slots=True)
class FaceShapes:
    """Makes the faces of one avatar.

    Attributes:
        expressions: lexemes and action units.
        faps: facial animation parameters.
        wheel: of emotions.
        visemes: the mouth shape of each.
        morphs: names of the weights that show in the face.
        asset: finds a file by name.
    """

    expressions: Expressions
    faps: FapTable
    wheel: EmotionWheel
    visemes: Mapping[str, MouthShape]
    morphs: tuple[str, ...]
    asset: Callable[[str], Path]

    @classmethod
    def of(cls, context: EngineContext) -> "FaceShapes":
        """Those of a character, with the tables among its assets.

        Raises:
            RealizerError: "bad-asset": a table has another format; "bad-visemes".
        """
        avatar, face = context.humanoid.avatar, context.humanoid.face
        expressions = Expressions.read(context.asset(LEXEMES), context.asset(_UNITS))
        return cls(
            expressions,
            _fap_table(context.asset(_FAPS), avatar, context.asset(STAND_INS)),
            EmotionWheel.read(context.asset(_WHEEL), expressions.lexemes),
            VisemeBinding.of(face, context.bindings.get("visemes", ()), context.asset, context.speech_binding).shapes,
            face.names,
            context.asset,
        )

    def lexeme(self, parameters: FaceParameters) -> FaceShape:
        """A word.

        Raises:
            RealizerError: "no-face".
        """
        return self.expressions.face(parameters.read("lexeme", _text), parameters.intensity)

    def action_unit(self, parameters: FaceParameters) -> FaceShape:
        """An action unit.

        Raises:
            RealizerError: "no-action-unit".
        """
        unit = self.expressions.unit(parameters.read("au", Integer(0, _MOST_ACTION_UNITS).read))
        side = Side(parameters.read("side", Enumeration(Side).read, Side.BOTH))
        return FaceShape(scaled(unit.weights(side), parameters.intensity), unit.timing)

    def configuration(self, parameters: FaceParameters) -> FaceShape:
        """Several action units, from a file (AsapRealizer's FACSConfiguration).

        Raises:
            RealizerError: "no-asset", "bad-asset" or "no-action-unit".
        """
        if parameters.file is None:
            raise RealizerError(BadFaceParameter(name="filename", reason="is missing"))
        return FaceShape(scaled(self._read_configuration(self.asset(parameters.file)), parameters.intensity))

    def _read_configuration(self, path: Path) -> Weights:
        parts: list[Weights] = []
        for element in read_xml(path, "FACSConfiguration"):
            if element.tag != "AU":
                raise asset_error(element, "known is AU")
            side = element.get("side", "NONE")
            if side not in ("NONE", *Side):
                raise asset_error(element, f"side='{side}': known are NONE, {', '.join(Side)}")
            try:
                unit = self.expressions.unit(int(attribute(element, "number")))
            except (ValueError, RealizerError) as problem:
                raise asset_error(element, f"there is no action unit '{element.get('number')}'") from problem
            parts.append(scaled(unit.weights(Side.BOTH if side == "NONE" else Side(side)), number(element, "value")))
        return limited(added(parts))

    def greta(self, parameters: FaceParameters) -> FaceShape:
        """An expression of a library of Greta.

        Raises:
            RealizerError: "no-asset", "bad-asset" or "not-in-library".
        """
        library = self._greta_faces(parameters.file)
        actions = library.face(parameters.read("lexeme", _text))
        parts = [scaled(self.expressions.unit(each.unit).weights(each.side), each.intensity) for each in actions]
        return FaceShape(scaled(limited(added(parts)), parameters.intensity))

    def greta_names(self, file: str | None) -> tuple[str, ...]:
        """The names of the expressions of a library of Greta.

        Raises:
            RealizerError: "no-asset" or "bad-asset".
        """
        return tuple(self._greta_faces(file).faces)

    def _greta_faces(self, file: str | None) -> GretaFaces:
        return GretaFaces.read(self.asset(file or _GRETA), frozenset(self.expressions.units))

    def morph(self, parameters: FaceParameters) -> FaceShape:
        """A morph target.

        Raises:
            RealizerError: "no-morph".
        """
        return FaceShape({self.known_morph(parameters.read("targetname", _text)): parameters.intensity})

    def known_morph(self, morph: str) -> str:
        """The name of a morph target, if the avatar has it.

        Raises:
            RealizerError: "no-morph".
        """
        if morph not in self.morphs:
            raise RealizerError(NoMorph(morph=morph, known=self.morphs))
        return morph

    def fap(self, parameters: FaceParameters) -> FaceShape:
        """Facial animation parameters: those with values have the same one.

        Raises:
            RealizerError: "no-fap", "fap-without-morph" or "no-face".
        """
        numbers = self.faps.numbers(parameters.read("fap", _text))
        selecting = {number: self.faps.faces(number) for number in numbers if self.faps.faces(number)}
        moving = [number for number in numbers if number not in selecting]
        values = dict.fromkeys(moving, parameters.read("value", _VALUE.read)) if moving else {}
        selected = [_SELECTED[number](self, faces, parameters) for number, faces in selecting.items()]
        return FaceShape(limited(added([self.faps.weights(values), *selected])))

    def _viseme(self, faces: Sequence[str], parameters: FaceParameters) -> Weights:
        """One viseme, or two mixed (ISO/IEC 14496-2, C.2: ``viseme_select1`` and so on)."""
        first, second = (_selected("viseme_select", which, faces, parameters) for which in (1, 2))
        share = _share(parameters, "viseme_blend")
        return added([scaled(self.visemes[first].morphs, share), scaled(self.visemes[second].morphs, 1.0 - share)])

    def _expression(self, faces: Sequence[str], parameters: FaceParameters) -> Weights:
        """Two expressions, each at its intensity (ISO/IEC 14496-2, C.2: ``expression_select1`` and so on)."""
        shown = []
        for which in (1, 2):
            lexeme = _selected("expression_select", which, faces, parameters)
            intensity = _share(parameters, f"expression_intensity{which}")
            shown.append(self.expressions.face(lexeme, intensity).weights)
        return added(shown)

    def emotion(self, parameters: FaceParameters) -> FaceShape:
        """A place on the wheel of emotions."""
        angle, activation = parameters.read("angle", _ANGLE.read), parameters.read("activation", _ACTIVATION.read)
        return FaceShape(self.wheel.weights(angle, activation * parameters.intensity))


_SELECTED: Mapping[int, Callable[[FaceShapes, Sequence[str], FaceParameters], Weights]] = MappingProxyType(
    {1: FaceShapes._viseme, 2: FaceShapes._expression}
)
"""The parameters that select faces, by number."""


def _selected(name: str, which: int, faces: Sequence[str], parameters: FaceParameters) -> str:
    return faces[parameters.read(f"{name}{which}", Integer(0, len(faces) - 1).read, None if which == 1 else "0")]


def _share(parameters: FaceParameters, name: str) -> float:
    return parameters.read(name, Integer(0, WHOLE_FACE).read, str(WHOLE_FACE)) / WHOLE_FACE


@dataclass(frozen=True, slots=True)
class FaceKind:
    """A kind of face unit.

    Attributes:
        parameters: their names.
        make: makes the expression.
        names: of the lexemes in a file that has many; None for other kinds.
    """

    parameters: tuple[str, ...]
    make: Callable[[FaceShapes, FaceParameters], FaceShape]
    names: Callable[[FaceShapes, str | None], tuple[str, ...]] | None = None


KINDS: Mapping[str, FaceKind] = MappingProxyType(
    {
        "Lexeme": FaceKind(("lexeme", "intensity"), FaceShapes.lexeme),
        "AU": FaceKind(("au", "side", "intensity"), FaceShapes.action_unit),
        "FACS": FaceKind(("intensity",), FaceShapes.configuration),
        "GretaFace": FaceKind(("lexeme", "intensity"), FaceShapes.greta, FaceShapes.greta_names),
        "Morph": FaceKind(("targetname", "intensity"), FaceShapes.morph),
        "FAP": FaceKind(("fap", "value", *_SELECTIONS), FaceShapes.fap),
        "Plutchik": FaceKind(("angle", "activation", "intensity"), FaceShapes.emotion),
    }
)
"""The kinds by the ``type`` of a FaceUnit; the names are AsapRealizer's, except for Lexeme, GretaFace and FAP."""


def _text(text: str, limits: Limits) -> str:
    return text


def _sentence(text: str, fault: Fault) -> str:
    return f"is '{text}': {fault.sentence}"
