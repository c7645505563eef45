"""Weights of motions by parameters: each motion has a place in the space of the parameters (as in SmartBody)."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

_FLAT = 1e-9


class BlendSpace:
    """Places of motions, along a line or in cells with one corner more than there are parameters.

    Outside, the weights are those at a place near by: they are never below 0.

    Args:
        places: of the motions, (N, D), D from 0 to 3.
        cells: indices of the motions at the corners of each cell, D + 1; for D up to 1 they follow from the places.

    Raises:
        ValueError: two motions are at one place, or a cell is flat.
    """

    def __init__(self, places: Sequence[Sequence[float]], cells: Sequence[Sequence[int]] = ()) -> None:
        self.places = tuple(map(tuple, places))
        self.size = len(places[0])
        if len(set(self.places)) < len(self.places):
            raise ValueError("two motions are at the same place")
        if self.size == 1:
            order = sorted(range(len(places)), key=lambda number: self.places[number])
            cells = list(pairwise(order))
        self._cells = [(tuple(cell), self._inverse(cell)) for cell in cells]

    def _inverse(self, cell: Sequence[int]) -> NDArray[np.float64]:
        """Return the matrix that makes weights of the corners of a place, to which a 1 is appended."""
        corners = np.array([(*self.places[number], 1.0) for number in cell]).T
        if abs(np.linalg.det(corners)) < _FLAT:
            raise ValueError("a cell is flat")
        inverse: NDArray[np.float64] = np.linalg.inv(corners)
        return inverse

    def weights(self, place: Sequence[float]) -> tuple[float, ...]:
        """Return the weight of each motion at a place, (N,), together 1."""
        found = [0.0] * len(self.places)
        if not self._cells:
            found[0] = 1.0
            return tuple(found)
        shares = [(corners, inverse @ (*place, 1.0)) for corners, inverse in self._cells]
        corners, best = max(shares, key=lambda cell: float(np.min(cell[1])))
        inside = np.maximum(best, 0.0)
        for number, share in zip(corners, inside / np.sum(inside), strict=True):
            found[number] = float(share)
        return tuple(found)
