"""Scheduling strategies (thesis 7.3.5.1)."""

from collections.abc import Collection, Container, Iterator
from dataclasses import replace
from typing import Protocol

from reactive_realizer.bml.reference_faults import LostWith
from reactive_realizer.scheduler.faults import NamesDropped
from reactive_realizer.scheduler.peg_layout.peg_layout import PegLayout
from reactive_realizer.scheduler.problem import SchedulingProblem
from reactive_realizer.scheduler.solution import Loss, Solution, lost_behavior, lost_constraint, with_required


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
    """A plan by a strategy, without the behaviors that depend on one that it drops (docs/semantics.md, pegs)."""
    solution = _solve(strategy, problem)
    lost = {item.behavior.id for item in problem.items} - solution.behaviors
    orphans = dict(_orphans(problem, lost))
    if not orphans:
        return solution
    gone = lost | orphans.keys()
    rest = solve(strategy, problem.only(lambda item: item.behavior.id not in gone, lambda each: not each.names(gone)))
    told = [loss for loss in solution.losses if _concerns(loss, gone)]
    return Solution(rest.times, (*told, *orphans.values(), *rest.losses))


def _solve(strategy: SchedulingStrategy, problem: SchedulingProblem) -> Solution:
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
    losses = (*solution.losses, *_names_dropped(problem, free, lost), *rest.losses)
    return Solution({**solution.times, **rest.times}, losses)


def _names_dropped(problem: SchedulingProblem, free: Container[str], lost: Collection[str]) -> Iterator[Loss]:
    """The losses of required constraints between a behavior without preferences and one that is lost."""
    for each in problem.constraints:
        if each.required and each.names(free) and each.names(lost):
            named = each.behaviors.intersection(lost)
            yield lost_constraint(each, NamesDropped(constraint=each.text, behavior=min(named)))


def _orphans(problem: SchedulingProblem, lost: Collection[str]) -> Iterator[tuple[str, Loss]]:
    """The behaviors that name a lost one, directly or not, each with its loss, which names the first lost one."""
    causes = {id_: id_ for id_ in lost}
    left = [item.behavior for item in problem.items if item.behavior.id not in causes]
    while left:
        named = [
            (each, ref) for each in left for ref in each.syncs.values() if ref.block is None and ref.behavior in causes
        ]
        if not named:
            return
        behavior, ref = named[0]
        causes[behavior.id] = causes[ref.behavior or ""]
        left.remove(behavior)
        fault = LostWith(behavior=causes[behavior.id], reference=str(ref))
        yield behavior.id, with_required(lost_behavior(behavior, fault), problem)


def _concerns(loss: Loss, behaviors: Container[str]) -> bool:
    return loss.behavior in behaviors or (loss.constraint is not None and loss.constraint.names(behaviors))
