"""Ties that meet at a point of a behavior without preferences.

Such a behavior is timed after all others and moves none of them (docs/semantics.md, scheduling), so what is tied to
one of its points would be timed before that is. But a point is one time: two that are tied to it are tied together.
"""

from collections.abc import Iterable
from dataclasses import replace

from reactive_realizer.scheduler.problem import Item, Node, Point, Tie


def through_free(ties: Iterable[Tie], items: Iterable[Item]) -> list[Tie]:
    """The same ties, of which all but one that name a free point name what that one ties it to instead.

    Args:
        ties: `at` constraints of a block.
        items: its behaviors.
    """
    free = {Point(item.behavior.id, sync) for item in items if item.timing.free for sync in item.timing.points}
    tied = list(ties)
    for point in sorted(free):
        tied = _eliminated(point, tied, free)
    return tied


def _eliminated(point: Point, ties: list[Tie], free: set[Point]) -> list[Tie]:
    own = [tie for tie in ties if point in tie.nodes and tie.left != tie.right]
    anchors = [tie for tie in own if _other(tie, point)[0] not in free]
    if len(own) < 2 or not anchors:
        return ties
    anchor = min(anchors, key=lambda tie: (not tie.required, tie.owner != point.behavior, tie.text))
    return [_moved(tie, point, *_other(anchor, point)) if tie in own and tie is not anchor else tie for tie in ties]


def _other(tie: Tie, point: Point) -> tuple[Node, float]:
    """What a tie ties a point to, and how much later (s) the point is."""
    return (tie.right, tie.offset) if tie.left == point else (tie.left, -tie.offset)


def _moved(tie: Tie, point: Point, node: Node, later: float) -> Tie:
    """A tie of a point as one of another node, which the point comes ``later`` than; without two points it stays."""
    other, distance = _other(tie, point)
    if other == node or not (isinstance(other, Point) or isinstance(node, Point)):
        return tie
    # node + later = point = other + distance
    return replace(tie, left=other, right=node, offset=later - distance)
