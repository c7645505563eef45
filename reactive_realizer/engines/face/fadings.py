"""What was cut on a face, and goes."""

from collections.abc import Mapping
from dataclasses import dataclass

from reactive_realizer.clock.units import GlobalTime

DURATION = 0.25
"""s."""


@dataclass(frozen=True, slots=True)
class _Fading:
    weights: Mapping[str, float]
    since: GlobalTime

    def left(self, now: GlobalTime) -> float:
        return 1.0 - (now - self.since) / DURATION


class Fadings:
    """Weights of morph targets that nobody asks for any more, on their way to nothing."""

    def __init__(self) -> None:
        self._fadings: list[_Fading] = []

    def add(self, weights: Mapping[str, float], now: GlobalTime) -> None:
        """Let weights go from now on."""
        self._fadings.append(_Fading(weights, now))

    def shown(self, now: GlobalTime) -> list[dict[str, float]]:
        """What is left of each."""
        self._fadings = [fading for fading in self._fadings if fading.left(now) > 0.0]
        return [{m: w * fading.left(now) for m, w in fading.weights.items()} for fading in self._fadings]
