"""The losses of a plan, each with its place in the document."""

from dataclasses import replace

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.errors import Fault
from reactive_realizer.scheduler.problem import Loss, Point, Precedence, SchedulingProblem, Tie


def lost_behavior(behavior: Behavior, fault: Fault, *, needed: bool = False) -> Loss:
    """The loss of a behavior; ``needed`` says whether a required constraint is lost with it."""
    located = fault.located(behavior.location.line, behavior.location.column)
    return Loss(behavior.id, located, dropped=True, required=behavior.required or needed)


def lost_constraint(constraint: Tie | Precedence, fault: Fault) -> Loss:
    """The loss of a constraint, reported for the behavior that states it, or for its block."""
    owner = constraint.owner if isinstance(constraint, Tie) else None
    located = fault.located(constraint.location.line, constraint.location.column)
    return Loss(owner, located, dropped=False, required=constraint.required, constraint=constraint)


def with_required(loss: Loss, problem: SchedulingProblem) -> Loss:
    """The same loss; if a behavior is lost that a required constraint names, the block fails."""
    if not loss.dropped:
        return loss
    required = (node for each in problem.constraints if each.required for node in each.nodes)
    named = {node.behavior for node in required if isinstance(node, Point)}
    return replace(loss, required=loss.required or loss.behavior in named)
