"""Common parts of all hairdos."""

from dataclasses import dataclass

import numpy as np

from reactive_realizer.bake.body import Body
from reactive_realizer.bake.characters import HairStyle
from reactive_realizer.bake.head_map import HeadMap
from reactive_realizer.bake.mesh import Mesh
from reactive_realizer.bake.numeric import Array
from reactive_realizer.bake.ribbon import LOCKS, LONG_LOCKS, ribbon
from reactive_realizer.bake.skull import Skull


@dataclass(frozen=True, slots=True)
class Strands:
    """Hair of one color on one head.

    Attributes:
        body, head, skull: on which it grows.
        rng: makes every strand a little different; the order of the draws is part of the result.
        color: (3,) linear light.
        weights: (joints,) bone weights.
    """

    body: Body
    head: HeadMap
    skull: Skull
    rng: np.random.Generator
    color: Array
    weights: Array

    def about(self, value: float, spread: float) -> float:
        """A value and up to half the spread more or less."""
        return value + spread * (self.rng.random() - 0.5)

    def varied(self, low: float, spread: float) -> float:
        """At least low and at most a spread more."""
        return low + spread * self.rng.random()

    def strand(self, path: Array, outward: Array, width: Array, across: int, bulge: float, shade: Array) -> Mesh:
        """A ribbon with a lock drawn at random; see `ribbon`. The shade (n,) darkens the color along the path."""
        long = self.body.character.hair is HairStyle.BOB
        lock = int(self.rng.integers(0, LONG_LOCKS) if long else self.rng.integers(LONG_LOCKS, LOCKS))
        colors = self.color[None] * shade[:, None]
        return ribbon(path, outward, width, across, bulge, lock, colors, self.weights)
