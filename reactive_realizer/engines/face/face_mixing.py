"""Combines expressions, the resting face and speech into the face of a frame."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engines.face.expressions import Weights
from reactive_realizer.engines.face.face_unit import MOUTH_MORPHS

SHARE_WHILE_SPEAKING = 0.5
"""The share of an expression's mouth that is shown during speech."""

_SHARE_CHANGE = 0.15
"""Time in which the share changes from 1 to `SHARE_WHILE_SPEAKING`, or back, s."""

_REGIONS = (*MOUTH_MORPHS, "nose", "cheek", "eye", "brow")


class Fades:
    """Weights of morph targets that fade to zero.

    Args:
        duration: of a fade, s.
    """

    def __init__(self, duration: float) -> None:
        self._duration = duration
        self._fades: list[_Fade] = []

    def add(self, weights: Weights, now: GlobalTime) -> None:
        """Fade weights from now on."""
        self._fades.append(_Fade(weights, now, self._duration))

    def at(self, now: GlobalTime) -> list[dict[str, float]]:
        """The remaining weights of each fade."""
        self._fades = [fade for fade in self._fades if fade.left(now) > 0.0]
        return [{m: w * fade.left(now) for m, w in fade.weights.items()} for fade in self._fades]


@dataclass(frozen=True, slots=True)
class _Fade:
    weights: Weights
    since: GlobalTime
    duration: float

    def left(self, now: GlobalTime) -> float:
        return 1.0 - (now - self.since) / self.duration


class MouthShare:
    """The share of an expression's mouth that is shown; it changes at a limited speed when speech starts or stops."""

    def __init__(self) -> None:
        self._share = 1.0
        self._time = GlobalTime(0.0)

    def at(self, now: GlobalTime, *, speaking: bool) -> float:
        """The share now, 0 to 1."""
        furthest = (1.0 - SHARE_WHILE_SPEAKING) * (now - self._time) / _SHARE_CHANGE
        change = (SHARE_WHILE_SPEAKING if speaking else 1.0) - self._share
        self._share += max(-furthest, min(furthest, change))
        self._time = now
        return self._share


def resting_face_under(resting: Weights, expressions: Iterable[tuple[Weights, float]]) -> dict[str, float]:
    """The resting face, reduced in each region by the level of the expressions that move the region.

    Args:
        resting: weights of the resting face.
        expressions: weights and level, 0..1, of each expression that plays.
    """
    taken: dict[str, float] = {}
    for weights, level in expressions:
        for region in set(map(_region, weights)):
            taken[region] = max(taken.get(region, 0.0), min(level, 1.0))
    return {morph: weight * (1.0 - taken.get(_region(morph), 0.0)) for morph, weight in resting.items()}


def between(before: Weights, after: Weights, share: float) -> dict[str, float]:
    """Weights on the way from one face to another."""
    morphs = dict.fromkeys((*before, *after))
    return {m: before.get(m, 0.0) + share * (after.get(m, 0.0) - before.get(m, 0.0)) for m in morphs}


def greatest(one: Mapping[str, float], other: Mapping[str, float]) -> dict[str, float]:
    """The greater weight of each morph target: lips that smile already have the width of an "ee"."""
    return {morph: max(one.get(morph, 0.0), other.get(morph, 0.0)) for morph in (*one, *(other.keys() - one.keys()))}


def _region(morph: str) -> str:
    region = next((each for each in _REGIONS if morph.startswith(each)), morph)
    return "mouth" if region in MOUTH_MORPHS else region
