"""Finds the times with the least deviation from wishes, by a linear program (solved with daqp)."""

from collections.abc import Sequence
from typing import NamedTuple

import daqp
import numpy as np
from numpy.typing import NDArray

from reactive_realizer.scheduler.embr.differences import Row

_SQUARES = 1e-3
"""Weight of squared deviations against absolute ones."""

_SHRINKING = 100.0
"""Weight of shrinking against stretching, among equally good plans: only shrinking has a limit."""

_HELD = 1e-4
"""Curvature (1/s^2) that holds times at those of the last round: daqp needs some for each variable."""

_ROUNDS = 20
_SETTLED = 1e-7
"""s; a round that moves nothing by more is the last."""

_TOLERANCES = (1e-10, 1e-9, 1e-8)
"""By which daqp may miss a row, which it scales: a hundred times that in seconds. The first one that works is used."""

_FAR = 1e30
"""daqp's infinity."""

_EQUAL = 5
"""daqp's sense of an equality."""


Array = NDArray[np.float64]


class Wish(NamedTuple):
    """``later = earlier + distance`` (s), as far as possible; softer wishes give way by more."""

    row: Row[int]
    softness: float


def least_deviations(
    bounds: Sequence[tuple[float, float]], rows: Sequence[Row[int]], wishes: Sequence[Wish]
) -> list[float] | None:
    """Times of variables by number, as close to all wishes as bounds and rows allow.

    The sum of absolute deviations, in seconds, is minimal: EMBR's measure of naturalness (thesis 7.2.3). Of equally
    good plans, the one with the least weighted sum of squared deviations is chosen. Both stages are one quadratic
    program: if squares weigh little enough, its solution is the solution of the linear program with the least squares
    (Mangasarian and Meyer, Nonlinear perturbation of linear programs, 1979).

    Args:
        bounds: of each variable (s), infinite if there is none.
        rows: conditions that have to be met, and can be.
        wishes: conditions to be met as well as possible.

    Returns:
        The times (s); None if the solver finds none.
    """
    matrix = _matrix(len(bounds), rows, wishes)
    lower = np.array([*(low for low, _ in bounds), *[0.0] * (2 * len(wishes)), *(row.distance for row in rows)])
    upper = np.array([*(high for _, high in bounds), *[_FAR] * (2 * len(wishes) + len(rows))])
    wanted = np.array([wish.row.distance for wish in wishes])
    lower = np.concatenate([np.maximum(lower, -_FAR), wanted])
    upper = np.concatenate([np.minimum(upper, _FAR), wanted])
    sense = np.where(lower == upper, _EQUAL, 0).astype(np.int32)
    stiffness = [1 / wish.softness for wish in wishes]
    squares = np.diag([*[_HELD] * len(bounds), *stiffness, *(_SHRINKING * each for each in stiffness)])
    slope = np.repeat([0.0, 1 / _SQUARES], [len(bounds), 2 * len(wishes)])
    times = np.zeros(len(bounds))
    for _ in range(_ROUNDS):
        slope[: len(bounds)] = -_HELD * times
        solved = _solve(squares, slope, matrix, upper, lower, sense)
        if solved is None:
            return None
        settled = np.abs(solved[: len(bounds)] - times).max() < _SETTLED
        times = solved[: len(bounds)]
        if settled:
            break
    return [float(time) for time in times]


def _solve(
    squares: Array, slope: Array, matrix: Array, upper: Array, lower: Array, sense: NDArray[np.int32]
) -> Array | None:
    for tolerance in _TOLERANCES:
        solved, _, flag, _ = daqp.solve(squares, slope, matrix, upper, lower, sense, primal_tol=tolerance)
        if flag > 0:
            return np.asarray(solved, dtype=np.float64)
    return None


def _matrix(count: int, rows: Sequence[Row[int]], wishes: Sequence[Wish]) -> Array:
    """Columns: the times, then by how much each wish is exceeded, then by how much it is missed."""
    matrix = np.zeros((len(rows) + len(wishes), count + 2 * len(wishes)))
    for line, row in enumerate((*rows, *(wish.row for wish in wishes))):
        matrix[line, row.later], matrix[line, row.earlier] = 1.0, -1.0
    over = np.arange(len(wishes))
    matrix[len(rows) + over, count + over] = -1.0
    matrix[len(rows) + over, count + len(wishes) + over] = 1.0
    return matrix
