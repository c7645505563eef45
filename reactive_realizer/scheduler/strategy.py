"""Scheduling strategies (thesis 7.3.5.1)."""

from collections.abc import Collection, Container, Iterator
from dataclasses import replace
from typing import Protocol

from reactive_realizer.scheduler.faults import NamesDropped
from reactive_realizer.scheduler.peg_layout.peg_layout import PegLayout
from reactive_realizer.scheduler.problem import Point, SchedulingProblem
from reactive_realizer.scheduler.solution import Loss, Solution, lost_constraint


class SchedulingStrategy(Protocol):
    """Finds times for the points of a block; it knows nothing about modalities and pegs.

    Attributes:
        name: by which users choose it.
    """

    name: str

    def solve(self, problem: SchedulingProblem) -> Solution:
        """A plan, and the losses of what it cannot keep."""
        ...


def solve(strategy: SchedulingStrategy, problem: SchedulingProblem) -> Solution:
    """A plan by a strategy: first the behaviors with preferences, then those without, given the times of the others.

    So behaviors without preferences move no others (docs/semantics.md, scheduling).
    """
    free = {item.behavior.id for item in problem.items if item.timing.free}
    if not free:
        return strategy.solve(problem)
    first = problem.only(lambda item: not item.timing.free, lambda each: not each.names(free))
    solution = strategy.solve(first)
    lost = {item.behavior.id for item in first.items} - solution.behaviors
    following = problem.only(lambda item: item.timing.free, lambda each: each.names(free) and not each.names(lost))
    rest = strategy.solve(replace(following, placed=PegLayout(first, solution).times))
    losses = (*solution.losses, *_orphans(problem, free, lost), *rest.losses)
    return Solution({**solution.times, **rest.times}, losses)


def _orphans(problem: SchedulingProblem, free: Container[str], lost: Collection[str]) -> Iterator[Loss]:
    """The losses of required constraints between a behavior without preferences and one that is lost."""
    for each in problem.constraints:
        if each.required and each.names(free) and each.names(lost):
            named = {node.behavior for node in each.nodes if isinstance(node, Point)}.intersection(lost)
            yield lost_constraint(each, NamesDropped(constraint=each.text, behavior=min(named)))
