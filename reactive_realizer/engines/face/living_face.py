"""A living face: without an expression, it smiles a little, more and less, and its lids and brows are never still."""

import math
from collections.abc import Collection, Iterable
from random import Random
from typing import NamedTuple

from reactive_realizer.engines.face.face_mixing import region_of
from reactive_realizer.engines.face.weights import Weights

_SLOW, _FAST = (0.15, 0.3), (0.5, 0.9)
"""Lowest and highest angular frequency of the two waves of a movement, rad/s: it has no visible period."""

_QUICKER = 0.3
"""Share of the faster wave."""


class _Movement(NamedTuple):
    """A slow movement of some morph targets.

    Attributes:
        morphs: with the share of the movement that each has.
        mean: weight, 0 to 1.
        size: of the movement about it.
    """

    morphs: dict[str, float]
    mean: float
    size: float


_MOVEMENTS = (
    # Without mouthClose, a smile bares teeth at the corners of the mouth.
    _Movement({"mouthSmileLeft": 1.0, "mouthSmileRight": 0.85, "mouthClose": 0.6}, 0.10, 0.05),
    _Movement({"eyeSquintLeft": 1.0, "eyeSquintRight": 1.0}, 0.08, 0.06),
    _Movement({"browInnerUp": 1.0, "browOuterUpLeft": 0.6, "browOuterUpRight": 0.5}, 0.04, 0.04),
)
"""A slight smile, the lids, and the brows."""

_GIVING_WAY = 0.4
"""Time in which a region gives way to an expression, or comes back, s."""


class LivingFace:
    """The movements of a face that expresses nothing. All sizes are ours: they are seen, and not read as an emotion.

    In each region of the face, they give way to whatever else moves the region.
    """

    def __init__(self, random: Random, degree: float) -> None:
        """Draw the movements from a generator that must not be shared.

        Args:
            random: the generator.
            degree: of idle animation, 0 to 1.
        """
        self._degree = degree
        self._waves = [
            (movement, random.uniform(*_SLOW), random.uniform(*_FAST), random.uniform(0.0, 100.0))
            for movement in _MOVEMENTS
        ]
        self._shares = {region_of(morph): 1.0 for movement in _MOVEMENTS for morph in movement.morphs}
        self._time = 0.0

    def at(self, time: float, others: Iterable[Weights]) -> dict[str, float]:
        """Return the weights of morph targets at a time, s.

        Args:
            time: s; times come in order.
            others: the weights of other faces that are shown.
        """
        self._give_way({region_of(morph) for weights in others for morph in weights}, time - self._time)
        self._time = time
        weights: dict[str, float] = {}
        for (morphs, mean, size), slow, fast, begin in self._waves:
            passed = time + begin
            wave = (1.0 - _QUICKER) * math.sin(slow * passed) + _QUICKER * math.sin(fast * passed)
            level = self._degree * (mean + size * wave)
            for morph, part in morphs.items():
                weights[morph] = part * level * self._shares[region_of(morph)]
        return weights

    def _give_way(self, moved: Collection[str], passed: float) -> None:
        """Move on toward what is left of each region, for some time, s."""
        furthest = passed / _GIVING_WAY
        for region, part in self._shares.items():
            goal = 0.0 if region in moved else 1.0
            self._shares[region] = part + max(-furthest, min(furthest, goal - part))
