"""The output of a strategy: the times of points, and the losses."""

from collections.abc import Mapping
from collections.abc import Set as AbstractSet
from dataclasses import dataclass, replace
from functools import cached_property

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.errors import Fault
from reactive_realizer.scheduler.problem import Point, Precedence, SchedulingProblem, Tie


@dataclass(frozen=True, slots=True)
class Loss:
    """A behavior or constraint that a plan had to drop, with the reason.

    Attributes:
        behavior: id of the behavior, None for a constraint of the block.
        dropped: whether the behavior itself is lost, not only a constraint of it.
        required: whether the block fails because of it.
        constraint: the one that is lost, if it is one.
    """

    behavior: str | None
    fault: Fault
    dropped: bool
    required: bool
    constraint: Tie | Precedence | None = None


@dataclass(frozen=True)
class Solution:
    """A plan: a time for each point of the behaviors that are kept.

    Attributes:
        times: s after the predicted start of the block. Points that depend on an unknown time from outside have the
            times that suit the plan best.
        losses: the behaviors and constraints that are not kept.
    """

    times: Mapping[Point, float]
    losses: tuple[Loss, ...]

    @cached_property
    def behaviors(self) -> AbstractSet[str]:
        """Ids of the behaviors that are kept."""
        return {point.behavior for point in self.times}

    def kept_of(self, problem: SchedulingProblem) -> SchedulingProblem:
        """Its problem without the losses, and without the constraints on lost behaviors."""
        behaviors, lost = self.behaviors, {id(loss.constraint) for loss in self.losses}
        gone = {item.behavior.id for item in problem.items} - behaviors
        if not gone and not lost:
            return problem
        return problem.only(
            lambda item: item.behavior.id in behaviors,
            lambda constraint: id(constraint) not in lost and not constraint.names(gone),
        )


def lost_behavior(behavior: Behavior, fault: Fault) -> Loss:
    """The loss of a behavior."""
    located = fault.located(behavior.location.line, behavior.location.column)
    return Loss(behavior.id, located, dropped=True, required=behavior.required)


def lost_constraint(constraint: Tie | Precedence, fault: Fault) -> Loss:
    """The loss of a constraint, reported for the behavior that states it, or for its block."""
    owner = constraint.owner if isinstance(constraint, Tie) else None
    located = fault.located(constraint.location.line, constraint.location.column)
    return Loss(owner, located, dropped=False, required=constraint.required, constraint=constraint)


def with_required(loss: Loss, problem: SchedulingProblem) -> Loss:
    """The same loss; if a behavior is lost that a required constraint names, the block fails."""
    if not loss.dropped:
        return loss
    named = set[str]().union(*(each.behaviors for each in problem.constraints if each.required))
    return replace(loss, required=loss.required or loss.behavior in named)
