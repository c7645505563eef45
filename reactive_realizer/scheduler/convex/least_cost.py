"""The times of least cost under bounds, by Newton's method."""

import logging
from collections.abc import Mapping, Sequence

import daqp
import numpy as np

from reactive_realizer.scheduler.convex.costs import Array, Costs
from reactive_realizer.scheduler.convex.model import BoundArc
from reactive_realizer.scheduler.convex.spans import Span

logger = logging.getLogger(__name__)

_STEPS = 60
_CLOSE = 1e-5
"""Relative step below which there is no line search: costs differ by less than their rounding."""

_ENOUGH = 1e-6
"""Relative step after which the search ends; convergence is quadratic, so the remaining error is its square."""

_LEAST_SHARE = 0.2
"""Share of a duration that one step leaves at least."""

_TOLERANCE = 1e-10
"""s by which daqp may miss inequalities; its default of 1e-6 makes plans miss by more than people would call equal."""

_UNBOUNDED = 1e30
"""Infinity for daqp."""

_PROXIMAL = 1e-7
"""Added to the curvature: parts that are connected by inequalities only have none against each other."""


def least_cost(
    spans: Sequence[Span],
    bounds: Sequence[BoundArc],
    numbers: Mapping[int, int],
    floors: Sequence[float],
    inside: Sequence[float],
) -> list[float]:
    """The times (s) of least cost under all bounds; the first variable stays at 0.

    Args:
        spans: with their costs.
        bounds: to be met.
        numbers: of the variables.
        floors: durations (s) that are possible together, for the first step.
        inside: times (s) that have them; the result if no better ones are found.
    """
    problem = _Problem(spans, bounds, numbers)
    times = problem.begin(np.array(floors))
    if times is None:
        return [time - inside[0] for time in inside]
    for _ in range(_STEPS):
        step = problem.step(times)
        if step is None:
            break
        size = problem.relative(times, step)
        times = times + (problem.part(times, step) if size > _CLOSE else 1.0) * step
        if size <= _ENOUGH:
            break
    return [0.0, *times.tolist()]


class _Problem:
    """``min cost(G x + c)`` under ``R x >= r``; x are the times but the first, which is 0."""

    def __init__(self, spans: Sequence[Span], bounds: Sequence[BoundArc], numbers: Mapping[int, int]) -> None:
        self._costs = Costs(spans)
        heads, tails = [numbers[s.head] for s in spans], [numbers[s.tail] for s in spans]
        self._spans = _differences(heads, tails, len(numbers))
        self._shifts = np.array([span.shift for span in spans])
        laters, earliers = [numbers[b.head] for b in bounds], [numbers[b.tail] for b in bounds]
        self._rows = _differences(laters, earliers, len(numbers))
        self._distances = np.array([bound.length for bound in bounds])
        self._quadratic = _Quadratic(self._rows, self._spans)

    def begin(self, floors: Array) -> Array | None:
        """The optimum of the quadratic around the goals."""
        goals, curvature = self._costs.rough()
        gradient = self._spans.T @ (curvature * (self._shifts - goals))
        hessian = (self._spans.T * curvature) @ self._spans
        return self._quadratic.solve(hessian, gradient, self._distances, floors - self._shifts)

    def step(self, times: Array) -> Array | None:
        """Newton's step."""
        durations = self._durations(times)
        gradient, hessian = self._costs.derivatives(durations)
        low = (_LEAST_SHARE - 1) * (durations + self._costs.slack)
        right = self._distances - self._rows @ times
        return self._quadratic.solve(self._spans.T @ hessian @ self._spans, self._spans.T @ gradient, right, low)

    def relative(self, times: Array, step: Array) -> float:
        """The size of a step relative to the durations."""
        scale = self._durations(times) + self._costs.slack + 1e-3
        return float(np.max(np.abs(self._spans @ step) / scale, initial=0.0))

    def part(self, times: Array, step: Array) -> float:
        """The part of a step that lowers the cost as much as its slope promises (Armijo)."""
        durations, change = self._durations(times), self._spans @ step
        cost = self._costs.value(durations)
        slope = float(self._costs.derivatives(durations)[0] @ change)
        part = 1.0
        while self._costs.value(durations + part * change) > cost + 0.1 * part * slope and part > 1e-9:
            part /= 2
        return part

    def _durations(self, times: Array) -> Array:
        return np.asarray(self._spans @ times + self._shifts, dtype=np.float64)


class _Quadratic:
    """Minimizes ``p'Hp/2 + f'p`` under ``R p >= r`` and ``G p >= low``, repeatedly with the same R and G.

    With the inequalities as equations that were tight the last time, that is one linear system; if its solution is not
    the optimum, daqp finds the tight ones.
    """

    def __init__(self, rows: Array, spans: Array) -> None:
        self._rows = rows
        self._spans = spans
        self._all = np.vstack([rows, spans])
        # The rows were added because they were broken: probably all of them are tight.
        self._tight = np.arange(len(rows))

    def solve(self, hessian: Array, gradient: Array, right: Array, low: Array) -> Array | None:
        """The step p; None if none is found."""
        hessian = hessian + _PROXIMAL * np.eye(len(hessian))
        step = self._with_tight(hessian, gradient, right, low)
        if step is None:
            rough = self._daqp(hessian, gradient, np.concatenate((right, low)))
            if rough is not None:
                # Exactly the same optimum from its tight rows, whatever daqp's tolerance was.
                step = self._with_tight(hessian, gradient, right, low)
                step = rough if step is None else step
        return step

    def _with_tight(self, hessian: Array, gradient: Array, right: Array, low: Array) -> Array | None:
        """The optimum with the tight rows as equations; None if that is not the optimum."""
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
        # Scaled: squeezed phases make the curvature uneven; clipped, since variables in inequalities only have none.
        scale = 1 / np.sqrt(np.maximum(np.diag(hessian), 1.0))
        matrix = np.ascontiguousarray(hessian * scale * scale[:, None])
        rows = np.ascontiguousarray(self._all * scale)
        high, sense = np.full(len(low), _UNBOUNDED), np.zeros(len(low), np.int32)
        step, _, flag, info = daqp.solve(
            matrix, gradient * scale, rows, high, low, sense, primal_tol=_TOLERANCE, iter_limit=10_000
        )
        if flag <= 0:
            logger.warning("daqp found no step")
            return None
        self._tight = np.flatnonzero(np.abs(info["lam"][: len(self._rows)]) > 1e-12)
        return np.asarray(step * scale, dtype=np.float64)


def _differences(plus: Sequence[int], minus: Sequence[int], size: int) -> Array:
    """A row for each ``x[plus] - x[minus]``, without the column of the first variable."""
    matrix = np.zeros((len(plus), size))
    lines = np.arange(len(plus))
    matrix[lines, list(plus)] = 1.0
    matrix[lines, list(minus)] = -1.0
    return matrix[:, 1:]
