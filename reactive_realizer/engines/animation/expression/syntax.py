"""Syntax of formulas: the tree, and its parser (V. Pratt, "Top down operator precedence", 1973)."""

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import NoReturn

from reactive_realizer.engines.animation.expression.functions import CONSTANTS, FUNCTIONS, Function
from reactive_realizer.engines.animation.faults import BadExpression
from reactive_realizer.errors import RealizerError


@dataclass(frozen=True, slots=True)
class Constant:
    """A constant."""

    value: float


@dataclass(frozen=True, slots=True)
class Variable:
    """Time or a parameter, by name."""

    name: str


@dataclass(frozen=True, slots=True)
class Negation:
    """-operand."""

    operand: "Formula"


@dataclass(frozen=True, slots=True)
class Operation:
    """Left operator right. True is 1, false is 0; every other number counts as true."""

    operator: str
    left: "Formula"
    right: "Formula"


@dataclass(frozen=True, slots=True)
class Conditional:
    """if(condition, yes, no): yes if the condition is above 0; only one of them is evaluated."""

    condition: "Formula"
    yes: "Formula"
    no: "Formula"


@dataclass(frozen=True, slots=True)
class Call:
    """A function call.

    Attributes:
        name: in the formula; unique among its functions.
        function: that is called.
        arguments: as many as it accepts.
    """

    name: str
    function: Function
    arguments: tuple["Formula", ...]


Formula = Constant | Variable | Negation | Operation | Conditional | Call


def children(node: Formula) -> tuple[Formula, ...]:
    """Return the direct children of a node."""
    match node:
        case Constant() | Variable():
            return ()
        case Negation(operand):
            return (operand,)
        case Operation(_, left, right):
            return (left, right)
        case Conditional(condition, yes, no):
            return (condition, yes, no)
        case Call(_, _, arguments):
            return arguments


def walk(node: Formula) -> Iterator[Formula]:
    """Yield a node and all its descendants, in order of appearance."""
    yield node
    for child in children(node):
        yield from walk(child)


def variables(node: Formula) -> Iterator[str]:
    """Yield the names in a formula, in order of appearance, with repetitions."""
    return (found.name for found in walk(node) if isinstance(found, Variable))


LONGEST = 20_000
"""Limit of the characters of a formula; the longest of 96 published animations has 700."""

DEEPEST = 80
"""Limit of nesting. Python's own parser, which compiles the formula in the end, fails at 200 parentheses."""

_TOKEN = re.compile(
    r"\s*(?:(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)|(?P<name>[A-Za-z_]\w*)|(?P<sign><=|>=|==|!=|&&|\|\||[-+*/%^!(),<>]))",
    re.ASCII,
)
# Precedence of operators. A minus sign binds less tightly than a power: -t^2 is -(t^2).
_LEVELS = (("||",), ("&&",), ("==", "!="), ("<", ">", "<=", ">="), ("+", "-"), ("*", "/", "%"), (), ("^",))
_BINDING = {operator: level for level, operators in enumerate(_LEVELS, 1) for operator in operators}
_SIGN = 7
_SIGNED: Mapping[str, Callable[[Formula], Formula]] = {
    "+": lambda operand: operand,
    "-": Negation,
    "!": lambda operand: Operation("==", operand, Constant(0.0)),
}
_END = ""


@dataclass(frozen=True, slots=True)
class _Token:
    """A token of a formula; the end is an empty one."""

    text: str
    kind: str | None
    at: int


def parse(text: str, functions: Mapping[str, Function] = FUNCTIONS) -> Formula:
    """Parse a formula; names that are neither a function nor a constant are variables.

    Args:
        text: the formula.
        functions: that it may call.

    Raises:
        RealizerError: "bad-expression", with position and reason.
    """
    return _Parser(text, functions).whole()


class _Parser:
    def __init__(self, text: str, functions: Mapping[str, Function]) -> None:
        self._text = text
        self._functions = functions
        if len(text) > LONGEST:
            self._fail(f"more than {LONGEST} characters", LONGEST)
        self._token = self._read(0)

    def whole(self) -> Formula:
        node, _ = self._expression(0, 0)
        if self._token.text != _END:
            self._fail(f"'{self._token.text}' instead of an operator", self._token.at)
        return node

    def _expression(self, binding: int, depth: int) -> tuple[Formula, int]:
        """Parse operators that bind tighter than a level; return the tree and its height."""
        if depth > DEEPEST:
            self._fail(f"nested deeper than {DEEPEST}", self._token.at)
        left, height = self._operand(depth)
        while _BINDING.get(self._token.text, 0) > binding:
            operator = self._take()
            # Powers group from the right: 2^3^2 is 2^9.
            holds = _BINDING[operator.text] - (operator.text == "^")
            right, other = self._expression(holds, depth + 1)
            left, height = Operation(operator.text, left, right), 1 + max(height, other)
            if depth + height > DEEPEST:
                self._fail(f"nested deeper than {DEEPEST}", operator.at)
        return left, height

    def _operand(self, depth: int) -> tuple[Formula, int]:
        token = self._take()
        if token.kind == "number":
            return Constant(float(token.text)), 0
        if token.kind == "name":
            return self._name(token, depth)
        if token.text == "(":
            inside = self._expression(0, depth + 1)
            self._expect(")")
            return inside
        if token.text in _SIGNED:
            operand, height = self._expression(_SIGN, depth + 1)
            return _SIGNED[token.text](operand), height + 1
        self._fail(f"'{token.text}' instead of a number or a name" if token.text else "it ends unexpectedly", token.at)

    def _name(self, token: _Token, depth: int) -> tuple[Formula, int]:
        if self._token.text != "(":
            if token.text in CONSTANTS:
                return Constant(CONSTANTS[token.text]), 0
            return Variable(token.text), 0
        arguments, height = self._arguments(depth)
        if token.text == "if":
            if len(arguments) != 3:
                self._fail("if takes 3 arguments, a condition and two values", token.at)
            return Conditional(*arguments), height + 1
        function = self._functions.get(token.text)
        if function is None:
            self._fail(f"unknown function '{token.text}'; known are if, {', '.join(sorted(self._functions))}", token.at)
        if not function.accepts(len(arguments)):
            self._fail(f"{token.text} takes {function.takes}, not {len(arguments)}", token.at)
        return Call(token.text, function, tuple(arguments)), height + 1

    def _arguments(self, depth: int) -> tuple[list[Formula], int]:
        self._expect("(")
        arguments, highest = [], 0
        while True:
            node, height = self._expression(0, depth + 1)
            arguments.append(node)
            highest = max(highest, height)
            if self._token.text != ",":
                break
            self._take()
        self._expect(")")
        return arguments, highest

    def _expect(self, sign: str) -> None:
        if self._token.text != sign:
            self._fail(f"'{sign}' is missing", self._token.at)
        self._take()

    def _take(self) -> _Token:
        token = self._token
        self._token = self._read(token.at + len(token.text))
        return token

    def _read(self, at: int) -> _Token:
        found = _TOKEN.match(self._text, at)
        if found is not None:
            kind = found.lastgroup
            return _Token(found[str(kind)], kind, found.start(str(kind)))
        at = len(self._text) - len(self._text[at:].lstrip())
        if at < len(self._text):
            self._fail(f"'{self._text[at]}' is not allowed here", at)
        return _Token(_END, None, at)

    def _fail(self, reason: str, at: int) -> NoReturn:
        shown = self._text if len(self._text) <= 80 else self._text[:77] + "..."
        raise RealizerError(BadExpression(expression=shown, reason=reason, at=at + 1))
