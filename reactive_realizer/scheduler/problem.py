"""What a strategy gets and gives: a block as points, ties and preferences; a plan as descriptions of pegs."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import Enum
from typing import NamedTuple

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.names import Location
from reactive_realizer.errors import Fault
from reactive_realizer.pegboard.time_peg import TimeCell
from reactive_realizer.planunit.timing import Timing


class Point(NamedTuple):
    """A sync point of a behavior of the block."""

    behavior: str
    sync: str


class Origin(Enum):
    """The start of the block, as a point to tie others to."""

    BLOCK_START = "block start"


Node = Point | Origin | TimeCell
"""A point of the block, its start, or a peg of the outside: of another block or an anticipator."""


@dataclass(frozen=True, slots=True)
class Item:
    """A behavior to be timed."""

    behavior: Behavior
    timing: Timing


@dataclass(frozen=True, slots=True)
class Tie:
    """An `at` constraint: ``left = right + offset``.

    Attributes:
        owner: id of the behavior that names it, None for a constraint of the block.
        location: of what names it.
        text: as a person would write it.
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
        """What it ties."""
        return self.left, self.right

    def renamed(self, names: Mapping[TimeCell, TimeCell]) -> "Tie":
        """The same tie with other pegs of the outside."""
        return replace(self, left=_renamed(self.left, names), right=_renamed(self.right, names))


@dataclass(frozen=True, slots=True)
class Order:
    """An `after` constraint: ``later >= earlier + offset``; a `before` is one with its sides exchanged (thesis 7.12).

    Attributes:
        name: the same in any order of the block's elements; among equal ones the last is given up first.
        location: of what names it.
        text: as a person would write it.
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
        """What it orders."""
        return self.later, self.earlier

    def renamed(self, names: Mapping[TimeCell, TimeCell]) -> "Order":
        """The same order with other pegs of the outside."""
        return replace(self, later=_renamed(self.later, names), earlier=_renamed(self.earlier, names))


def _renamed(node: Node, names: Mapping[TimeCell, TimeCell]) -> Node:
    return node if isinstance(node, Point | Origin) else names.get(node, node)


@dataclass(frozen=True, slots=True)
class Problem:
    """A block to be timed.

    Attributes:
        items: its behaviors.
        ties: its `at` constraints.
        orders: its before/after constraints.
        times: of the outer pegs, s after the predicted block start, None while unknown.
    """

    items: tuple[Item, ...]
    ties: tuple[Tie, ...]
    times: Mapping[TimeCell, float | None]
    orders: tuple[Order, ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class AtBlock:
    """A time (s) after the start of the block."""

    anchor: "Anchor"
    offset: float

    @property
    def links(self) -> "Links":
        """What it hangs on, besides the start of the block."""
        return ()


@dataclass(slots=True, eq=False)
class Anchor:
    """Where a cluster stands in its block (s); free ones are moved as a whole."""

    time: float = 0.0
    free: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class AtOffset:
    """A distance (s) from another peg."""

    link: "PegSpec | TimeCell"
    offset: float

    @property
    def links(self) -> "Links":
        """What it hangs on."""
        return (self.link,)


@dataclass(frozen=True, slots=True, eq=False)
class AtRatio:
    """A fraction of the way between two others."""

    before: "PegSpec | TimeCell"
    after: "PegSpec | TimeCell"
    ratio: float

    @property
    def links(self) -> "Links":
        """What it hangs on."""
        return self.before, self.after


@dataclass(frozen=True, slots=True, eq=False)
class AtLeast:
    """Where another peg would be, but not before any bound, each a peg and a distance (s): an `after` kept alive.

    What must come later whatever happens are its ceilings: a bound behind one cannot be kept, and binds nothing.
    """

    natural: "PegSpec | TimeCell"
    bounds: "tuple[tuple[PegSpec | TimeCell, float], ...]"
    ceilings: "tuple[tuple[PegSpec | TimeCell, float], ...]" = ()

    @property
    def links(self) -> "Links":
        """What it hangs on."""
        return self.natural, *(link for link, _ in (*self.bounds, *self.ceilings))


@dataclass(frozen=True, slots=True, eq=False)
class AtMost:
    """Where another peg would be, but not after any bound, each a peg and a distance (s): a `before` kept alive.

    What must come first are its floors: a bound in front of one cannot be kept, and binds nothing.
    """

    natural: "PegSpec | TimeCell"
    bounds: "tuple[tuple[PegSpec | TimeCell, float], ...]"
    floors: "tuple[tuple[PegSpec | TimeCell, float], ...]" = ()

    @property
    def links(self) -> "Links":
        """What it hangs on."""
        return self.natural, *(link for link, _ in (*self.bounds, *self.floors))


PegSpec = AtBlock | AtOffset | AtRatio | AtLeast | AtMost
"""A peg to be made when the plan is committed; points that share a spec share a peg."""

Links = tuple[PegSpec | TimeCell, ...]
"""What a peg is to hang on."""


@dataclass(frozen=True, slots=True)
class Loss:
    """A behavior (or, with ``behavior`` None, a constraint of the block) that could not be kept, and why.

    Attributes:
        behavior: its id.
        dropped: whether the behavior itself is lost, or only a constraint of it.
        required: whether the block fails by it.
        constraint: the one that is not kept, if it is one.
    """

    behavior: str | None
    fault: Fault
    dropped: bool
    required: bool
    constraint: Tie | Order | None = None


@dataclass(frozen=True, slots=True)
class Solution:
    """A plan: the pegs of each behavior that is kept, point by point."""

    pegs: Mapping[str, Mapping[str, PegSpec]]
    losses: tuple[Loss, ...]

    def kept(self, problem: Problem) -> tuple[Tie | Order, ...]:
        """The constraints of its problem that it keeps: not lost, and on no behavior that is."""
        lost = {id(loss.constraint) for loss in self.losses}
        constraints: tuple[Tie | Order, ...] = (*problem.ties, *problem.orders)
        return tuple(each for each in constraints if id(each) not in lost and all(map(self._has, each.nodes)))

    def _has(self, node: Node) -> bool:
        return not isinstance(node, Point) or node.behavior in self.pegs
