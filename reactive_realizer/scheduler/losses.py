"""What could not be kept, each with its place in the document."""

from dataclasses import replace

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.errors import Fault
from reactive_realizer.scheduler.problem import Loss, Order, Point, Problem, Solution, Tie


def lost_behavior(behavior: Behavior, fault: Fault, *, needed: bool = False) -> Loss:
    """A behavior that is dropped.

    Args:
        behavior: which.
        fault: why.
        needed: whether something required goes with it.
    """
    located = fault.located(behavior.location.line, behavior.location.column)
    return Loss(behavior.id, located, dropped=True, required=behavior.required or needed)


def lost_constraint(constraint: Tie | Order, fault: Fault) -> Loss:
    """A constraint that is not kept; it is told of the behavior that names it, or of its block."""
    owner = constraint.owner if isinstance(constraint, Tie) else None
    located = fault.located(constraint.location.line, constraint.location.column)
    return Loss(owner, located, dropped=False, required=constraint.required, constraint=constraint)


def with_required(loss: Loss, problem: Problem) -> Loss:
    """The same; the loss of a behavior fails the block if a required constraint names it, for that is lost with it."""
    if not loss.dropped:
        return loss
    constraints: list[Tie | Order] = [*problem.ties, *problem.orders]
    required = (node for each in constraints if each.required for node in each.nodes)
    named = {node.behavior for node in required if isinstance(node, Point)}
    return replace(loss, required=loss.required or loss.behavior in named)


def kept_of(problem: Problem, solution: Solution) -> Problem:
    """What is left of a problem without the losses of its solution."""
    items = tuple(item for item in problem.items if item.behavior.id in solution.pegs)
    kept = solution.kept(problem)
    ties = tuple(each for each in kept if isinstance(each, Tie))
    return Problem(items, ties, problem.times, tuple(each for each in kept if isinstance(each, Order)))
