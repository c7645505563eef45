"""The surface around an axis: how far away it is, by the place along the axis and the angle about it."""

import math
from itertools import islice
from typing import NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

ANGLES = 16
"""Coefficients around the axis."""

PER_RADIAN = ANGLES / (2.0 * math.pi)
"""Columns of coefficients per rad."""

_POWERS = np.array(((0.5, 0.5, 0.0), (-1.0, 1.0, 0.0), (0.5, -1.0, 0.5)))
"""Polynomials of the three weights of a quadratic B-spline, as rows of their powers."""

_SAMPLES = np.linspace(0.0, 1.0, 5)
_VALUES = np.vander(_SAMPLES, 3, increasing=True)
_SLOPES = np.stack((0.0 * _SAMPLES, _SAMPLES**0, 2.0 * _SAMPLES), axis=1)
"""Places in a patch at which it is measured, with the powers of their shares and the slopes of these."""

_ENOUGH = 3_000
"""Vertices that are used, at most."""

_SMOOTH = 0.1
"""Weight of the differences between neighboring coefficients: it fills places without vertices."""

_THINNEST = 0.01
"""Least distance from an axis that counts, m."""

_ROUNDS = 4
_INNER = 0.03
"""Weight of a vertex that is below the surface, such as one of a layer of clothes that another one covers."""


class Patch(NamedTuple):
    """A part of a surface, between rows and columns of coefficients.

    Attributes:
        farthest: its largest distance from the axis, m.
        outermost: the same for another axis, in front of that one, m.
        steepest: how much faster than the distance from it the distance from the axis grows, at most.
        terms: of the polynomial c00 + c01 v + c02 v² + u (c10 + c11 v + c12 v²) + u² (...) of the shares u along the
            axis and v around it, m.
    """

    farthest: float
    outermost: float
    steepest: float
    terms: tuple[float, ...]


class Profile(NamedTuple):
    """A quadratic B-spline over the place along an axis, as a share of its length, and the angle about it.

    Its normals are continuous. At both ends it is level; beyond them, it has the values of the ends.

    Attributes:
        bottom: share of the first row of coefficients.
        step: from one row to the next one.
        rows: coefficients, m, (R, `ANGLES`); the angle 0 is in front, and a quarter of a turn is to the left.
    """

    bottom: float
    step: float
    rows: tuple[tuple[float, ...], ...]

    @classmethod
    def through(
        cls,
        shares: NDArray[np.float64],
        angles: NDArray[np.float64],
        radii: NDArray[np.float64],
        ends: tuple[float, float],
        rows: int,
    ) -> Self:
        """Return the surface through the outermost of some vertices, by least squares.

        Args:
            shares: of the axis, (V,).
            angles: rad, (V,).
            radii: distance from the axis, m, (V,).
            ends: shares of the first and the last row.
            rows: their number.
        """
        bottom, step = ends[0], (ends[1] - ends[0]) / (rows - 1)
        (within,) = np.nonzero((shares > bottom - 0.5 * step) & (shares < ends[1] + 0.5 * step))
        within = within[:: 1 + len(within) // _ENOUGH]
        columns, values = _basis((shares[within] - bottom) / step, angles[within], rows)
        pairs = (columns[:, :, np.newaxis] * rows * ANGLES + columns[:, np.newaxis, :]).ravel()
        products = values[:, :, np.newaxis] * values[:, np.newaxis, :]
        radii, level = radii[within], _differences(rows)
        weights: NDArray[np.float64] = np.ones(len(radii))
        coefficients: NDArray[np.float64] = np.zeros(rows * ANGLES)
        for _ in range(_ROUNDS):
            squares = np.bincount(pairs, (weights[:, np.newaxis, np.newaxis] * products).ravel(), (rows * ANGLES) ** 2)
            goal = np.bincount(columns.ravel(), ((weights * radii)[:, np.newaxis] * values).ravel(), rows * ANGLES)
            solved = np.linalg.solve(squares.reshape(rows * ANGLES, -1) + level, goal)
            coefficients = np.asarray(solved, np.float64)
            below = (values * coefficients[columns]).sum(axis=1) > radii
            weights = np.where(below, _INNER, 1.0)
        return cls(bottom, step, tuple(map(tuple, coefficients.reshape(rows, ANGLES).tolist())))

    def patches(self, size: float, ahead: float = 0.0) -> list[list[Patch]]:
        """Return the patches of the surface, by row and column; the first one begins half a step before these.

        Args:
            size: length of the axis, m.
            ahead: how far the other axis is in front of that one, m (`Patch.outermost`).
        """
        rows = np.array([self.rows[0], *self.rows, self.rows[-1], self.rows[-1]])
        three = np.arange(len(rows) - 2)[:, np.newaxis] + np.arange(3)
        around = (np.arange(-1, ANGLES - 1)[:, np.newaxis] + np.arange(3)) % ANGLES
        terms = _POWERS @ rows[three[:, np.newaxis, :, np.newaxis], around[:, np.newaxis, :]] @ _POWERS.T
        radii = np.maximum(_VALUES @ terms @ _VALUES.T, _THINNEST)
        slopes = _SLOPES @ terms @ _VALUES.T / (self.step * size), _VALUES @ terms @ _SLOPES.T * PER_RADIAN / radii
        angles = (np.arange(ANGLES)[:, np.newaxis, np.newaxis] - 0.5 + _SAMPLES) / PER_RADIAN
        others = np.hypot(radii * np.sin(angles), radii * np.cos(angles) - ahead)
        steepness = np.sqrt(1.0 + slopes[0] ** 2 + slopes[1] ** 2)
        largest = (each.max(axis=(2, 3)).tolist() for each in (radii, others, steepness))
        numbers = map(tuple, terms.reshape(-1, 9).tolist())
        return [list(map(Patch, *limits, islice(numbers, ANGLES))) for limits in zip(*largest, strict=True)]


def _basis(
    places: NDArray[np.float64], angles: NDArray[np.float64], rows: int
) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """Return the nine coefficients that count for each vertex, (V, 9), and how much, (V, 9).

    Args:
        places: of the vertices, in rows, (V,).
        angles: rad, (V,).
        rows: their number.
    """
    lines, by_line = _weights(places)
    columns, by_column = _weights(angles * PER_RADIAN)
    which = np.clip(lines, 0, rows - 1)[:, :, np.newaxis] * ANGLES + (columns % ANGLES)[:, np.newaxis, :]
    return which.reshape(-1, 9), (by_line[:, :, np.newaxis] * by_column[:, np.newaxis, :]).reshape(-1, 9)


def _weights(places: NDArray[np.float64]) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """Return the three nearest numbers for each place, (V, 3), and the weights of their coefficients, (V, 3)."""
    middle = np.floor(places + 0.5)
    t = places + 0.5 - middle
    weights = np.stack((0.5 * (1.0 - t) ** 2, 0.5 + t * (1.0 - t), 0.5 * t**2), axis=1)
    return middle.astype(np.intp)[:, np.newaxis] + np.arange(-1, 2), weights


def _differences(rows: int) -> NDArray[np.float64]:
    """Return the matrix of the squared differences between neighboring coefficients."""
    numbers = np.arange(rows * ANGLES).reshape(rows, ANGLES)
    pairs = (
        np.stack((numbers[:-1].ravel(), numbers[1:].ravel())),
        np.stack((numbers.ravel(), np.roll(numbers, 1, axis=1).ravel())),
    )
    first, second = np.concatenate(pairs, axis=1)
    matrix = np.zeros((rows * ANGLES, rows * ANGLES))
    np.add.at(matrix, (first, first), _SMOOTH)
    np.add.at(matrix, (second, second), _SMOOTH)
    np.add.at(matrix, (first, second), -_SMOOTH)
    np.add.at(matrix, (second, first), -_SMOOTH)
    return matrix
