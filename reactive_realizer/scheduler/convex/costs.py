"""The cost of stretching phases, a smooth convex function of their durations."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.scheduler.convex.spans import Span

Array = NDArray[np.float64]

STIFFNESS = 0.05
"""Weight of a hold relative to an elastic phase: holds are stretched first, the other phases then by 5 % at most."""

SLACK = 1.0
"""Added to the duration of a hold (s), so that it may become 0."""


class Costs:
    """The costs of some spans, of durations ``d`` (s) against goals ``g``.

    Elastic: ``d - g - g ln(d / g)``: strictly convex, never reaches 0, and exactly uniform on one chain, where the
    square of the deviation lets short phases collapse. A span with a guide has ``g = D / D' d'``, the guide's stretch
    (SmartBody's rule, thesis 8.7.3): the perspective of the same function, so jointly convex. A hold:
    ``STIFFNESS (d - g - (g + SLACK) ln((d + SLACK) / (g + SLACK)))``.

    Attributes:
        slack: s, of each span; d + slack stays above 0.
    """

    def __init__(self, spans: Sequence[Span]) -> None:
        elastic = np.array([span.elastic for span in spans])
        self.slack = np.where(elastic, 0.0, SLACK)
        self._weights = np.where(elastic, 1.0, STIFFNESS)
        self._goals = np.array([span.goal for span in spans])
        numbers = {span: number for number, span in enumerate(spans)}
        guided = [(number, numbers[g]) for span, number in numbers.items() if (g := span.guide) in numbers]
        self._followers = np.array([follower for follower, _ in guided], dtype=np.intp)
        self._guides = np.array([guide for _, guide in guided], dtype=np.intp)
        preferred = np.array([span.preferred for span in spans])
        self._scales = preferred[self._followers] / preferred[self._guides]

    def value(self, durations: Array) -> float:
        """The sum of all costs."""
        goals, d = self._goals_at(durations) + self.slack, durations + self.slack
        return float(np.sum(self._weights * (d - goals - goals * np.log(d / goals))))

    def derivatives(self, durations: Array) -> tuple[Array, Array]:
        """Gradient and Hessian, both by durations."""
        goals, d = self._goals_at(durations) + self.slack, durations + self.slack
        gradient = self._weights * (1 - goals / d)
        hessian = np.diag(self._weights * goals / d**2)
        f, g, scales = self._followers, self._guides, self._scales
        np.add.at(gradient, g, -scales * np.log(d[f] / goals[f]))
        np.add.at(hessian, (g, g), scales**2 / goals[f])
        np.add.at(hessian, (f, g), -scales / d[f])
        np.add.at(hessian, (g, f), -scales / d[f])
        return gradient, hessian

    def rough(self) -> tuple[Array, Array]:
        """Goals, and the curvature there without guides, for the first step."""
        return self._goals, self._weights / (self._goals + self.slack)

    def _goals_at(self, durations: Array) -> Array:
        goals = self._goals.copy()
        goals[self._followers] = self._scales * durations[self._guides]
        return goals
