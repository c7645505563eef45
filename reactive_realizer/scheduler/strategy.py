"""Scheduling strategies (thesis 7.3.5.1)."""

from collections.abc import Collection, Container, Iterator
from dataclasses import replace
from typing import Protocol

from reactive_realizer.scheduler.faults import NamesDropped
from reactive_realizer.scheduler.losses import lost_constraint
from reactive_realizer.scheduler.peg_layout.peg_layout import PegLayout
from reactive_realizer.scheduler.problem import Loss, Point, SchedulingProblem, Solution


class SchedulingStrategy(Protocol):
    """Times a block; it knows points, constraints and preferences, and nothing of modalities and pegs.

    Attributes:
        name: by which users choose it.
    """

    name: str

    def solve(self, problem: SchedulingProblem) -> Solution:
        """A plan for as much of the problem as can be kept."""
        ...


def solve(strategy: SchedulingStrategy, problem: SchedulingProblem) -> Solution:
    """A plan by a strategy: first the behaviors with preferences, then those without, for which the others are given.

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
    """Required constraints between a behavior without preferences and one that is lost are lost with that."""
    for each in problem.constraints:
        if each.required and each.names(free) and each.names(lost):
            named = {node.behavior for node in each.nodes if isinstance(node, Point)}.intersection(lost)
            yield lost_constraint(each, NamesDropped(constraint=each.text, behavior=min(named)))
