"""Least cost by Newton's method."""

from collections.abc import Mapping, Sequence

import numpy as np

from reactive_realizer.scheduler.convex.costs import Array, Costs
from reactive_realizer.scheduler.convex.quadratic import Quadratic
from reactive_realizer.scheduler.convex.span import Bound, Span

_STEPS = 60
_CLOSE = 1e-5
"""Relative step below which the line is not searched: costs differ by less than they are exact."""

_ENOUGH = 1e-6
"""Relative step after which it ends; convergence is quadratic, so that what is left is its square."""

_LEAST_SHARE = 0.2
"""What of a duration one step leaves at least."""


def least_cost(
    spans: Sequence[Span],
    bounds: Sequence[Bound],
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
        inside: times (s) that have them; kept where no better ones are found.
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

    def __init__(self, spans: Sequence[Span], bounds: Sequence[Bound], numbers: Mapping[int, int]) -> None:
        self._costs = Costs(spans)
        heads, tails = [numbers[s.head] for s in spans], [numbers[s.tail] for s in spans]
        self._spans = _differences(heads, tails, len(numbers))
        self._shifts = np.array([span.shift for span in spans])
        laters, earliers = [numbers[b.later] for b in bounds], [numbers[b.earlier] for b in bounds]
        self._rows = _differences(laters, earliers, len(numbers))
        self._distances = np.array([bound.distance for bound in bounds])
        self._quadratic = Quadratic(self._rows, self._spans)

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
        """How large a step is, against the durations."""
        scale = self._durations(times) + self._costs.slack + 1e-3
        return float(np.max(np.abs(self._spans @ step) / scale, initial=0.0))

    def part(self, times: Array, step: Array) -> float:
        """How much of a step lowers the cost as much as its slope promises (Armijo)."""
        durations, change = self._durations(times), self._spans @ step
        cost = self._costs.value(durations)
        slope = float(self._costs.derivatives(durations)[0] @ change)
        part = 1.0
        while self._costs.value(durations + part * change) > cost + 0.1 * part * slope and part > 1e-9:
            part /= 2
        return part

    def _durations(self, times: Array) -> Array:
        return np.asarray(self._spans @ times + self._shifts, dtype=np.float64)


def _differences(plus: Sequence[int], minus: Sequence[int], size: int) -> Array:
    """A row each for ``x[plus] - x[minus]``, without the column of the first variable."""
    matrix = np.zeros((len(plus), size))
    lines = np.arange(len(plus))
    matrix[lines, list(plus)] = 1.0
    matrix[lines, list(minus)] = -1.0
    return matrix[:, 1:]
