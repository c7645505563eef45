"""The interface of scheduling strategies (thesis 7.3.5.1)."""

from typing import Protocol

from reactive_realizer.scheduler.problem import Problem, Solution


class SchedulingStrategy(Protocol):
    """Times a block; it knows points, ties and preferences, and nothing of modalities.

    Attributes:
        name: by which users choose it.
    """

    name: str

    def solve(self, problem: Problem) -> Solution:
        """A plan for as much of the problem as can be met; it writes nothing anywhere."""
        ...
