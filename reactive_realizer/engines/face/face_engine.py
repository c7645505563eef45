"""The engine of the face (thesis 8.9)."""

from collections.abc import Iterator, Mapping, Sequence

from reactive_realizer.binding.face_lexemes import read_face_lexemes
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.face import FaceLexeme
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.context import EngineContext
from reactive_realizer.engine.engine import DefaultEngine
from reactive_realizer.engine.lexicon import Word
from reactive_realizer.engines.face.face_unit import TIMING, FaceUnit
from reactive_realizer.engines.face.fadings import Fadings
from reactive_realizer.engines.face.mouth_share import MouthShare
from reactive_realizer.errors import error
from reactive_realizer.pegboard.peg_key import BlockKey

_LEXEMES = "face/lexemes.json"


class FaceEngine(DefaultEngine):
    """Mixes expressions with the mouth of the voice; whoever speaks has the mouth."""

    behaviors = frozenset({FaceLexeme})

    def __init__(self, context: EngineContext) -> None:
        super().__init__(f"{context.character}/face")
        self._lexemes = {_word(name): w for name, w in read_face_lexemes(context.asset(_LEXEMES)).items()}
        self._lip_sync = context.lip_sync
        self._share = MouthShare()
        self._faces = Fadings()
        self._mouths = Fadings()
        self._mouth: Mapping[str, float] = {}

    def words(self) -> Iterator[Word]:
        """The faces it knows."""
        duration = sum(phase.duration for phase in TIMING.phases)
        return (
            Word("faceLexeme", lexeme, sync_points=TIMING.points, duration=duration, file=_LEXEMES)
            for lexeme in self._lexemes
        )

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
        mouth = self._lip_sync.mouth(tick.time) if self._lip_sync else None
        share = self._share.at(tick.time, mouth is not None)
        shown = self.player.show(FaceUnit, lambda unit: unit.shown(tick.time), tick.time)
        face = _added(shown + self._faces.shown(tick.time))
        face = {m: w * (share if m.startswith(("mouth", "jaw")) else 1.0) for m, w in face.items()}
        spoken = self._spoken(mouth or {}, tick.time)
        # The more of the two, not both: lips that smile need not be spread once more for an "ee".
        return {m: max(face.get(m, 0.0), spoken.get(m, 0.0)) for m in face | spoken}

    def _spoken(self, mouth: Mapping[str, float], now: GlobalTime) -> dict[str, float]:
        """What the voice does with the mouth; where a word is cut, the mouth closes as a face goes."""
        if self._mouth and not mouth:
            self._mouths.add(self._mouth, now)
        self._mouth = mouth
        return _added([mouth, *self._mouths.shown(now)])

    def _release(self, unit: FaceUnit, time: GlobalTime) -> None:
        if unit.level > 0.0:
            self._faces.add({m: w * unit.level for m, w in unit.weights.items()}, time)


def _added(faces: Sequence[Mapping[str, float]]) -> dict[str, float]:
    total: dict[str, float] = {}
    for face in faces:
        for morph, weight in face.items():
            total[morph] = total.get(morph, 0.0) + weight
    return total


def _word(lexeme: str) -> str:
    return lexeme.upper().replace("-", "_")
