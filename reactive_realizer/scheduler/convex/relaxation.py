"""The requirements that are given up if not all can be satisfied, and the losses that explain this."""

from collections.abc import Iterable, Iterator

from reactive_realizer.errors import Fault
from reactive_realizer.planunit.timing import Timing, TooShort
from reactive_realizer.scheduler.convex.conflicts import Conflict, Rank, Requirement
from reactive_realizer.scheduler.faults import (
    Conflicting,
    ContradictoryTie,
    NamesDropped,
    NeverHolds,
    OuterTieDropped,
    Rigid,
    TooHurried,
)
from reactive_realizer.scheduler.problem import Point, Precedence, SchedulingProblem, Tie
from reactive_realizer.scheduler.solution import Loss, lost_behavior, lost_constraint


def limits_of(behavior: int, timing: Timing) -> Iterator[Requirement]:
    """The limits of all phases of a behavior, and of the whole."""
    return (Requirement(Rank.LIMIT, behavior, phase) for phase in range(len(timing.phases) + 1))


class Relaxation:
    """Gives up limits first, then before/after, then ties, then behaviors; the last of several; required ones never.

    (docs/semantics.md, scheduling.) If only required ones are left, the loss of one fails the block.

    Args:
        problem: in canonical order.
        left_out: requirements that are not looked at.

    Attributes:
        dropped: the requirements that were given up.
        losses: the explanations; there is none for lengths and limits.
    """

    def __init__(self, problem: SchedulingProblem, left_out: Iterable[Requirement] = ()) -> None:
        self._problem = problem
        self.dropped = set(left_out)
        self.losses: list[Loss] = []

    def resolve(self, conflicts: Iterable[Conflict]) -> None:
        """Give up one requirement of each conflict."""
        for conflict in conflicts:
            if not conflict.requirements & self.dropped:
                self._resolve(conflict)

    def report_orphans(self) -> None:
        """Report the required constraints on behaviors that were given up: they are lost with these."""
        lost = {self._problem.items[each.number].behavior.id for each in self.dropped if each.rank is Rank.BEHAVIOR}
        told = [loss.constraint for loss in self.losses]
        for constraint in self._problem.constraints if lost else ():
            if constraint.required and constraint not in told and (named := constraint.behaviors & lost):
                fault = NamesDropped(constraint=constraint.text, behavior=min(named))
                self.losses.append(lost_constraint(constraint, fault))

    def _resolve(self, conflict: Conflict) -> None:
        conflict = conflict.out_of_order
        # A behavior is only in conflict with others, or with the start of the block, by constraints, which go first.
        droppable = [each for each in conflict.requirements if each.rank is not Rank.GIVEN]
        ranks = {each: (self._is_required(each), each.rank) for each in droppable}
        least = [each for each in droppable if ranks[each] == min(ranks.values())]
        dropped = max(self._of_hurried(least, conflict) or least)
        self.dropped.add(dropped)
        if dropped.rank is Rank.LIMIT:  # the limits of a behavior go together, so that it is stretched evenly
            self.dropped.update(limits_of(dropped.number, self._problem.items[dropped.number].timing))
        if dropped.rank > Rank.LIMIT:
            self.losses.append(self._loss(dropped, conflict))

    def _of_hurried(self, requirements: Iterable[Requirement], conflict: Conflict) -> list[Requirement]:
        """The constraints that name a behavior with too little time."""
        hurried = {self._problem.items[need.behavior].behavior.id for need in conflict.needs}
        named = ((each, self._constraint(each)) for each in requirements)
        return [each for each, constraint in named if constraint is not None and constraint.names(hurried)]

    def _is_required(self, requirement: Requirement) -> bool:
        constraint = self._constraint(requirement)
        return requirement.rank is Rank.BEHAVIOR or (constraint is not None and constraint.required)

    def _constraint(self, requirement: Requirement) -> Tie | Precedence | None:
        if requirement.rank is Rank.TIE:
            return self._problem.ties[requirement.number]
        return self._problem.orders[requirement.number] if requirement.rank is Rank.ORDER else None

    # --- explanations

    def _loss(self, dropped: Requirement, conflict: Conflict) -> Loss:
        constraint = self._constraint(dropped)
        if constraint is not None:
            return lost_constraint(constraint, self._constraint_fault(dropped, constraint, conflict))
        return lost_behavior(self._problem.items[dropped.number].behavior, TooShort())

    def _constraint_fault(self, dropped: Requirement, constraint: Tie | Precedence, conflict: Conflict) -> Fault:
        if conflict.outer:
            return OuterTieDropped(tie=constraint.text)
        if (hurried := self._hurried(dropped, conflict)) is not None:
            return hurried
        if all(each.rank is Rank.TIE for each in conflict.requirements):
            return ContradictoryTie(tie=constraint.text, gap=conflict.gap)
        items = [self._problem.items[each.number] for each in conflict.requirements if each.rank is Rank.BEHAVIOR]
        rigid = {item.behavior.id for item in items if item.timing.rigid}
        points = [node for node in constraint.nodes if isinstance(node, Point) and node.behavior in rigid]
        if points and len(rigid) == len(items) and isinstance(constraint, Tie):
            return Rigid(point=":".join(points[0]), tie=constraint.text, gap=conflict.gap)
        return self._conflict_fault(dropped, conflict)

    def _hurried(self, dropped: Requirement, conflict: Conflict) -> TooHurried | None:
        """The fault if too little time is left for some phases."""
        if not conflict.needs:
            return None
        items = {index: self._problem.items[index] for index in sorted({each.behavior for each in conflict.needs})}
        phases = []
        for index, item in items.items():
            own = [each for each in conflict.needs if each.behavior == index]
            start, end = min(each.first for each in own), max(each.last for each in own) + 1
            phases.append(f"{item.behavior.id} from {item.timing.points[start]} to {item.timing.points[end]}")
        what, room = self._name(dropped), max(conflict.need - conflict.gap, 0.0)
        return TooHurried(what=what, phases=tuple(phases), need=conflict.need, room=room)

    def _conflict_fault(self, dropped: Requirement, conflict: Conflict) -> Fault:
        others = [each for each in sorted(conflict.requirements - {dropped}) if each.rank > Rank.LENGTH]
        if not others:
            return NeverHolds(what=self._name(dropped), gap=conflict.gap)
        return Conflicting(what=self._name(dropped), others=", ".join(map(self._name, others)), gap=conflict.gap)

    def _name(self, requirement: Requirement) -> str:
        constraint = self._constraint(requirement)
        if constraint is not None:
            return constraint.text
        if requirement.rank is Rank.GIVEN:
            return "the start of the block"
        item = self._problem.items[requirement.number]
        if requirement.rank is Rank.BEHAVIOR:
            return item.behavior.id
        if requirement.phase == len(item.timing.phases):
            return f"the limits of {item.behavior.id}"
        start, end = item.timing.points[requirement.phase : requirement.phase + 2]
        return f"the limits of {item.behavior.id} from {start} to {end}"
