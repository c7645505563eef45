"""Combines expressions, the resting face and speech into the face of a frame."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engines.face.face_unit import MOUTH_MORPHS
from reactive_realizer.engines.face.weights import Weights

CORNERS = ("mouthSmile", "mouthFrown", "mouthDimple", "mouthStretch", "mouthLeft", "mouthRight")
"""Prefixes of the names of the morph targets that move the corners of the mouth; they do not part the lips."""

_CORNERS_WHILE_SPEAKING = 0.5
"""The share of the corners of an expression's mouth that is shown during speech."""

_CHANGE = 0.15
"""Time in which an expression yields the corners of the mouth to speech, or returns to the whole mouth, s."""
_LIPS_YIELD = 0.05
"""Time in which an expression yields the lips to speech, s: before the first sound for which lips have to touch."""

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
        if weights:
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


class MouthShares:
    """The shares of an expression's mouth that are shown: all, or half of its corners while the character speaks.

    Speech determines whether the lips touch, and their shape. The shares change at a limited speed.
    """

    def __init__(self) -> None:
        self._corners = _Share(1.0)
        self._lips = _Share(1.0)
        self._time = GlobalTime(0.0)

    def take(self, now: GlobalTime, *, speaking: bool) -> None:
        """Move the shares to a later time."""
        elapsed, self._time = now - self._time, now
        change = (1.0 - _CORNERS_WHILE_SPEAKING) * elapsed / _CHANGE
        self._corners.move(_CORNERS_WHILE_SPEAKING if speaking else 1.0, change)
        self._lips.move(0.0 if speaking else 1.0, elapsed / (_LIPS_YIELD if speaking else _CHANGE))

    def of(self, face: Weights) -> Weights:
        """The weights of a face as far as they are shown."""
        if self._corners.value == self._lips.value == 1.0:
            return face
        return {morph: weight * self._share(morph) for morph, weight in face.items()}

    def _share(self, morph: str) -> float:
        if morph.startswith(CORNERS):
            return self._corners.value
        return self._lips.value if morph.startswith(MOUTH_MORPHS) else 1.0


@dataclass(slots=True)
class _Share:
    value: float

    def move(self, target: float, furthest: float) -> None:
        self.value += max(-furthest, min(furthest, target - self.value))


def resting_face_under(resting: Weights, expressions: Iterable[tuple[Weights, float]]) -> dict[str, float]:
    """The resting face, reduced in each region by the level of the expressions that move the region.

    Args:
        resting: weights of the resting face.
        expressions: weights and level, 0..1, of each expression that plays.
    """
    taken: dict[str, float] = {}
    for weights, level in expressions:
        for region in set(map(region_of, weights)):
            taken[region] = max(taken.get(region, 0.0), min(level, 1.0))
    return {morph: weight * (1.0 - taken.get(region_of(morph), 0.0)) for morph, weight in resting.items()}


def between(before: Weights, after: Weights, share: float) -> dict[str, float]:
    """Weights on the way from one face to another."""
    morphs = dict.fromkeys((*before, *after))
    return {m: before.get(m, 0.0) + share * (after.get(m, 0.0) - before.get(m, 0.0)) for m in morphs}


def greatest(one: Mapping[str, float], other: Mapping[str, float]) -> dict[str, float]:
    """The greater weight of each morph target: lips that smile already have the width of an "ee"."""
    rest = {morph: max(0.0, weight) for morph, weight in other.items() if morph not in one}
    return {morph: max(weight, other.get(morph, 0.0)) for morph, weight in one.items()} | rest


@cache
def region_of(morph: str) -> str:
    """The region of the face that a morph target moves: mouth, nose, cheek, eye, brow; others are their own."""
    region = next((each for each in _REGIONS if morph.startswith(each)), morph)
    return "mouth" if region in MOUTH_MORPHS else region
