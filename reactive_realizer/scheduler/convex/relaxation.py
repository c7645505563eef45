"""What is given up where not everything can be kept, and what is told of it."""

from collections.abc import Iterable

from reactive_realizer.errors import Fault
from reactive_realizer.planunit.timing import TooShort
from reactive_realizer.scheduler.convex.conflict import GIVEN, Conflict, Rank, Requirement
from reactive_realizer.scheduler.convex.relaxed_problem import RelaxedProblem
from reactive_realizer.scheduler.faults import (
    AllPast,
    BeforeBlock,
    Conflicting,
    ContradictoryTie,
    NamesDropped,
    NeverHolds,
    OuterTie,
    Rigid,
)
from reactive_realizer.scheduler.losses import lost_behavior, lost_constraint
from reactive_realizer.scheduler.problem import Loss, Point, Precedence, SchedulingProblem, Tie


class Relaxation:
    """Limits first, then before/after, then `at`, then behaviors; of several, the last one; required things never.

    (docs/semantics.md, scheduling.) Where only required things are left, the loss of one fails the block.

    Attributes:
        things: all that was given up.
        losses: what is told of it; nothing of lengths and limits, which are wishes.
    """

    def __init__(self, problem: SchedulingProblem) -> None:
        self._problem = problem
        self.things: set[Requirement] = set()
        self.losses: list[Loss] = []

    def resolve(self, relaxed: RelaxedProblem, conflicts: Iterable[Conflict]) -> None:
        """Give up one thing of each conflict."""
        for conflict in conflicts:
            if not conflict.requirements & self.things:
                self._resolve(relaxed, conflict)

    def _resolve(self, relaxed: RelaxedProblem, conflict: Conflict) -> None:
        droppable = [requirement for requirement in conflict.requirements if requirement.rank is not Rank.GIVEN]
        kept = self._kept(relaxed, conflict)
        choice = [requirement for requirement in droppable if requirement not in kept] or droppable
        lowest = min(requirement.rank for requirement in choice)
        dropped = max(requirement for requirement in choice if requirement.rank is lowest)
        self.things |= self._with(dropped)
        if dropped.rank > Rank.LIMIT:
            self.losses.append(self._loss(dropped, conflict))

    def _with(self, dropped: Requirement) -> set[Requirement]:
        """What goes with it: without one of its limits a behavior is stretched evenly only without the others too."""
        if dropped.rank is not Rank.LIMIT:
            return {dropped}
        phases = range(len(self._problem.items[dropped.number].timing.phases))
        return {dropped._replace(phase=phase) for phase in phases}

    def report_orphans(self) -> None:
        """Required constraints that name a behavior that was given up are lost with it."""
        lost = {
            self._problem.items[requirement.number].behavior.id
            for requirement in self.things
            if requirement.rank is Rank.BEHAVIOR
        }
        if not lost:
            return
        constraints: list[Tie | Precedence] = [*self._problem.constraints]
        told = [loss.constraint for loss in self.losses]
        for each in constraints:
            named = {node.behavior for node in each.nodes if isinstance(node, Point)} & lost
            if each.required and named and each not in told:
                fault = NamesDropped(constraint=each.text, behavior=min(named))
                self.losses.append(lost_constraint(each, fault))

    def _kept(self, relaxed: RelaxedProblem, conflict: Conflict) -> set[Requirement]:
        """What is required, and the behaviors that required constraints name."""
        kept = {requirement for requirement in conflict.requirements if self._required(requirement)}
        needed = [each for requirement in kept if (each := self._constraint(requirement)) is not None]
        names = {node.behavior for each in needed for node in each.nodes if isinstance(node, Point)}
        return kept | {Requirement(Rank.BEHAVIOR, i) for i, item in relaxed.items.items() if item.behavior.id in names}

    def _required(self, requirement: Requirement) -> bool:
        if requirement.rank is Rank.BEHAVIOR:
            return self._problem.items[requirement.number].behavior.required
        constraint = self._constraint(requirement)
        return constraint is not None and constraint.required

    def _constraint(self, requirement: Requirement) -> Tie | Precedence | None:
        if requirement.rank is Rank.TIE:
            return self._problem.ties[requirement.number]
        return self._problem.orders[requirement.number] if requirement.rank is Rank.ORDER else None

    def _loss(self, dropped: Requirement, conflict: Conflict) -> Loss:
        constraint = self._constraint(dropped)
        if constraint is None:
            behavior = self._problem.items[dropped.number].behavior
            return lost_behavior(behavior, self._behavior_fault(dropped, conflict))
        return lost_constraint(constraint, self._constraint_fault(dropped, constraint, conflict))

    def _behavior_fault(self, dropped: Requirement, conflict: Conflict) -> Fault:
        if conflict.late:
            return AllPast(late=conflict.gap)
        if conflict.requirements == {dropped}:
            return TooShort()
        if conflict.requirements == {dropped, GIVEN}:
            return BeforeBlock(early=conflict.gap)
        return self._conflict_fault(dropped, conflict)

    def _constraint_fault(self, dropped: Requirement, constraint: Tie | Precedence, conflict: Conflict) -> Fault:
        behaviors = [
            self._problem.items[requirement.number]
            for requirement in conflict.requirements
            if requirement.rank is Rank.BEHAVIOR
        ]
        if conflict.outer:
            return OuterTie(tie=constraint.text)
        if all(requirement.rank is Rank.TIE for requirement in conflict.requirements):
            return ContradictoryTie(tie=constraint.text, gap=conflict.gap)
        rigid = [item.behavior.id for item in behaviors if item.timing.rigid]
        points = [n for n in constraint.nodes if isinstance(n, Point) and n.behavior in rigid]
        if points and len(rigid) == len(behaviors) and isinstance(constraint, Tie):
            return Rigid(point=":".join(points[0]), tie=constraint.text, gap=conflict.gap)
        return self._conflict_fault(dropped, conflict)

    def _conflict_fault(self, dropped: Requirement, conflict: Conflict) -> Fault:
        others = ", ".join(
            self._name(requirement)
            for requirement in sorted(conflict.requirements - {dropped})
            if requirement.rank > Rank.LENGTH
        )
        if not others:
            return NeverHolds(what=self._name(dropped), gap=conflict.gap)
        return Conflicting(what=self._name(dropped), others=others, gap=conflict.gap)

    def _name(self, requirement: Requirement) -> str:
        constraint = self._constraint(requirement)
        if constraint is not None:
            return constraint.text
        if requirement.rank is Rank.GIVEN:
            return "the start of the block"
        item = self._problem.items[requirement.number]
        if requirement.rank is Rank.LIMIT:
            points = item.timing.points
            return (
                f"the limits of {item.behavior.id} from {points[requirement.phase]} to {points[requirement.phase + 1]}"
            )
        return item.behavior.id
