"""Compiles formulas to one Python function of floats."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence

from reactive_realizer.engines.animation.expression.syntax import (
    Call,
    Conditional,
    Constant,
    Formula,
    Negation,
    Operation,
    Variable,
    children,
    walk,
)

Compiled = Callable[..., tuple[float, ...]]
"""Takes the values of the names, in order; returns the value of each formula.

May raise ArithmeticError or ValueError where a formula has no value: 1/0, log(-1), exp(1000).
"""


def compile_formulas(formulas: Sequence[Formula], names: Sequence[str]) -> Compiled:
    """Compile all formulas of an animation to one function; equal formulas (fifteen fingers) are evaluated once.

    The source is generated from the tree alone: numbers as their `repr`, names by their index.

    Args:
        formulas: trees whose variables are all among the names.
        names: parameters of the function.

    Raises:
        KeyError: a formula has another variable.
    """
    arguments = {name: f"p{i}" for i, name in enumerate(names)}
    folded = [fold(formula) for formula in formulas]
    results = {node: f"r{i}" for i, node in enumerate(dict.fromkeys(folded))}
    lines = [f"def formulas({', '.join(arguments.values())}):"]
    lines += [f" {result} = {_source(node, arguments)}" for node, result in results.items()]
    lines += [f" return ({''.join(f'{results[node]}, ' for node in folded)})"]
    scope = _scope(folded)
    exec("\n".join(lines), scope)
    compiled: Compiled = scope["formulas"]  # type: ignore[assignment]
    return compiled


def _scope(formulas: Iterable[Formula]) -> dict[str, object]:
    """Return the functions that formulas call, by their names in the source."""
    calls = (node for formula in formulas for node in walk(formula) if isinstance(node, Call))
    # Without the first entry Python would add its built-in functions.
    return {
        "__builtins__": {},
        "_power": math.pow,
        "_rest": math.fmod,
        **{f"f_{call.name}": call.function.call for call in calls},
    }


def fold(node: Formula) -> Formula:
    """Fold constants; subtrees without a value are left to be evaluated later."""
    match node:
        case Constant() | Variable():
            return node
        case Negation(operand):
            node = Negation(fold(operand))
        case Operation(operator, left, right):
            node = Operation(operator, fold(left), fold(right))
        case Conditional(condition, yes, no):
            node = Conditional(fold(condition), fold(yes), fold(no))
        case Call(name, function, arguments):
            node = Call(name, function, tuple(map(fold, arguments)))
    if all(isinstance(child, Constant) for child in children(node)):
        try:
            value = float(eval(_source(node, {}), _scope([node])))
        except (ArithmeticError, ValueError):
            return node
        if math.isfinite(value):
            return Constant(value)
    return node


def _source(node: Formula, arguments: Mapping[str, str]) -> str:
    """Return the Python source of a formula, with parentheses wherever they could matter."""
    match node:
        case Constant(value):
            # repr gives the same float; for infinity there is only an overflowing literal.
            return repr(value) if math.isfinite(value) else "1e999"
        case Variable(name):
            return arguments[name]
        case Negation(operand):
            return f"(-{_source(operand, arguments)})"
        case Operation(operator, left, right):
            parts = (_source(part, arguments) for part in (left, right))
            return _OPERATIONS.get(operator, f"({{}} {operator} {{}})").format(*parts)
        case Conditional(condition, yes, no):
            parts = (_source(part, arguments) for part in (yes, condition, no))
            return "({} if {} > 0 else {})".format(*parts)
        case Call(name, _, given):
            return f"f_{name}({', '.join(_source(argument, arguments) for argument in given)})"


_OPERATIONS: Mapping[str, str] = {
    "^": "_power({}, {})",
    "%": "_rest({}, {})",
    "&&": "({} != 0 and {} != 0)",
    "||": "({} != 0 or {} != 0)",
}
"""Operators that are spelled differently in Python. Truth values count as 1 and 0 there too."""
