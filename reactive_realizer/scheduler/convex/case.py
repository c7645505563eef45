"""A problem in one order, whatever the order in which it was written (thesis 7.1.6), and the stages of its solution."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass
from typing import NamedTuple, TypeVar

from reactive_realizer.pegboard.time_peg import TimeCell
from reactive_realizer.scheduler.convex.causes import Cause, Rank
from reactive_realizer.scheduler.problem import (
    Item,
    Node,
    Order,
    Origin,
    PegSpec,
    Point,
    Problem,
    Tie,
)

C = TypeVar("C", Tie, Order)


class Fixed(NamedTuple):
    """A point whose time is not to be found.

    Attributes:
        time: s after the predicted start of the block; None while unknown.
        link: the peg that stands for it.
    """

    time: float | None
    link: "PegSpec | TimeCell"


@dataclass(frozen=True, slots=True)
class Stage:
    """Behaviors that are timed together.

    Attributes:
        items: by index in the case, in order.
        ties: on them.
        orders: on them.
        fixed: the points that these name and whose time is given; the start of the block is the first.
    """

    items: Mapping[int, Item]
    ties: Mapping[Cause, Tie]
    orders: Mapping[Cause, Order]
    fixed: Mapping[Node, Fixed]

    @property
    def constraints(self) -> AbstractSet[Cause]:
        """All constraints on its behaviors."""
        return self.ties.keys() | self.orders.keys()


@dataclass(frozen=True, slots=True)
class Case:
    """Behaviors by id, constraints by what they name, required ones first: the last of some is the first to go.

    Attributes:
        items: the behaviors.
        ties: in order.
        orders: in order.
        points: of the behaviors; each with the index of its behavior, and its own.
    """

    items: tuple[Item, ...]
    ties: tuple[Tie, ...]
    orders: tuple[Order, ...]
    points: Mapping[Node, tuple[int, int]]

    @classmethod
    def of(cls, problem: Problem) -> "Case":
        """The problem, sorted; what compares equal is the same but for its place in the document."""
        items = tuple(sorted(problem.items, key=lambda item: item.behavior.id))
        points: dict[Node, tuple[int, int]] = {
            Point(item.behavior.id, sync): (index, k)
            for index, item in enumerate(items)
            for k, sync in enumerate(item.timing.points)
        }
        place = _places(points)
        return cls(items, _sorted(problem.ties, place), _sorted(problem.orders, place), points)

    def stage(self, behaviors: Iterable[int], fixed: Mapping[Node, Fixed], without: AbstractSet[Cause]) -> Stage:
        """Some behaviors, and the constraints that name nothing else than them and what is fixed."""
        items = {index: self.items[index] for index in behaviors if Cause(Rank.BEHAVIOR, index) not in without}
        own = {node for node, (index, _) in self.points.items() if index in items}
        known = {*own, *fixed}
        ties = _used(self.ties, Rank.TIE, known, without)
        orders = _used(self.orders, Rank.ORDER, known, without)
        constraints: list[Tie | Order] = [*ties.values(), *orders.values()]
        named = [node for each in constraints for node in each.nodes if node not in own]
        return Stage(items, ties, orders, {node: fixed[node] for node in (Origin.BLOCK_START, *named)})


Place = tuple[int, int, int, str]


def _places(points: Mapping[Node, tuple[int, int]]) -> Callable[[Node], Place]:
    """What nodes are sorted by: behavior and index of the point; then the start of the block; then the outside."""

    def place(node: Node) -> Place:
        if isinstance(node, Point):
            return (0, *points[node], "") if node in points else (1, 0, 0, f"{node.behavior}:{node.sync}")
        return 2, 0, 0, "" if node is Origin.BLOCK_START else node.name

    return place


def _sorted(constraints: Sequence[C], place: Callable[[Node], Place]) -> tuple[C, ...]:
    def key(each: C) -> tuple[object, ...]:
        nodes = [place(node) for node in each.nodes]
        return not each.required, getattr(each, "name", ""), nodes, each.offset, each.text

    return tuple(sorted(constraints, key=key))


def _used(constraints: Sequence[C], rank: Rank, known: set[Node], without: AbstractSet[Cause]) -> dict[Cause, C]:
    causes = {Cause(rank, index): each for index, each in enumerate(constraints)}
    return {cause: each for cause, each in causes.items() if cause not in without and known.issuperset(each.nodes)}
