"""The input of a strategy: a block as points, constraints and preferences."""

from collections.abc import Callable, Container, Mapping
from dataclasses import dataclass, field, replace
from enum import Enum
from functools import cached_property
from typing import NamedTuple, Protocol

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.names import Location
from reactive_realizer.pegboard.time_peg import TimeCell
from reactive_realizer.planunit.timing import Timing

LEAST = 1.6e-5
"""The shortest duration of a phase that prefers to last, s: more than `SHORTEST` after rounding."""


class Point(NamedTuple):
    """A sync point of a behavior of the block."""

    behavior: str
    sync: str


class Origin(Enum):
    """The start of the block, as a point to tie others to."""

    BLOCK_START = "block start"


Node = Point | Origin | TimeCell
"""A point of the block, its start, or a peg from outside: of another block or an anticipator."""


@dataclass(frozen=True, slots=True)
class Item:
    """A behavior to be timed.

    Attributes:
        points: its sync points, in order.
    """

    behavior: Behavior
    timing: Timing
    points: tuple[Point, ...] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", tuple(Point(self.behavior.id, sync) for sync in self.timing.points))


class _HasNodes(Protocol):
    """A constraint on two nodes."""

    @property
    def nodes(self) -> tuple[Node, Node]:
        """The two nodes."""
        ...


class _Constraint:
    """The behaviors of a constraint on two nodes."""

    __slots__ = ()

    @property
    def behaviors(self: _HasNodes) -> set[str]:
        """Ids of the behaviors of the block that it names."""
        return {node.behavior for node in self.nodes if isinstance(node, Point)}

    def names(self: _HasNodes, behaviors: Container[str]) -> bool:
        """Whether it names one of some behaviors."""
        return any(isinstance(node, Point) and node.behavior in behaviors for node in self.nodes)


@dataclass(frozen=True, slots=True)
class Tie(_Constraint):
    """An `at` constraint: ``left = right + offset``.

    Attributes:
        owner: id of the behavior that states it, None for a constraint of the block.
        location: in the document.
        text: for messages.
        required: whether the block fails without it.
    """

    left: Node
    right: Node
    offset: float
    owner: str | None
    location: Location
    text: str
    required: bool

    @property
    def nodes(self) -> tuple[Node, Node]:
        """The two nodes."""
        return self.left, self.right

    def renamed(self, names: Mapping[TimeCell, TimeCell]) -> "Tie":
        """The same tie with other pegs from outside."""
        return replace(self, left=_renamed(self.left, names), right=_renamed(self.right, names))


@dataclass(frozen=True, slots=True)
class Precedence(_Constraint):
    """An `after` constraint: ``later >= earlier + offset``; a `before` is one with its sides exchanged (thesis 7.12).

    Attributes:
        name: the same in any order of the block's elements; among equal ones the last is given up first.
        location: in the document.
        text: for messages.
        required: whether the block fails without it.
    """

    later: Node
    earlier: Node
    offset: float
    name: str
    location: Location
    text: str
    required: bool

    @property
    def nodes(self) -> tuple[Node, Node]:
        """The two nodes, the later one first."""
        return self.later, self.earlier

    def renamed(self, names: Mapping[TimeCell, TimeCell]) -> "Precedence":
        """The same constraint with other pegs from outside."""
        return replace(self, later=_renamed(self.later, names), earlier=_renamed(self.earlier, names))


def _renamed(node: Node, names: Mapping[TimeCell, TimeCell]) -> Node:
    return node if isinstance(node, Point | Origin) else names.get(node, node)


@dataclass(frozen=True)
class SchedulingProblem:
    """A block to be timed.

    Attributes:
        items: its behaviors.
        ties: its `at` constraints.
        times: of the pegs from outside, s after the predicted block start, None while unknown.
        orders: its before/after constraints.
        placed: times of points of behaviors that were timed before; likewise.
    """

    items: tuple[Item, ...]
    ties: tuple[Tie, ...]
    times: Mapping[TimeCell, float | None]
    orders: tuple[Precedence, ...] = ()
    placed: Mapping[Point, float | None] = field(default_factory=dict)

    @property
    def given(self) -> dict[Node, float | None]:
        """The times of the nodes that are not to be timed; the start of the block is first."""
        given: dict[Node, float | None] = {Origin.BLOCK_START: 0.0}
        for times in (self.times, self.placed):
            given.update(times.items())
        return given

    @property
    def constraints(self) -> tuple[Tie | Precedence, ...]:
        """The ties, then the before/after constraints."""
        return *self.ties, *self.orders

    @cached_property
    def canonical(self) -> "SchedulingProblem":
        """The same problem in an order that does not depend on the order of the document (thesis 7.1.6).

        Behaviors by id; constraints by the points that they name, required ones first. What compares equal differs in
        nothing but its place in the document.
        """
        items = sorted(self.items, key=lambda item: item.behavior.id)
        places = {point: (0, point.behavior, k, point.sync) for item in items for k, point in enumerate(item.points)}

        def place(node: Node) -> tuple[int, str, int, str]:
            if isinstance(node, Point):
                return places.get(node, (0, node.behavior, 0, node.sync))
            return 1, "" if node is Origin.BLOCK_START else node.name, 0, ""

        def by_place(each: Tie | Precedence) -> tuple[object, ...]:
            name = each.name if isinstance(each, Precedence) else ""
            return not each.required, name, *map(place, each.nodes), each.offset, each.text

        ties, orders = sorted(self.ties, key=by_place), sorted(self.orders, key=by_place)
        return replace(self, items=tuple(items), ties=tuple(ties), orders=tuple(orders))

    def only(
        self, items: Callable[[Item], bool], constraints: Callable[[Tie | Precedence], bool]
    ) -> "SchedulingProblem":
        """The problem with some of its behaviors and constraints."""
        return replace(
            self,
            items=tuple(filter(items, self.items)),
            ties=tuple(filter(constraints, self.ties)),
            orders=tuple(filter(constraints, self.orders)),
        )
