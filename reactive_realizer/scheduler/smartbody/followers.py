"""Behaviors that only `after` constraints place: each begins as early as these allow, once the others are placed."""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from typing import Final

from reactive_realizer.errors import RealizerError
from reactive_realizer.scheduler.problem import Item, Node, Origin, Point, Precedence, SchedulingProblem
from reactive_realizer.scheduler.smartbody.placement import Placement, check_playable, fill
from reactive_realizer.scheduler.solution import Solution, lost_behavior

Followers = Mapping[str, Sequence[Precedence]]
"""The constraints after which each of these behaviors begins, by its id."""

_AT_START: Final = {0: Placement(0.0, known=True, cluster=Origin.BLOCK_START)}


def followers(problem: SchedulingProblem) -> Followers:
    """The behaviors that no tie names, with what they come after.

    That is not one that follows others too and is written behind them, so that there are no circles.
    """
    tied = set[str]().union(*(tie.behaviors for tie in problem.ties))
    named: defaultdict[str, list[Precedence]] = defaultdict(list)
    for order in problem.orders:
        if isinstance(order.later, Point):
            named[order.later.behavior].append(order)
    ids = (item.behavior.id for item in problem.items)
    waiting = dict.fromkeys(id_ for id_ in ids if id_ in named and id_ not in tied)
    found: dict[str, Sequence[Precedence]] = {}
    for id_ in tuple(waiting):
        orders = [order for order in named[id_] if not _is_of(order.earlier, waiting)]
        if orders:
            found[id_] = orders
        del waiting[id_]
    return found


def with_followers(problem: SchedulingProblem, solution: Solution, following: Followers) -> Solution:
    """A solution for the other behaviors of a problem, with the times of those that follow them."""
    times, losses = dict(solution.times), list(solution.losses)
    known = {node: time for node, time in problem.given.items() if time is not None}
    known.update(times.items())
    for item in problem.items:
        if item.behavior.id in following:
            try:
                placed = _place(item, following[item.behavior.id], known)
            except RealizerError as unplayable:
                losses.append(lost_behavior(item.behavior, unplayable.fault))
                continue
            times.update(placed)
            known.update(placed.items())
    return Solution(times, tuple(losses))


def _place(item: Item, orders: Sequence[Precedence], known: Mapping[Node, float]) -> dict[Point, float]:
    """The times of a behavior that comes after others; it also waits for those that are unknown.

    Raises:
        RealizerError: it has no duration.
    """
    placed = fill(item, _AT_START)
    check_playable(item, placed)
    offsets = {point: each.time for point, each in zip(item.points, placed, strict=True)}
    after = (
        known.get(order.earlier, 0.0) + order.offset - offset
        for order in orders
        for point, offset in offsets.items()
        if point == order.later
    )
    start = max(0.0, *after)
    return {point: start + offset for point, offset in offsets.items()}


def _is_of(node: Node, behaviors: Mapping[str, None]) -> bool:
    """Return whether a node is a point of one of some behaviors."""
    return isinstance(node, Point) and node.behavior in behaviors
