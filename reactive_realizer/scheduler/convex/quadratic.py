"""Least squares under inequalities: by the inequalities that were tight the last time, else by daqp."""

import logging

import daqp
import numpy as np

from reactive_realizer.scheduler.convex.costs import Array

logger = logging.getLogger(__name__)

_TOLERANCES = (1e-10, 1e-8, 1e-6)
"""That daqp meets inequalities with; its own 1e-6 lets plans miss by more than a person would call equal."""

_UNBOUNDED = 1e30
_PROXIMAL = 1e-7
"""Added to the curvature: parts joined by inequalities only have none against each other."""


class Quadratic:
    """Minimizes ``p'Hp/2 + f'p`` under ``R p >= r`` and ``G p >= low``, again and again with the same R and G.

    Args:
        rows: R.
        spans: G.
    """

    def __init__(self, rows: Array, spans: Array) -> None:
        self._rows = rows
        self._spans = spans
        self._all = np.vstack([rows, spans])
        # The rows came in because they were broken: probably all of them are tight.
        self._tight = np.arange(len(rows))

    def solve(self, hessian: Array, gradient: Array, right: Array, low: Array) -> Array | None:
        """The step p; None where none was found."""
        hessian = hessian + _PROXIMAL * np.eye(len(hessian))
        step = self._with_tight(hessian, gradient, right, low)
        if step is None:
            rough = self._daqp(hessian, gradient, np.concatenate((right, low)))
            if rough is not None:
                # Exactly the same optimum from its tight rows, whatever daqp's tolerances were.
                step = self._with_tight(hessian, gradient, right, low)
                step = rough if step is None else step
        return step

    def _with_tight(self, hessian: Array, gradient: Array, right: Array, low: Array) -> Array | None:
        """The optimum with the tight rows as equations, if that is the optimum."""
        tight = self._rows[self._tight]
        n, m = len(hessian), len(tight)
        system = np.zeros((n + m, n + m))
        system[:n, :n], system[:n, n:], system[n:, :n] = hessian, -tight.T, tight
        try:
            solved = np.linalg.solve(system, np.concatenate((-gradient, right[self._tight])))
        except np.linalg.LinAlgError:
            return None
        step, forces = solved[:n], solved[n:]
        met = (self._rows @ step >= right - 1e-10).all() and (self._spans @ step >= low - 1e-10).all()
        return np.asarray(step, dtype=np.float64) if met and (forces >= -1e-9).all() else None

    def _daqp(self, hessian: Array, gradient: Array, low: Array) -> Array | None:
        # Scaled: squeezed phases make the curvature uneven; clipped, since roots moved by rows alone have none.
        scale = 1 / np.sqrt(np.maximum(np.diag(hessian), 1.0))
        matrix = np.ascontiguousarray(hessian * scale * scale[:, None])
        rows = np.ascontiguousarray(self._all * scale)
        high, sense = np.full(len(low), _UNBOUNDED), np.zeros(len(low), np.int32)
        for tolerance in _TOLERANCES:
            step, _, flag, info = daqp.solve(
                matrix, gradient * scale, rows, high, low, sense, primal_tol=tolerance, iter_limit=10_000
            )
            if flag > 0:
                self._tight = np.flatnonzero(np.abs(info["lam"][: len(self._rows)]) > 1e-12)
                return np.asarray(step * scale, dtype=np.float64)
        logger.warning("daqp found no step")
        return None
