"""Constraints on points of behaviors without preferences.

Such a behavior is timed after all others and moves none of them (docs/semantics.md, scheduling), so behaviors that are
tied to one of its points would be timed before that point. But all that is tied to a point is tied together, so the
constraints can name the other points instead. If only such a behavior determines one of its points, and others depend
on that point, it is timed with them.
"""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Generic, NamedTuple, TypeVar

from reactive_realizer.planunit.timing import Phase, PhaseKind
from reactive_realizer.scheduler.problem import Item, Node, Point, Precedence, Tie

C = TypeVar("C", Tie, Precedence)


class ProblemWithoutFreePoints(NamedTuple):
    """A block in which nothing depends on a behavior that is timed last."""

    items: tuple[Item, ...]
    ties: list[Tie]
    orders: list[Precedence]


def through_free(items: Sequence[Item], ties: Iterable[Tie], orders: Iterable[Precedence]) -> ProblemWithoutFreePoints:
    """The same block, as behaviors with preferences see it.

    Of the constraints on a point of a behavior without preferences, all but one `at` are moved to the node to which
    that one ties it. If others still depend on such a behavior, it gets preferences: the durations that it has without
    constraints.

    Args:
        items: behaviors of a block.
        ties: its `at` constraints.
        orders: its before/after constraints.
    """
    free = {point for item in items if item.timing.free for point in item.points}
    tied, ordered = _ByNode(ties), _ByNode(orders)
    for point in sorted(free):
        _eliminate(point, tied, ordered, free)
    awaited = {
        point.behavior
        for point in free
        if any(_awaits(each, point) for constraints in (tied, ordered) for _, each in constraints.of(point))
    }
    taking_part = tuple(_taking_part(item) if item.behavior.id in awaited else item for item in items)
    return ProblemWithoutFreePoints(taking_part, tied.all, ordered.all)


class _ByNode(Generic[C]):
    """Constraints that are found by the nodes that they name.

    Attributes:
        all: the constraints, in their order.
    """

    def __init__(self, constraints: Iterable[C]) -> None:
        self.all: list[C] = list(constraints)
        self._places: dict[Node, dict[int, None]] = {}
        for place, each in enumerate(self.all):
            self._note(place, each)

    def of(self, node: Node) -> list[tuple[int, C]]:
        """The constraints on a node, each with its place among all, in order."""
        return [(place, self.all[place]) for place in sorted(self._places.get(node, ()))]

    def replace(self, place: int, constraint: C) -> None:
        """Put a constraint in the place of another one."""
        for node in self.all[place].nodes:
            self._places[node].pop(place, None)
        self.all[place] = constraint
        self._note(place, constraint)

    def _note(self, place: int, constraint: C) -> None:
        for node in constraint.nodes:
            self._places.setdefault(node, {})[place] = None


def _eliminate(point: Point, ties: _ByNode[Tie], orders: _ByNode[Precedence], free: set[Point]) -> None:
    """Move the constraints on a point to the node to which one of them ties it, if any does."""
    own = [(place, tie) for place, tie in ties.of(point) if tie.left != tie.right]
    anchors = [tie for _, tie in own if _other(tie, point)[0] not in free]
    if not anchors:
        return
    anchor = min(anchors, key=lambda tie: (not tie.required, tie.owner != point.behavior, tie.text))
    node, later = _other(anchor, point)
    for place, tie in own:
        if tie is not anchor:
            ties.replace(place, _moved(tie, point, node, later))
    for place, order in orders.of(point):
        orders.replace(place, _moved(order, point, node, later))


def _other(tie: Tie, point: Point) -> tuple[Node, float]:
    """The other node of a tie, and how much later (s) the point is."""
    return (tie.right, tie.offset) if tie.left == point else (tie.left, -tie.offset)


def _moved(constraint: C, point: Point, node: Node, later: float) -> C:
    """A constraint on a point, moved to another node, than which the point is later by ``later`` (s).

    It stays as it is if it would then name only one node, or no point of the block.
    """
    one, other = constraint.nodes
    left, right = (node if each == point else each for each in (one, other))
    if point not in constraint.nodes or left == right or not (isinstance(left, Point) or isinstance(right, Point)):
        return constraint
    offset = constraint.offset + (later if other == point else -later)
    if isinstance(constraint, Tie):
        return replace(constraint, left=left, right=right, offset=offset)
    return replace(constraint, later=left, earlier=right, offset=offset)


def _awaits(constraint: Tie | Precedence, point: Point) -> bool:
    """Whether another behavior depends on a point by a constraint; a behavior depends on those that it names."""
    if isinstance(constraint, Precedence):
        waiting = [constraint.later] if constraint.earlier == point else []
    else:
        waiting = [_other(constraint, point)[0]] if point in constraint.nodes else []
        waiting = [] if constraint.owner == point.behavior else waiting
    return any(isinstance(node, Point) and node.behavior != point.behavior for node in waiting)


def _taking_part(item: Item) -> Item:
    """The same behavior with preferences, unless its preferred duration is 0."""
    timing = item.timing
    if timing.offsets[-1] == 0 and not timing.instant:
        return item
    return replace(item, timing=replace(timing, phases=tuple(_preferred(phase) for phase in timing.phases)))


def _preferred(phase: Phase) -> Phase:
    """The same phase with a preference; one without duration takes no time."""
    return replace(phase, kind=PhaseKind.ELASTIC if phase.duration else PhaseKind.RIGID)
