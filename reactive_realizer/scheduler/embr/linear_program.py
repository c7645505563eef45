"""The least deviation from what is wished for, by a linear program (solved with daqp)."""

from collections.abc import Sequence
from typing import NamedTuple

import daqp
import numpy as np
from numpy.typing import NDArray

from reactive_realizer.scheduler.embr.differences import Row

_SQUARES = 1e-3
"""Weight of squared deviations against absolute ones."""

_SHRINKING = 100.0
"""How much more it weighs to shrink than to stretch, among what is equally good: the one ends at nothing."""

_HELD = 1e-4
"""Curvature (1/s^2) that holds times where the last round put them: daqp wants some for each variable."""

_ROUNDS = 20
_SETTLED = 1e-7
"""s; a round that moves nothing by more is the last."""

_TOLERANCES = (1e-10, 1e-9, 1e-8)
"""By which daqp may miss a row, as it scales rows: a hundred times that in seconds. The first that works is taken."""

_FAR = 1e30
"""daqp's infinity."""

_EQUAL = 5
"""daqp's sense of a row whose bounds are one."""


Array = NDArray[np.float64]


class Wish(NamedTuple):
    """``later = earlier + distance`` (s) is wished for; of several the softer give way by more."""

    row: Row[int]
    softness: float


def least_deviations(
    bounds: Sequence[tuple[float, float]], rows: Sequence[Row[int]], wishes: Sequence[Wish]
) -> list[float] | None:
    """Times of variables by number, as near to all wishes as bounds and rows let them.

    The sum of absolute deviations, in seconds, is minimal: EMBR's measure of naturalness (thesis 7.2.3). Mostly many
    plans are equally good by that; of these it is the one with the least weighted sum of squared deviations. Both
    stages are one quadratic program: with few enough squares its solution is the one of the linear program that has the
    least of them (Mangasarian and Meyer, Nonlinear perturbation of linear programs, 1979).

    Args:
        bounds: of each variable (s), infinite where there is none.
        rows: that have to be met; they can be.
        wishes: what is to be met as well as can be.

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
