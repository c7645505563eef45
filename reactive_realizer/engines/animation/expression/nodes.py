"""The tree of a formula: a closed family of node kinds."""

from collections.abc import Iterator
from dataclasses import dataclass

from reactive_realizer.engines.animation.expression.functions import Function


@dataclass(frozen=True, slots=True)
class Number:
    """A constant."""

    value: float


@dataclass(frozen=True, slots=True)
class Variable:
    """Time or a parameter, by name."""

    name: str


@dataclass(frozen=True, slots=True)
class Negation:
    """-operand."""

    operand: "Node"


@dataclass(frozen=True, slots=True)
class Operation:
    """Left operator right; what holds is 1, what does not is 0, and every other number counts as what holds."""

    operator: str
    left: "Node"
    right: "Node"


@dataclass(frozen=True, slots=True)
class Conditional:
    """if(condition, yes, no): yes where the condition is above 0; the other is not looked at."""

    condition: "Node"
    yes: "Node"
    no: "Node"


@dataclass(frozen=True, slots=True)
class Call:
    """A function of some arguments.

    Attributes:
        name: as the formula calls it; no two functions of a formula have the same.
        function: what is called.
        arguments: as many as it accepts.
    """

    name: str
    function: Function
    arguments: tuple["Node", ...]


Node = Number | Variable | Negation | Operation | Conditional | Call


def children(node: Node) -> tuple[Node, ...]:
    """The nodes right under a node."""
    match node:
        case Number() | Variable():
            return ()
        case Negation(operand):
            return (operand,)
        case Operation(_, left, right):
            return (left, right)
        case Conditional(condition, yes, no):
            return (condition, yes, no)
        case Call(_, _, arguments):
            return arguments


def walk(node: Node) -> Iterator[Node]:
    """A node and all under it, in order of appearance."""
    yield node
    for child in children(node):
        yield from walk(child)


def variables(node: Node) -> Iterator[str]:
    """Names in a formula, in order of appearance, each as often as it appears."""
    return (found.name for found in walk(node) if isinstance(found, Variable))
