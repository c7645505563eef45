"""What is left of a problem without the requirements that were given up."""

from collections.abc import Collection, Mapping, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass
from typing import TypeVar

from reactive_realizer.scheduler.convex.conflict import Rank, Requirement
from reactive_realizer.scheduler.problem import Item, Node, Origin, Precedence, SchedulingProblem, Tie

C = TypeVar("C", Tie, Precedence)


@dataclass(frozen=True, slots=True)
class RelaxedProblem:
    """Behaviors, and the constraints on them.

    Attributes:
        items: by index in the problem, in order.
        ties: on them.
        orders: on them.
        fixed: the points that these name and whose times (s after the block's start, None while unknown) are given; the
            start of the block is the first.
    """

    items: Mapping[int, Item]
    ties: Mapping[Requirement, Tie]
    orders: Mapping[Requirement, Precedence]
    fixed: Mapping[Node, float | None]

    @classmethod
    def of(cls, problem: SchedulingProblem, relaxed: AbstractSet[Requirement]) -> "RelaxedProblem":
        """What is left of a problem in canonical order without some requirements."""
        items = {k: item for k, item in enumerate(problem.items) if Requirement(Rank.BEHAVIOR, k) not in relaxed}
        lost = {item.behavior.id for k, item in enumerate(problem.items) if k not in items}
        ties = _left(problem.ties, Rank.TIE, lost, relaxed)
        orders = _left(problem.orders, Rank.ORDER, lost, relaxed)
        constraints: list[Tie | Precedence] = [*ties.values(), *orders.values()]
        named, given = (node for each in constraints for node in each.nodes), problem.given
        return cls(items, ties, orders, {node: given[node] for node in (Origin.BLOCK_START, *named) if node in given})


def _left(
    constraints: Sequence[C], rank: Rank, lost: Collection[str], relaxed: AbstractSet[Requirement]
) -> dict[Requirement, C]:
    requirements = {Requirement(rank, index): each for index, each in enumerate(constraints)}
    return {
        requirement: each
        for requirement, each in requirements.items()
        if requirement not in relaxed and not each.names(lost)
    }
