"""The engine of the face (thesis 8.9)."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from reactive_realizer.binding.face_lexemes import read_face_lexemes
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.face import FaceLexeme
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.context import EngineContext
from reactive_realizer.engine.engine import DefaultEngine
from reactive_realizer.engines.face.face_unit import FaceUnit
from reactive_realizer.errors import error
from reactive_realizer.pegboard.peg_key import BlockKey

_LEXEMES = "face/lexemes.json"
_WHILE_SPEAKING = 0.5
"""Share of an expression's mouth that is shown while words need the mouth."""

_FADE = 0.25
"""s in which a face that was cut goes."""


@dataclass(frozen=True, slots=True)
class _Fading:
    weights: Mapping[str, float]
    since: GlobalTime


class FaceEngine(DefaultEngine):
    """Mixes expressions with the mouth of the voice; whoever speaks has the mouth."""

    behaviors = frozenset({FaceLexeme})

    def __init__(self, context: EngineContext) -> None:
        super().__init__(f"{context.character}/face")
        self._lexemes = {_word(name): w for name, w in read_face_lexemes(context.asset(_LEXEMES)).items()}
        self._lip_sync = context.lip_sync
        self._fading: list[_Fading] = []
        self._mouth: Mapping[str, float] = {}

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> FaceUnit:
        """The face that a lexeme means.

        Raises:
            RealizerError: nobody knows the lexeme.
        """
        if not isinstance(behavior, FaceLexeme):
            raise TypeError(behavior)
        weights = self._lexemes.get(_word(behavior.lexeme))
        if weights is None:
            raise error("no-face", lexeme=behavior.lexeme, known=", ".join(self._lexemes))
        return FaceUnit(block, behavior, weights, self._release)

    def face(self, tick: Tick) -> Mapping[str, float]:
        """Weights of morph targets now."""
        mouth = self._spoken(tick.time)
        self._fading = [fading for fading in self._fading if tick.time < fading.since + _FADE]
        shown = self.player.show(FaceUnit, lambda unit: unit.shown(tick.time), tick.time)
        shown += [_faded(fading, tick.time) for fading in self._fading]
        face = _added(shown)
        if mouth:
            face = {m: w * (_WHILE_SPEAKING if m.startswith(("mouth", "jaw")) else 1.0) for m, w in face.items()}
        return _added([face, mouth])

    def _spoken(self, now: GlobalTime) -> Mapping[str, float]:
        """What the voice does with the mouth; where a word is cut, the mouth closes as a face goes."""
        mouth = self._lip_sync.mouth(now) if self._lip_sync else {}
        if self._mouth and not mouth:
            self._fading.append(_Fading(self._mouth, now))
        self._mouth = mouth
        return mouth

    def _release(self, unit: FaceUnit, time: GlobalTime) -> None:
        if unit.level > 0.0:
            self._fading.append(_Fading({m: w * unit.level for m, w in unit.weights.items()}, time))


def _faded(fading: _Fading, now: GlobalTime) -> dict[str, float]:
    left = 1.0 - (now - fading.since) / _FADE
    return {morph: weight * left for morph, weight in fading.weights.items()}


def _added(faces: Sequence[Mapping[str, float]]) -> dict[str, float]:
    total: dict[str, float] = {}
    for face in faces:
        for morph, weight in face.items():
            total[morph] = total.get(morph, 0.0) + weight
    return total


def _word(lexeme: str) -> str:
    return lexeme.upper().replace("-", "_")
