"""Noise that moves smoothly: what makes a still hand look alive."""

import math
from random import Random

_MOST_OCTAVES = 16
"""The next one would be heard rather than seen."""


class PerlinNoise:
    """A smooth random function of one number, from -1 to 1 and 0 at whole numbers; it repeats after 256.

    K. Perlin, "Improving noise" (SIGGRAPH 2002), in one dimension: slopes at whole numbers, blended by the polynomial
    of degree 5 that leaves and arrives without speed and acceleration.
    """

    def __init__(self, seed: int) -> None:
        """Noise of the same seed is the same noise."""
        self._slopes = [(2 * i - 255) / 255 for i in Random(seed).sample(range(256), 256)]

    def __call__(self, x: float) -> float:
        """Its value at x.

        Raises:
            ValueError: x is not a number.
            OverflowError: x is infinite.
        """
        i = math.floor(x)
        u = x - i
        faded = u * u * u * (10.0 + u * (6.0 * u - 15.0))
        before, after = self._slopes[i % 256] * u, self._slopes[(i + 1) % 256] * (u - 1.0)
        return 2.0 * (before + faded * (after - before))

    def octaves(self, x: float, count: int, persistence: float) -> float:
        """A mean of octaves, each twice as quick as the one before and weighing persistence times as much; -1 to 1.

        Raises:
            ValueError: there are to be none or too many, or the persistence is negative.
        """
        if not 1 <= count <= _MOST_OCTAVES or persistence < 0.0:
            raise ValueError(f"noise has 1 to {_MOST_OCTAVES} octaves, and a persistence of 0 or more")
        weights = [persistence**i for i in range(count)]
        # Octaves are shifted, for all are 0 at whole numbers.
        values = (self(x * 2.0**i + 37.4 * i) for i in range(count))
        return sum(weight * value for weight, value in zip(weights, values, strict=True)) / sum(weights)
