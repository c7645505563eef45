"""What is given up where not everything can be kept, and what is told of it."""

from collections.abc import Iterable

from reactive_realizer.errors import Fault
from reactive_realizer.scheduler.convex.case import Case, Stage
from reactive_realizer.scheduler.convex.causes import GIVEN, Cause, Clash, Rank
from reactive_realizer.scheduler.losses import lost_behavior, lost_constraint
from reactive_realizer.scheduler.problem import Loss, Order, Point, Tie


class GivingUp:
    """Limits first, then before/after, then `at`, then behaviors; of several, the last one; required things never.

    (docs/semantics.md, scheduling.) Where only required things are left, the loss of one fails the block.

    Attributes:
        things: all that was given up.
        losses: what is told of it; nothing of lengths and limits, which are wishes.
    """

    def __init__(self, case: Case) -> None:
        self._case = case
        self.things: set[Cause] = set()
        self.losses: list[Loss] = []

    def resolve(self, stage: Stage, clashes: Iterable[Clash]) -> None:
        """Give up one thing of each clash."""
        for clash in clashes:
            if not clash.causes & self.things:
                self._resolve(stage, clash)

    def _resolve(self, stage: Stage, clash: Clash) -> None:
        droppable = [cause for cause in clash.causes if cause.rank is not Rank.GIVEN]
        kept = self._kept(stage, clash)
        choice = [cause for cause in droppable if cause not in kept] or droppable
        lowest = min(cause.rank for cause in choice)
        dropped = max(cause for cause in choice if cause.rank is lowest)
        self.things |= self._with(dropped)
        if dropped.rank > Rank.LIMIT:
            self.losses.append(self._loss(dropped, clash))

    def _with(self, dropped: Cause) -> set[Cause]:
        """What goes with it: without one of its limits a behavior is stretched evenly only without the others too."""
        if dropped.rank is not Rank.LIMIT:
            return {dropped}
        phases = range(len(self._case.items[dropped.number].timing.phases))
        return {dropped._replace(phase=phase) for phase in phases}

    def report_orphans(self) -> None:
        """Required constraints that name a behavior that was given up are lost with it."""
        lost = {self._case.items[cause.number].behavior.id for cause in self.things if cause.rank is Rank.BEHAVIOR}
        if not lost:
            return
        constraints: list[Tie | Order] = [*self._case.ties, *self._case.orders]
        told = [loss.constraint for loss in self.losses]
        for each in constraints:
            named = {node.behavior for node in each.nodes if isinstance(node, Point)} & lost
            if each.required and named and each not in told:
                fault = Fault("names-dropped", {"constraint": each.text, "behavior": min(named)})
                self.losses.append(lost_constraint(each, fault))

    def _kept(self, stage: Stage, clash: Clash) -> set[Cause]:
        """What is required, and the behaviors that required constraints name."""
        kept = {cause for cause in clash.causes if self._required(cause)}
        needed = [each for cause in kept if (each := self._constraint(cause)) is not None]
        names = {node.behavior for each in needed for node in each.nodes if isinstance(node, Point)}
        return kept | {Cause(Rank.BEHAVIOR, i) for i, item in stage.items.items() if item.behavior.id in names}

    def _required(self, cause: Cause) -> bool:
        if cause.rank is Rank.BEHAVIOR:
            return self._case.items[cause.number].behavior.required
        constraint = self._constraint(cause)
        return constraint is not None and constraint.required

    def _constraint(self, cause: Cause) -> Tie | Order | None:
        if cause.rank is Rank.TIE:
            return self._case.ties[cause.number]
        return self._case.orders[cause.number] if cause.rank is Rank.ORDER else None

    def _loss(self, dropped: Cause, clash: Clash) -> Loss:
        constraint = self._constraint(dropped)
        if constraint is None:
            behavior = self._case.items[dropped.number].behavior
            return lost_behavior(behavior, self._behavior_fault(dropped, clash))
        return lost_constraint(constraint, self._constraint_fault(dropped, constraint, clash))

    def _behavior_fault(self, dropped: Cause, clash: Clash) -> Fault:
        if clash.late:
            return Fault("all-past", {"late": clash.gap})
        if clash.causes == {dropped}:
            return Fault("too-short")
        if clash.causes == {dropped, GIVEN}:
            return Fault("before-block", {"early": clash.gap})
        return self._clash_fault(dropped, clash)

    def _constraint_fault(self, dropped: Cause, constraint: Tie | Order, clash: Clash) -> Fault:
        behaviors = [self._case.items[cause.number] for cause in clash.causes if cause.rank is Rank.BEHAVIOR]
        if clash.outer:
            return Fault("outer-tie", {"tie": constraint.text})
        if all(cause.rank is Rank.TIE for cause in clash.causes):
            return Fault("contradictory-tie", {"tie": constraint.text, "gap": clash.gap})
        rigid = [item.behavior.id for item in behaviors if item.timing.rigid]
        points = [n for n in constraint.nodes if isinstance(n, Point) and n.behavior in rigid]
        if points and len(rigid) == len(behaviors) and isinstance(constraint, Tie):
            return Fault("rigid", {"point": ":".join(points[0]), "tie": constraint.text, "gap": clash.gap})
        return self._clash_fault(dropped, clash)

    def _clash_fault(self, dropped: Cause, clash: Clash) -> Fault:
        others = ", ".join(self._name(cause) for cause in sorted(clash.causes - {dropped}) if cause.rank > Rank.LENGTH)
        if not others:
            return Fault("never-holds", {"what": self._name(dropped), "gap": clash.gap})
        return Fault("clash", {"what": self._name(dropped), "others": others, "gap": clash.gap})

    def _name(self, cause: Cause) -> str:
        constraint = self._constraint(cause)
        if constraint is not None:
            return constraint.text
        if cause.rank is Rank.GIVEN:
            return "the start of the block"
        item = self._case.items[cause.number]
        if cause.rank is Rank.LIMIT:
            points = item.timing.points
            return f"the limits of {item.behavior.id} from {points[cause.phase]} to {points[cause.phase + 1]}"
        return item.behavior.id
