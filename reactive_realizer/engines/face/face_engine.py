"""The engine of the face (thesis 8.8): expressions and the mouth of speech, as weights of morph targets."""

from collections.abc import Collection, Iterator, Mapping

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import Face, FaceFacs, FaceLexeme, FaceShift
from reactive_realizer.bml.extensions import FaceMorph
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.context import EngineContext
from reactive_realizer.engine.engine import DefaultEngine
from reactive_realizer.engine.lexicon import LexiconEntry
from reactive_realizer.engines.face.expressions import Expressions, Weights, added, limited
from reactive_realizer.engines.face.face_mixing import Fades, MouthShare, between, greatest, resting_face_under
from reactive_realizer.engines.face.face_unit import MOUTH_MORPHS, SHIFT_TIMING, TIMING, FaceShiftUnit, FaceUnit
from reactive_realizer.errors import CreationFault, RealizerError
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.plan_unit import PlanUnit

_LEXEMES = "face/lexemes.json"
_UNITS = "face/action_units.json"

_MODERATE = 0.5
"""The amount of a compound face that leaves those of its parts as they are, which is its default."""

_FADE = 0.25
"""Duration of the fade of an interrupted expression, s."""
_MOUTH_FADE = 0.12
"""Duration of the fade of the mouth when a word is cut off, s."""


class NoMorph(CreationFault):
    """The avatar has no morph target with the name."""

    code = "no-morph"
    template = "the avatar has no morph target '{morph}'; available: {known}"
    unknown = "morph"
    morph: str
    known: tuple[str, ...]


class FaceEngine(DefaultEngine):
    """Plays expressions and mixes them with the resting face and the lip sync of the character's speech."""

    behaviors = frozenset({FaceLexeme, FaceFacs, Face, FaceShift, FaceMorph})

    def __init__(self, context: EngineContext) -> None:
        super().__init__(f"{context.character}/face")
        self._expressions = Expressions.read(context.asset(_LEXEMES), context.asset(_UNITS))
        self._morphs = context.humanoid.avatar.morphs
        self._lip_sync = context.lip_sync
        self._share = MouthShare()
        self._resting: Weights = {}
        self._fading_faces = Fades(_FADE)
        self._fading_mouths = Fades(_MOUTH_FADE)
        self._mouth: Mapping[str, float] = {}

    def lexicon(self) -> Iterator[LexiconEntry]:
        """The face lexemes."""
        duration = sum(phase.duration for phase in TIMING.phases)
        return (
            LexiconEntry("faceLexeme", lexeme, sync_points=TIMING.points, duration=duration, file=_LEXEMES)
            for lexeme in self._expressions.names
        )

    def check(self, behavior: Behavior) -> Collection[str]:
        """The points of every face.

        Raises:
            RealizerError: "no-face", "no-action-unit" or "no-morph".
        """
        self._weights(behavior)
        return SHIFT_TIMING.points if isinstance(behavior, FaceShift) else TIMING.points

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> PlanUnit:
        """A unit with the weights of the behavior.

        Raises:
            RealizerError: "no-face", "no-action-unit" or "no-morph".
        """
        weights = self._weights(behavior)
        if isinstance(behavior, FaceShift):
            return FaceShiftUnit(block, behavior, weights, self._rest)
        overshoot = behavior.overshoot if isinstance(behavior, FaceLexeme | Face) else 0.0
        return FaceUnit(block, behavior, weights, overshoot, self._release)

    def face(self, tick: Tick) -> Mapping[str, float]:
        """Weights of morph targets now."""
        now = tick.time
        mouth = self._lip_sync.mouth(now) if self._lip_sync else None
        share = self._share.at(now, speaking=mouth is not None)
        playing = self.player.show(FaceUnit, lambda unit: unit.shown(now), now)
        resting = self._resting
        for shift in self.player.show(FaceShiftUnit, lambda unit: unit.shown(now), now):
            resting = between(resting, shift.weights, shift.share)
        resting = resting_face_under(resting, [(unit.weights, unit.level) for unit in playing])
        faces = [{m: w * unit.level for m, w in unit.weights.items()} for unit in playing]
        face = added([resting, *faces, *self._fading_faces.at(now)])
        face = {m: w * (share if m.startswith(MOUTH_MORPHS) else 1.0) for m, w in face.items()}
        return greatest(face, self._spoken(mouth or {}, now))

    def _weights(self, behavior: Behavior) -> Weights:
        """Those of a behavior at its amount."""
        match behavior:
            case Face():
                parts = [_scaled(self._expressions.weights(part), part.amount) for part in behavior.parts]
                return limited(_scaled(limited(added(parts)), behavior.amount / _MODERATE))
            case FaceLexeme() | FaceFacs():
                return _scaled(self._expressions.weights(behavior), behavior.amount)
            case FaceMorph():
                if behavior.targetname not in self._morphs:
                    raise RealizerError(NoMorph(morph=behavior.targetname, known=self._morphs))
                return {behavior.targetname: behavior.intensity}
            case _:
                raise TypeError(behavior)

    def _spoken(self, mouth: Mapping[str, float], now: GlobalTime) -> dict[str, float]:
        """The mouth of the speech; if a word is cut off, the mouth fades."""
        if self._mouth and not mouth:
            self._fading_mouths.add(self._mouth, now)
        self._mouth = mouth
        return added([mouth, *self._fading_mouths.at(now)])

    def _release(self, unit: FaceUnit, time: GlobalTime) -> None:
        if unit.level > 0.0:
            self._fading_faces.add(_scaled(unit.weights, unit.level), time)

    def _rest(self, shift: FaceShiftUnit) -> None:
        self._resting = between(self._resting, shift.weights, shift.share)


def _scaled(weights: Weights, factor: float) -> dict[str, float]:
    return {morph: factor * weight for morph, weight in weights.items()}
