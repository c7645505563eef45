"""The times of least cost under bounds, by Newton's method."""

import logging
from collections.abc import Mapping, Sequence

import daqp
import numpy as np

from reactive_realizer.scheduler.convex.costs import Array, Costs
from reactive_realizer.scheduler.convex.longest_path import Arc, longest_path
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


def least_cost(spans: Sequence[Span], bounds: Sequence[BoundArc]) -> dict[int, float]:
    """The times (s) of least cost under bounds that can be met, by variable; the first one is at 0.

    If daqp fails, they meet the bounds at a higher cost.
    """
    edges: list[Span | BoundArc] = [*spans, *bounds]
    variables = sorted({variable for edge in edges for variable in (edge.tail, edge.head)})
    numbers = {variable: number for number, variable in enumerate(variables)}
    problem = _Problem(spans, bounds, numbers)
    times = problem.begin()
    if times is None:
        return dict(zip(variables, _earliest(spans, bounds, numbers), strict=True))
    for _ in range(_STEPS):
        found = problem.step(times)
        if found is None:
            break
        step, size = found
        times = times + step
        if size <= _ENOUGH:
            break
    return dict(zip(variables, [0.0, *times.tolist()], strict=True))


def _earliest(spans: Sequence[Span], bounds: Sequence[BoundArc], numbers: Mapping[int, int]) -> list[float]:
    """Times (s) that meet the bounds with the shortest durations."""
    arcs = [Arc(numbers[b.tail], numbers[b.head], b.length, None) for b in bounds]
    arcs += [Arc(numbers[s.tail], numbers[s.head], s.least - s.shift, None) for s in spans]
    times, _ = longest_path(len(numbers), arcs)
    return [time - times[0] for time in times]


class _Problem:
    """``min cost(G x + c)`` under ``R x >= r``; x are the times but the first, which is 0."""

    def __init__(self, spans: Sequence[Span], bounds: Sequence[BoundArc], numbers: Mapping[int, int]) -> None:
        self._costs = Costs(spans)
        self._spans = _differences(spans, numbers)
        self._shifts = np.array([span.shift for span in spans])
        self._least = np.array([span.least for span in spans])
        self._rows = _differences(bounds, numbers)
        self._distances = np.array([bound.length for bound in bounds])
        self._quadratic = _Quadratic(self._rows, self._spans)

    def begin(self) -> Array | None:
        """The optimum of the quadratic around the goals."""
        goals, curvature = self._costs.rough()
        gradient = self._spans.T @ (curvature * (self._shifts - goals))
        hessian = (self._spans.T * curvature) @ self._spans
        return self._quadratic.solve(hessian, gradient, self._distances, self._least - self._shifts)

    def step(self, times: Array) -> tuple[Array, float] | None:
        """Newton's step, or the part of it that lowers the cost, and its whole size relative to the durations."""
        durations = self._spans @ times + self._shifts
        gradient, hessian = self._costs.derivatives(durations)
        gradient, hessian = self._spans.T @ gradient, self._spans.T @ hessian @ self._spans
        reach = durations + self._costs.slack
        right = self._distances - self._rows @ times
        step = self._quadratic.solve(hessian, gradient, right, (_LEAST_SHARE - 1) * reach)
        if step is None:
            return None
        change = self._spans @ step
        size = float(np.max(np.abs(change) / (reach + 1e-3), initial=0.0))
        return (self._part(durations, change, float(gradient @ step)) if size > _CLOSE else 1.0) * step, size

    def _part(self, durations: Array, change: Array, slope: float) -> float:
        """The part of a change of durations that lowers the cost as much as its slope promises (Armijo)."""
        cost, part = self._costs.value(durations), 1.0
        while self._costs.value(durations + part * change) > cost + 0.1 * part * slope and part > 1e-9:
            part /= 2
        return part


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


def _differences(edges: Sequence[Span | BoundArc], numbers: Mapping[int, int]) -> Array:
    """A row for the difference between head and tail of each edge, without the column of the first variable."""
    matrix = np.zeros((len(edges), len(numbers)))
    lines = np.arange(len(edges))
    matrix[lines, [numbers[edge.head] for edge in edges]] = 1.0
    matrix[lines, [numbers[edge.tail] for edge in edges]] = -1.0
    return matrix[:, 1:]
