"""Constraints on points of behaviors without preferences.

Such a behavior is timed after all others and moves none of them (docs/semantics.md, scheduling), so behaviors that are
tied to one of its points would be timed before that point. But all that is tied to a point is tied together, so the
constraints can name the other points instead. If only such a behavior determines one of its points, and others depend
on that point, it is timed with them.
"""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import NamedTuple, TypeVar

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
    tied, ordered = list(ties), list(orders)
    for point in sorted(free):
        tied, ordered = _eliminated(point, tied, ordered, free)
    constraints: list[Tie | Precedence] = [*tied, *ordered]
    awaited = {point.behavior for point in free if any(_awaits(each, point) for each in constraints)}
    return ProblemWithoutFreePoints(
        tuple(_taking_part(item) if item.behavior.id in awaited else item for item in items), tied, ordered
    )


def _eliminated(
    point: Point, ties: list[Tie], orders: list[Precedence], free: set[Point]
) -> tuple[list[Tie], list[Precedence]]:
    own = [tie for tie in ties if point in tie.nodes and tie.left != tie.right]
    anchors = [tie for tie in own if _other(tie, point)[0] not in free]
    if not anchors:
        return ties, orders
    anchor = min(anchors, key=lambda tie: (not tie.required, tie.owner != point.behavior, tie.text))
    node, later = _other(anchor, point)
    moved = [_moved(tie, point, node, later) if tie in own and tie is not anchor else tie for tie in ties]
    return moved, [_moved(order, point, node, later) for order in orders]


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
