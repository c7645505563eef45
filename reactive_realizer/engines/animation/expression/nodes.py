"""The tree of a formula: a closed family of node kinds."""

from collections.abc import Iterator
from dataclasses import dataclass


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
    """Left operator right; a comparison is 1 where it holds, else 0."""

    operator: str
    left: "Node"
    right: "Node"


@dataclass(frozen=True, slots=True)
class Choice:
    """if(condition, yes, no): yes where the condition is above 0; the other is not looked at."""

    condition: "Node"
    yes: "Node"
    no: "Node"


@dataclass(frozen=True, slots=True)
class Call:
    """A function of the table `functions.FUNCTIONS`."""

    function: str
    arguments: tuple["Node", ...]


Node = Number | Variable | Negation | Operation | Choice | Call


def children(node: Node) -> tuple[Node, ...]:
    """The nodes right under a node."""
    match node:
        case Number() | Variable():
            return ()
        case Negation(operand):
            return (operand,)
        case Operation(_, left, right):
            return (left, right)
        case Choice(condition, yes, no):
            return (condition, yes, no)
        case Call(_, arguments):
            return arguments


def variables(node: Node) -> Iterator[str]:
    """Names in a formula, in order of appearance, each as often as it appears."""
    if isinstance(node, Variable):
        yield node.name
    for child in children(node):
        yield from variables(child)
