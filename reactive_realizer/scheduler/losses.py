"""What could not be kept, each with its place in the document."""

from dataclasses import replace

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.errors import Fault
from reactive_realizer.scheduler.problem import Loss, Point, Precedence, SchedulingProblem, Tie


def lost_behavior(behavior: Behavior, fault: Fault, *, needed: bool = False) -> Loss:
    """A behavior that is dropped.

    Args:
        behavior: which.
        fault: why.
        needed: whether something required goes with it.
    """
    located = fault.located(behavior.location.line, behavior.location.column)
    return Loss(behavior.id, located, dropped=True, required=behavior.required or needed)


def lost_constraint(constraint: Tie | Precedence, fault: Fault) -> Loss:
    """A constraint that is not kept; it is told of the behavior that names it, or of its block."""
    owner = constraint.owner if isinstance(constraint, Tie) else None
    located = fault.located(constraint.location.line, constraint.location.column)
    return Loss(owner, located, dropped=False, required=constraint.required, constraint=constraint)


def with_required(loss: Loss, problem: SchedulingProblem) -> Loss:
    """The same; the loss of a behavior fails the block if a required constraint names it, for that is lost with it."""
    if not loss.dropped:
        return loss
    constraints: list[Tie | Precedence] = [*problem.ties, *problem.orders]
    required = (node for each in constraints if each.required for node in each.nodes)
    named = {node.behavior for node in required if isinstance(node, Point)}
    return replace(loss, required=loss.required or loss.behavior in named)
