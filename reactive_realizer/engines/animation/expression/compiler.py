"""From trees to one Python function of floats."""

import math
from collections.abc import Callable, Mapping, Sequence

from reactive_realizer.engines.animation.expression.functions import FUNCTIONS
from reactive_realizer.engines.animation.expression.nodes import (
    Call,
    Choice,
    Negation,
    Node,
    Number,
    Operation,
    Variable,
    children,
)

Compiled = Callable[..., tuple[float, ...]]
"""Takes the values of the names it was compiled with, in their order; gives the value of each formula.

May raise ArithmeticError or ValueError where a formula has no value: 1/0, log(-1), exp(1000).
"""

_SCOPE: dict[str, object] = {
    # Without this entry Python would add its own functions.
    "__builtins__": {},
    "_power": math.pow,
    **{f"_{name}": function.call for name, function in FUNCTIONS.items()},
}


def compile_formulas(formulas: Sequence[Node], names: Sequence[str]) -> Compiled:
    """One function for all formulas of an animation; equal formulas (fifteen fingers) are computed once.

    The source is written from the tree alone: numbers as their `repr`, names by their place, functions from the table.

    Args:
        formulas: trees whose variables are all among the names.
        names: the function's parameters.

    Raises:
        KeyError: a formula has a variable that is not among the names.
    """
    arguments = {name: f"p{i}" for i, name in enumerate(names)}
    folded = [fold(formula) for formula in formulas]
    results = {node: f"r{i}" for i, node in enumerate(dict.fromkeys(folded))}
    lines = [f"def formulas({', '.join(arguments.values())}):"]
    lines += [f" {result} = {_source(node, arguments)}" for node, result in results.items()]
    lines += [f" return ({''.join(f'{results[node]}, ' for node in folded)})"]
    scope = dict(_SCOPE)
    exec("\n".join(lines), scope)
    compiled: Compiled = scope["formulas"]  # type: ignore[assignment]
    return compiled


def fold(node: Node) -> Node:
    """The same formula, with what is constant worked out; what has no value stays for whoever evaluates it."""
    match node:
        case Number() | Variable():
            return node
        case Negation(operand):
            node = Negation(fold(operand))
        case Operation(operator, left, right):
            node = Operation(operator, fold(left), fold(right))
        case Choice(condition, yes, no):
            node = Choice(fold(condition), fold(yes), fold(no))
        case Call(function, arguments):
            node = Call(function, tuple(map(fold, arguments)))
    if all(isinstance(child, Number) for child in children(node)):
        try:
            value = float(eval(_source(node, {}), dict(_SCOPE)))
        except (ArithmeticError, ValueError):
            return node
        if math.isfinite(value):
            return Number(value)
    return node


def _source(node: Node, arguments: Mapping[str, str]) -> str:
    """A formula as Python, in parentheses wherever they could matter."""
    match node:
        case Number(value):
            # repr gives back the same float; 1e999 has no other name in Python.
            return repr(value) if math.isfinite(value) else "1e999"
        case Variable(name):
            return arguments[name]
        case Negation(operand):
            return f"(-{_source(operand, arguments)})"
        case Operation("^", left, right):
            return f"_power({_source(left, arguments)}, {_source(right, arguments)})"
        case Operation(operator, left, right):
            return f"({_source(left, arguments)} {operator} {_source(right, arguments)})"
        case Choice(condition, yes, no):
            parts = (_source(part, arguments) for part in (yes, condition, no))
            return "({} if {} > 0 else {})".format(*parts)
        case Call(function, given):
            return f"_{function}({', '.join(_source(argument, arguments) for argument in given)})"
