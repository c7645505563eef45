"""The engine of the face (thesis 8.9): expressions and the mouth of speech, as weights of morph targets."""

import json
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

from reactive_realizer.binding.faults import BadAsset
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import FaceLexeme
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.context import EngineContext
from reactive_realizer.engine.engine import DefaultEngine
from reactive_realizer.engine.lexicon import LexiconEntry
from reactive_realizer.errors import CreationFault, RealizerError
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.phase_clock import PhaseClock
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.timing import Phase, PhaseKind, Timing

_LEXEMES = "face/lexemes.json"
_MOUTH = "mouth"
_MOUTH_MORPHS = ("mouth", "jaw")
"""Prefixes of the names of the morph targets that speech moves."""

_PHASES = {"start": 0.0, "attackPeak": 1.0, "relax": 2.0, "end": 3.0}
_TIMING = Timing(tuple(_PHASES), (Phase(0.5), Phase(1.0, PhaseKind.HOLD), Phase(0.5)))
"""The attack and the decay take a quarter each of the preferred two seconds."""

_FADE = 0.25
"""Duration of the fade of an interrupted expression, s."""

SHARE_WHILE_SPEAKING = 0.5
"""The share of an expression's mouth that is shown during speech."""

_SHARE_CHANGE = 0.15
"""Time in which the share changes from 1 to `SHARE_WHILE_SPEAKING`, or back, s."""


class NoFace(CreationFault):
    """No face lexeme has the name."""

    code = "no-face"
    template = "there is no face lexeme '{lexeme}'; available: {known}"
    unknown = "lexeme"
    lexeme: str
    known: tuple[str, ...]


class FaceUnit(PlanUnit):
    """An expression: attack, hold and decay.

    Attributes:
        weights: of morph targets at full strength, 0..1.
        level: the factor of these weights in the last frame.
    """

    def __init__(
        self,
        block: BlockKey,
        behavior: FaceLexeme,
        weights: Mapping[str, float],
        released: Callable[["FaceUnit", GlobalTime], None],
    ) -> None:
        mouth = any(morph.startswith(_MOUTH_MORPHS) for morph in weights)
        super().__init__(block, behavior, _TIMING, frozenset({_MOUTH} if mouth else ()))
        self.weights = weights
        self.level = 0.0
        self._amount, self._overshoot = behavior.amount, behavior.overshoot
        self._clock = PhaseClock(_PHASES)
        self._released = released

    def on_finish(self, time: GlobalTime) -> None:
        """Hands over the weights that are still shown, which then fade."""
        self._released(self, time)

    def shown(self, now: GlobalTime) -> dict[str, float]:
        """Weights of morph targets now."""
        self.level = self._level(self._clock.advance(self, now))
        return {morph: weight * self.level for morph, weight in self.weights.items()}

    def _level(self, phase: float) -> float:
        """The factor of the weights at a phase; BML 1.0's overshoot raises it at the attack peak."""
        peak = self._amount * (1.0 + self._overshoot)
        if phase < 1.0:
            return peak * _eased(phase)
        if phase < 2.0:
            return peak + (self._amount - peak) * _eased(phase - 1.0)
        return self._amount * (1.0 - _eased(phase - 2.0))


class FaceEngine(DefaultEngine):
    """Plays expressions and mixes them with the lip sync of the character's speech."""

    behaviors = frozenset({FaceLexeme})

    def __init__(self, context: EngineContext) -> None:
        super().__init__(f"{context.character}/face")
        self._lexemes = {_word(name): w for name, w in read_face_lexemes(context.asset(_LEXEMES)).items()}
        self._lip_sync = context.lip_sync
        self._share = _MouthShare()
        self._fading_faces = _Fades()
        self._fading_mouths = _Fades()
        self._mouth: Mapping[str, float] = {}

    def lexicon(self) -> Iterator[LexiconEntry]:
        """The face lexemes."""
        duration = sum(phase.duration for phase in _TIMING.phases)
        return (
            LexiconEntry("faceLexeme", lexeme, sync_points=_TIMING.points, duration=duration, file=_LEXEMES)
            for lexeme in self._lexemes
        )

    def check(self, behavior: Behavior) -> Collection[str]:
        """The points of every face.

        Raises:
            RealizerError: the lexeme is unknown.
        """
        if isinstance(behavior, FaceLexeme):
            self._weights(behavior.lexeme)
        return _TIMING.points

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> FaceUnit:
        """The face of a lexeme.

        Raises:
            RealizerError: the lexeme is unknown.
        """
        if not isinstance(behavior, FaceLexeme):
            raise TypeError(behavior)
        return FaceUnit(block, behavior, self._weights(behavior.lexeme), self._release)

    def _weights(self, lexeme: str) -> Mapping[str, float]:
        weights = self._lexemes.get(_word(lexeme))
        if weights is None:
            raise RealizerError(NoFace(lexeme=lexeme, known=tuple(self._lexemes)))
        return weights

    def face(self, tick: Tick) -> Mapping[str, float]:
        """Weights of morph targets now."""
        mouth = self._lip_sync.mouth(tick.time) if self._lip_sync else None
        share = self._share.at(tick.time, mouth is not None)
        shown = self.player.show(FaceUnit, lambda unit: unit.shown(tick.time), tick.time)
        face = _added(shown + self._fading_faces.at(tick.time))
        face = {m: w * (share if m.startswith(_MOUTH_MORPHS) else 1.0) for m, w in face.items()}
        spoken = self._spoken(mouth or {}, tick.time)
        # The maximum, not the sum: lips that smile already have the width of an "ee".
        return {m: max(face.get(m, 0.0), spoken.get(m, 0.0)) for m in face | spoken}

    def _spoken(self, mouth: Mapping[str, float], now: GlobalTime) -> dict[str, float]:
        """The mouth of the speech; if a word is cut off, the mouth fades like a face."""
        if self._mouth and not mouth:
            self._fading_mouths.add(self._mouth, now)
        self._mouth = mouth
        return _added([mouth, *self._fading_mouths.at(now)])

    def _release(self, unit: FaceUnit, time: GlobalTime) -> None:
        if unit.level > 0.0:
            self._fading_faces.add({m: w * unit.level for m, w in unit.weights.items()}, time)


@dataclass(frozen=True, slots=True)
class _Fade:
    weights: Mapping[str, float]
    since: GlobalTime

    def left(self, now: GlobalTime) -> float:
        return 1.0 - (now - self.since) / _FADE


class _Fades:
    """Weights of morph targets that fade to zero."""

    def __init__(self) -> None:
        self._fades: list[_Fade] = []

    def add(self, weights: Mapping[str, float], now: GlobalTime) -> None:
        """Fade weights from now on."""
        self._fades.append(_Fade(weights, now))

    def at(self, now: GlobalTime) -> list[dict[str, float]]:
        """The remaining weights of each fade."""
        self._fades = [fade for fade in self._fades if fade.left(now) > 0.0]
        return [{m: w * fade.left(now) for m, w in fade.weights.items()} for fade in self._fades]


class _MouthShare:
    """The share of an expression's mouth that is shown; it changes at a limited speed when speech starts or stops."""

    def __init__(self) -> None:
        self._share = 1.0
        self._time = GlobalTime(0.0)

    def at(self, now: GlobalTime, speaking: bool) -> float:
        """The share now, 0 to 1."""
        furthest = (1.0 - SHARE_WHILE_SPEAKING) * (now - self._time) / _SHARE_CHANGE
        change = (SHARE_WHILE_SPEAKING if speaking else 1.0) - self._share
        self._share += max(-furthest, min(furthest, change))
        self._time = now
        return self._share


def _added(faces: Sequence[Mapping[str, float]]) -> dict[str, float]:
    total: dict[str, float] = {}
    for face in faces:
        for morph, weight in face.items():
            total[morph] = total.get(morph, 0.0) + weight
    return total


def _eased(share: float) -> float:
    return share * share * (3.0 - 2.0 * share)


def _word(lexeme: str) -> str:
    return lexeme.upper().replace("-", "_")


FaceLexemes = Mapping[str, Mapping[str, float]]
"""Lexeme -> morph target -> weight at amount 1, 0 to 1."""


def read_face_lexemes(path: Path) -> FaceLexemes:
    """Read the lexemes of a JSON file: an object "lexemes" that contains one object of weights for each lexeme.

    Raises:
        RealizerError: "bad-asset": the file has another format; the error names the lexeme.
        OSError: the file cannot be read.
    """
    try:
        table = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as problem:
        row = getattr(problem, "lineno", 1)
        raise RealizerError(BadAsset(file=path.name, row=row, element="JSON", reason=str(problem))) from problem
    lexemes = table.get("lexemes") if isinstance(table, dict) else None
    if not isinstance(lexemes, dict):
        raise RealizerError(BadAsset(file=path.name, row=1, element="lexemes", reason="no object of that name"))
    return MappingProxyType({name: _weights(path.name, name, weights) for name, weights in lexemes.items()})


def _weights(file: str, lexeme: str, weights: object) -> Mapping[str, float]:
    if not isinstance(weights, dict) or not all(_is_weight(weight) for weight in weights.values()):
        raise RealizerError(BadAsset(file=file, row=1, element=lexeme, reason="weights are numbers from 0 to 1"))
    return MappingProxyType({morph: float(weight) for morph, weight in weights.items()})


def _is_weight(weight: object) -> bool:
    return isinstance(weight, int | float) and not isinstance(weight, bool) and 0.0 <= weight <= 1.0
